"""The page of a sweep and the gallery in a real browser, opened from the file system."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import synthetic_comparison
import synthetic_sweep
from opened_page import NARROW, PRESS_EACH, WIDE, open_page, overflowing, serious_defects
from playwright.sync_api import Browser

from reports.build import write_gallery

pytestmark = pytest.mark.slow

SIZES = pytest.mark.parametrize(
    ("size", "scheme"), [(WIDE, "light"), (NARROW, "dark")], ids=["1400 px, light", "400 px, dark"]
)


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, pd.DataFrame]:
    """Folder of a gallery over a comparison and a sweep with Sobol indices, and the sweep's samples."""
    place = tmp_path_factory.mktemp("gallery")
    small = synthetic_comparison.Setup(
        variants=("local",), baseline="", i=(6,), j=(4,), time_names=("systole",)
    )
    synthetic_comparison.write(place / "comparison", small)
    samples = synthetic_sweep.write(place / "sweep", synthetic_sweep.Setup(kind="saltelli", indices=True))
    write_gallery([place / "comparison", place / "sweep"])
    return place, samples


@SIZES
@pytest.mark.parametrize("name", ["sweep/index.html", "gallery.html"])
def test_nothing_is_wrong_with_a_page(
    browser: Browser, pages: tuple[Path, pd.DataFrame], name: str, size: dict[str, int], scheme: str
) -> None:
    path = pages[0] / name
    scripts = name != "gallery.html"
    one = open_page(browser, path, scripts=scripts, viewport=size, color_scheme=scheme, bypass_csp=True)
    if scripts:
        one.page.locator("#samples-any").scroll_into_view_if_needed()
        one.page.wait_for_selector("#samples-any .plot svg", state="attached")
    assert overflowing(one.page) == []
    assert serious_defects(one.page) == []
    assert one.console == []
    one.page.context.close()


@pytest.mark.parametrize("name", ["sweep/index.html", "gallery.html"])
def test_a_page_keeps_to_its_own_policy_and_asks_for_nothing(
    browser: Browser, pages: tuple[Path, pd.DataFrame], name: str
) -> None:
    path = pages[0] / name
    one = open_page(browser, path, scripts=name != "gallery.html", viewport=WIDE)
    one.page.wait_for_timeout(300)
    assert one.outside() == [path.as_uri()]
    assert one.console == []
    one.page.context.close()


def test_a_sweep_reads_without_scripts(browser: Browser, pages: tuple[Path, pd.DataFrame]) -> None:
    one = open_page(browser, pages[0] / "sweep" / "index.html", viewport=WIDE, java_script_enabled=False)
    page = one.page
    for size in (WIDE, NARROW):
        page.set_viewport_size(size)  # type: ignore[arg-type]
        page.evaluate("document.querySelectorAll('main details').forEach((fold) => { fold.open = false; })")
        assert page.locator("[data-interactive]:visible").count() == 0
        page.locator("main details.fold > summary").evaluate_all(PRESS_EACH)
        assert page.locator("main img:visible").count() == page.locator("main figure").count() >= 4
        assert "are within all their bands" in page.locator("#main").inner_text()
    page.context.close()


def test_the_picture_shows_the_chosen_samples(browser: Browser, pages: tuple[Path, pd.DataFrame]) -> None:
    place, samples = pages
    one = open_page(browser, place / "sweep" / "index.html", viewport=WIDE, bypass_csp=True)
    host = one.page.locator("#samples-any")
    host.scroll_into_view_if_needed()
    host.locator(".plot svg").wait_for()  # the first drawing, in idle time, would replace what is pointed at
    host.get_by_label("output", exact=True).select_option(label="largest error of the lumen radius")
    host.get_by_label("over", exact=True).select_option(label="angular extent of the calcification")
    one.page.wait_for_function(
        "document.querySelector('#samples-any .readout').textContent.startsWith('largest error')"
    )
    done = samples[samples["status"] == "ok"]
    drawn = one.page.evaluate(
        "document.querySelector('#samples-any .plot').drawn.map((line) => [[...line.x], [...line.y]])"
    )
    ok = (done["radius_max_error"].abs() <= synthetic_sweep.LIMIT).to_numpy()
    for (x, y), which in zip(drawn, (ok, ~ok), strict=True):
        np.testing.assert_allclose(x, np.degrees(done["calcification.phi.extent"][which]), rtol=1e-5)
        np.testing.assert_allclose(y, 100 * done["radius_max_error"][which], rtol=1e-5, atol=1e-9)
    assert f"{ok.sum()} of {len(done)} within" in host.locator(".readout").inner_text()
    point = one.page.locator("#samples-any .points circle").first.bounding_box()
    assert point
    one.page.mouse.move(point["x"] + point["width"] / 2, point["y"] + point["height"] / 2)
    one.page.wait_for_selector("#samples-any .tip:not([hidden])")
    said = one.page.locator("#samples-any .tip").text_content() or ""
    assert "sample " in said
    assert "resistance of the outlet" in said
    one.page.context.close()


def test_a_gallery_leads_to_every_page(browser: Browser, pages: tuple[Path, pd.DataFrame]) -> None:
    one = open_page(browser, pages[0] / "gallery.html", scripts=False, viewport=WIDE)
    for number in (1, 2):
        one.page.locator(f"#case-{number} a").click()
        one.page.wait_for_selector("html[data-scripts=ready]", state="attached")
        assert one.page.locator("#verdict").is_visible()
        one.page.go_back()
    assert one.console == []
    one.page.context.close()
