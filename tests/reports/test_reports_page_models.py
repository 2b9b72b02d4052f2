"""The page of a comparison of several reduced models in a real browser."""

from pathlib import Path

import numpy as np
import pytest
import synthetic_comparison as synthetic
import xarray as xr
from opened_page import NARROW, WIDE, open_page
from playwright.sync_api import Browser

from reports.build import write_reports


def test_the_chosen_model_is_what_all_pictures_compare(
    browser: Browser, tmp_path: Path, small: synthetic.Setup, undrawn: None
) -> None:
    synthetic.write(tmp_path, small, ("row", "coupled"))
    write_reports(tmp_path)
    one = open_page(browser, tmp_path / "report.html", viewport=WIDE, bypass_csp=True)
    page = one.page
    for model in ("coupled", "row"):
        page.locator("#choice").get_by_label("2D model").select_option(label=model)
        for key in ("curves-anywhere", "maps-anytime", "artery-turned", "profiles-anytime"):
            page.locator(f"#{key}").scroll_into_view_if_needed()
            page.wait_for_function(
                "([key, model]) => document.querySelector(`#${key} .readout`).textContent.includes(model)",
                arg=[key, model],
            )
        drawn = page.evaluate(
            "document.querySelector('#curves-anywhere .plot').drawn.map((line) => [line.name, [...line.y]])"
        )
        assert [name for name, _ in drawn] == ["3D", model, f"{model} − 3D"]
        with xr.open_dataset(tmp_path / "comparison.nc", decode_times=False) as data:
            radius = 1e3 * data[f"{model}_radius"].isel(variant=0, x=5, phi=3).values
        np.testing.assert_allclose(drawn[1][1], radius, atol=2e-4)
        page.wait_for_function("(model) => location.hash.includes(`model=${model}`)", arg=model)
    assert one.console == []
    page.context.close()


# Notes each word that a canvas draws with where it begins and ends, in pixels of the page.
WATCH = """
window.written = [];
const write = CanvasRenderingContext2D.prototype.fillText;
CanvasRenderingContext2D.prototype.fillText = function (text, x, y, most) {
  const wide = Math.min(most ?? Infinity, this.measureText(text).width);
  const left = x - { left: 0, start: 0, center: wide / 2, right: wide, end: wide }[this.textAlign];
  written.push({ text, left, right: left + wide, y, width: parseFloat(this.canvas.style.width) });
  return write.apply(this, arguments);
};
"""


@pytest.mark.parametrize("size", [WIDE, NARROW], ids=["1400 px", "400 px"])
def test_no_word_of_the_maps_is_cut_or_lies_on_another(
    browser: Browser, tmp_path: Path, small: synthetic.Setup, undrawn: None, size: dict[str, int]
) -> None:
    synthetic.write(tmp_path, small, ("row", "coupled"))
    write_reports(tmp_path)
    context = browser.new_context(viewport=size, bypass_csp=True)  # type: ignore[arg-type]
    context.add_init_script(WATCH)
    page = context.new_page()
    page.goto((tmp_path / "report.html").as_uri() + "#maps&model=coupled&quantity=sector_flow_rate")
    page.wait_for_selector("html[data-scripts=ready]", state="attached")
    page.locator("#maps-anytime").scroll_into_view_if_needed()
    page.wait_for_function("document.querySelector('#maps-anytime .readout').textContent.includes('coupled')")
    written = page.evaluate("written")
    texts = {word["text"] for word in written}
    assert {"coupled − 3D", "qᵩ (cm³/s)", "(mm³/s)"} <= texts
    for word in written:
        assert word["left"] >= 0
        assert word["right"] <= word["width"], word["text"]
    last = written[max(k for k, word in enumerate(written) if word["text"] == "3D") :]
    for k, one in enumerate(last):
        for other in last[k + 1 :]:
            if abs(one["y"] - other["y"]) < 8:
                apart = one["right"] <= other["left"] or other["right"] <= one["left"]
                assert apart, (one["text"], other["text"])
    context.close()
