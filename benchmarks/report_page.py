"""What a report costs the browser that opens it: bytes, time until it can be used, blocked stretches, steps.

    python benchmarks/report_page.py REPORT.html [REPORT.html …] [--chromium PATH] [--width PX]

Each page is opened from the file system in a headless Chromium without a graphics card; every picture is
scrolled to, so that it is drawn; then each slider that a picture has, or that all of them share, is moved
by steps. A step ends when the picture's words have changed and the browser has painted. "Usable" is when the
page's scripts are ready. Numbers depend on the machine and its load: compare pages in one run.
"""

import argparse
import json
import os
import shutil
import statistics
from pathlib import Path
from typing import Any

from playwright.sync_api import Page, sync_playwright

STEPS = 5
ARGUMENTS = ["--no-sandbox", "--enable-unsafe-swiftshader"]

# Notes when the scripts are ready and how long the page could not answer.
WATCH = """
window.measured = { usable: null, blocked: [] };
new MutationObserver((_, observer) => {
  if (document.documentElement.dataset.scripts !== "ready") return;
  measured.usable = performance.now();
  observer.disconnect();
}).observe(document, { subtree: true, childList: true, attributes: true, attributeFilter: ["data-scripts"] });
new PerformanceObserver((list) => list.getEntries().forEach((entry) => measured.blocked.push(entry.duration)))
  .observe({ type: "longtask", buffered: true });
"""

# Moves one slider by a step; milliseconds until the picture tells the new values and is painted.
STEP = """
([key, label, step]) => new Promise((resolve) => {
  const named = (root) => [...root.querySelectorAll("input[type=range]")]
    .find((input) => input.labels[0].textContent === label);
  const host = document.getElementById(key);
  const input = named(host) ?? named(document.getElementById("choice"));
  const words = host.querySelector(".readout");
  const turned = label.startsWith("turn");
  const painted = () => requestAnimationFrame(() => setTimeout(() => resolve(performance.now() - start)));
  const observer = new MutationObserver(() => { observer.disconnect(); painted(); });
  const start = performance.now();
  if (!turned) observer.observe(words, { childList: true, characterData: true, subtree: true });
  input.value = (Number(input.value) + step) % (Number(input.max) + 1);
  input.dispatchEvent(new Event("input", { bubbles: true }));
  if (turned) painted();
})
"""

SLIDERS = """
(key) => {
  const labels = (root) => [...(root?.querySelectorAll("input[type=range]") ?? [])]
    .filter((input) => !input.disabled).map((input) => input.labels[0].textContent);
  const hosts = [key, "choice"].map((id) => document.getElementById(id));
  return [...new Set(hosts.flatMap(labels))];
}
"""


def measure(page: Page, path: Path) -> dict[str, Any]:
    """Bytes of one page, and milliseconds: until usable, longest blocked, of a step of each slider."""
    page.add_init_script(WATCH)
    page.goto(path.resolve().as_uri())
    page.wait_for_selector("html[data-scripts=ready]", state="attached", timeout=120_000)
    page.wait_for_timeout(1500)
    keys = [host.get_attribute("id") or "" for host in page.query_selector_all("[data-interactive]")]
    for key in keys:
        page.evaluate(
            """(key) => { const host = document.getElementById(key);
            for (let at = host; at; at = at.parentElement) if (at.tagName === "DETAILS") at.open = true;
            host.scrollIntoView(); }""",
            key,
        )
        page.wait_for_timeout(2500)
    blocked = page.evaluate("Math.max(0, ...measured.blocked)")
    return {
        "bytes": path.stat().st_size,
        "usable_ms": page.evaluate("measured.usable"),
        "longest_blocked_ms": blocked,
        "steps_ms": {key: of for key in keys if (of := _steps(page, key))},
    }


def _steps(page: Page, key: str) -> dict[str, float]:
    page.evaluate("(key) => document.getElementById(key).scrollIntoView()", key)
    page.wait_for_timeout(500)
    found = {}
    for label in page.evaluate(SLIDERS, key):
        if not _shows(key, label):
            continue
        taken = []
        for _ in range(STEPS):
            taken.append(page.evaluate(STEP, [key, label, 1]))
            page.wait_for_timeout(200)
        found[label] = statistics.median(taken)
    return found


def _shows(key: str, label: str) -> bool:
    """Whether a picture's words depend on a slider: curves are of all times, the artery of all places."""
    place = label in ("cell i", "row j", "x", "φ")
    return (
        (key == "curves-anywhere" and place)
        or (key in ("maps-anytime", "artery-turned") and not place)
        or (key == "profiles-anytime" and label == "time")
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("reports", type=Path, nargs="+", metavar="REPORT.html")
    parser.add_argument("--chromium", default=os.environ.get("CHROMIUM") or shutil.which("chromium"))
    parser.add_argument("--width", type=int, default=1400)
    given = parser.parse_args()
    with sync_playwright() as playwright:
        for path in given.reports:
            browser = playwright.chromium.launch(executable_path=given.chromium, args=ARGUMENTS)
            page = browser.new_page(viewport={"width": given.width, "height": 900}, bypass_csp=True)
            print(path, json.dumps(measure(page, path), indent=1, ensure_ascii=False), flush=True)
            browser.close()


if __name__ == "__main__":
    main()
