"""A page opened in a real browser from the file system, and what can be found wrong with it."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page

WIDE, NARROW = {"width": 1400, "height": 900}, {"width": 400, "height": 800}


@dataclass
class Opened:
    """A page, and what it said and asked for while it was open."""

    page: Page
    console: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)

    def outside(self) -> list[str]:
        """Requests for anything that is not in the page itself."""
        return [url for url in self.requests if not url.startswith(("data:", "blob:"))]


def open_page(browser: Browser, path: Path, scripts: bool = True, at: str = "", **how: Any) -> Opened:
    """Open a file, `at` what follows its address; with `scripts`, wait until those of the page are ready."""
    context = browser.new_context(**how)
    opened = Opened(context.new_page())
    opened.page.on("console", lambda m: opened.console.append(m.text) if m.type == "error" else None)
    opened.page.on("pageerror", lambda error: opened.console.append(str(error)))
    opened.page.on("request", lambda request: opened.requests.append(request.url))
    opened.page.goto(path.as_uri() + at)
    if scripts and how.get("java_script_enabled", True):
        opened.page.wait_for_selector("html[data-scripts=ready]", state="attached")
    return opened


def overflowing(page: Page) -> list[str]:
    """Elements that reach beyond the page's edge, but tables in a frame that scrolls sideways."""
    found: list[str] = page.evaluate(
        """() => [...document.querySelectorAll("body *")]
            .filter((e) => e.checkVisibility() && !e.closest("dialog, svg, .plot, .unseen, .scroll > *"))
            .filter((e) => e.getBoundingClientRect().right > innerWidth + 1
                || (!e.matches(".scroll") && getComputedStyle(e).overflowX !== "visible"
                    && e.scrollWidth > e.clientWidth + 1))
            .map((e) => `${e.tagName} ${e.id} ${e.className} ${e.textContent.slice(0, 40)}`)"""
    )
    wide = page.evaluate("document.documentElement.scrollWidth > innerWidth")
    return found + (["the page itself"] if wide else [])


def serious_defects(page: Page, colours_only: bool = False) -> list[tuple[str, str]]:
    """Serious and critical defects of accessibility that axe finds, each with the first element at fault.

    A row that differs in nothing but its words from one above it is not looked at again. With `colours_only`,
    only what a change of all colours can make wrong is looked for.
    """
    options: dict[str, Any] = {"resultTypes": ["violations"]}
    if colours_only:
        options["runOnly"] = ["color-contrast", "link-in-text-block"]
    page.evaluate(_MARK_ALIKE)
    violations = Axe().run(page, {"exclude": [["[data-alike]"]]}, options).response["violations"]
    page.evaluate("document.querySelectorAll('[data-alike]').forEach((row) => { delete row.dataset.alike; })")
    return [
        (found["id"], found["nodes"][0]["html"][:200])
        for found in violations
        if found["impact"] in ("serious", "critical")
    ]


_MARK_ALIKE = """() => {
    for (const body of document.querySelectorAll("tbody")) {
        const shapes = new Set();
        for (const row of body.rows) {
            const bare = row.outerHTML.replace(/ data-value="[^"]*"/g, "");
            const shape = bare.replace(/>[^<]*[^<\\s][^<]*</g, ">words<");
            if (shapes.has(shape)) row.dataset.alike = "";
            shapes.add(shape);
        }
    }
}"""

# Opens folds as a reader does: each is brought into view, and pressed only where nothing lies above it.
PRESS_EACH = """(summaries) => summaries.forEach((summary) => {
    summary.scrollIntoView({ block: "center" });
    const box = summary.getBoundingClientRect();
    const hit = document.elementFromPoint(box.left + box.width / 2, box.top + box.height / 2);
    if (summary.contains(hit)) hit.click();
})"""
