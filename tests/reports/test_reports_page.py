"""The page in a real browser, opened from the file system."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from opened_page import NARROW, WIDE, Opened, open_page, overflowing, serious_defects
from playwright.sync_api import Browser, Page

Finished = tuple[Path, list[dict[str, Any]]]
PICTURES = ("curves", "profiles", "errors", "maps", "artery", "metrics")


def _open(browser: Browser, directory: Path, **how: Any) -> Opened:
    return open_page(browser, directory / "report.html", **how)


def _draw_everything(page: Page) -> None:
    for host in page.query_selector_all("[data-interactive]"):
        host.scroll_into_view_if_needed()
        if host.get_attribute("data-interactive") != "metrics":
            page.wait_for_selector(f"#{host.get_attribute('id')} .main-svg", state="attached")
    page.wait_for_function("document.querySelector('#artery-turned .readout').textContent.length > 0")


@pytest.fixture(scope="module")
def opened(browser: Browser, finished: Finished) -> Iterator[Opened]:
    """The report at 1400 px with all its pictures drawn."""
    one = _open(browser, finished[0], viewport=WIDE, bypass_csp=True)  # tests may evaluate; readers may not
    _draw_everything(one.page)
    yield one
    one.page.context.close()


def test_it_opens_with_its_own_security_policy_and_asks_for_nothing(
    browser: Browser, finished: Finished
) -> None:
    one = _open(browser, finished[0], viewport=WIDE)
    for picture in PICTURES:
        one.page.locator(f"[data-interactive={picture}]").scroll_into_view_if_needed()
        one.page.wait_for_timeout(400)
    address = (finished[0] / "report.html").as_uri()
    assert [url for url in one.requests if not url.startswith(("data:", "blob:"))] == [address]
    assert one.console == []
    one.page.context.close()


@pytest.mark.parametrize(
    ("size", "scheme"), [(WIDE, "light"), (NARROW, "dark")], ids=["1400 px, light", "400 px, dark"]
)
def test_nothing_overflows_and_axe_finds_nothing_serious(
    browser: Browser, finished: Finished, size: dict[str, int], scheme: str
) -> None:
    one = _open(browser, finished[0], viewport=size, color_scheme=scheme, bypass_csp=True)
    _draw_everything(one.page)
    assert overflowing(one.page) == []
    assert serious_defects(one.page) == []
    assert one.console == []
    one.page.context.close()


def test_without_scripts_everything_is_there(browser: Browser, finished: Finished) -> None:
    for size in (WIDE, NARROW):
        one = _open(browser, finished[0], viewport=size, java_script_enabled=False)
        assert one.page.locator("[data-interactive]:visible").count() == 0
        assert one.page.locator("main img:visible").count() == one.page.locator("main figure").count() > 10
        assert one.page.locator("main table:visible").count() == one.page.locator("main table").count() > 10
        assert "bands hold" in one.page.locator("#main").inner_text()
        one.page.context.close()


def test_print_leaves_out_what_cannot_be_printed(opened: Opened) -> None:
    opened.page.emulate_media(media="print")
    assert opened.page.locator(".controls:visible, .interactive:visible, nav:visible").count() == 0
    assert opened.page.locator("main img:visible").count() > 10
    opened.page.emulate_media(media="screen")


def test_the_bands_can_be_filtered_and_sorted(opened: Opened, finished: Finished) -> None:
    page = opened.page
    bands = [row for row in finished[1] if row["status"]]
    bar = page.locator(".filters:has(+ .scroll #bands)")
    for name, value in (("verdict", "FAIL"), ("variant", "local")):
        expected = [row for row in bands if row["status" if name == "verdict" else name] == value]
        bar.get_by_label(name, exact=True).select_option(label=value)
        assert page.locator("#bands tbody tr:visible").count() == len(expected)
        assert bar.locator("output").inner_text() == f"{len(expected)} of {len(bands)} rows"
        bar.get_by_label(name, exact=True).select_option(index=0)
    for direction in (1, -1):
        page.locator("#bands thead").get_by_role("button", name="of limit").click()
        texts = page.locator("#bands tbody tr td:nth-child(7)").all_inner_texts()
        values = [float(text) for text in texts if text != "—"]
        assert values == sorted(values, reverse=direction < 0)
        assert len(values) == sum(row["error"] is not None for row in bands)


def test_every_metric_can_be_found(opened: Opened, finished: Finished) -> None:
    host = opened.page.locator("#metrics-all")
    rows = [row for row in finished[1] if row["variant"] == "local" and row["statistic"] == "rms_error"]
    host.get_by_label("variant", exact=True).select_option(label="local")
    host.get_by_label("statistic").select_option(label="RMS error")
    assert f"of {len(rows)} found" in host.locator(".readout").inner_text()
    host.get_by_label("verdict").select_option(label="FAIL")
    assert set(host.locator("tbody td.status").all_inner_texts()) == {"FAIL"}


def _set(page: Page, slider: str, value: int) -> None:
    page.locator(slider).evaluate(
        "(input, value) => { input.value = value; input.dispatchEvent(new Event('input')); }", value
    )


def test_the_time_slider_shows_the_maps_of_that_state(opened: Opened, finished: Finished) -> None:
    page, host = opened.page, opened.page.locator("#maps-anytime")
    host.get_by_label("quantity").select_option(label="lumen radius")
    host.get_by_label("variant", exact=True).select_option(label="local")
    for state in (0, 7):
        _set(page, "#maps-anytime input[type=range]", state)
        with xr.open_dataset(finished[0] / "comparison.nc", decode_times=False) as data:
            local = data.sel(variant="local").isel(time=state)
            t = float(local["time"])
            three, two = (1e3 * local[f"{model}_radius"].values.T for model in ("reference", "rom"))
        page.wait_for_function(
            "t => document.querySelector('#maps-anytime .readout').textContent.startsWith(`t = ${t}`)",
            arg=f"{t:.3f}",
        )
        drawn = page.evaluate(
            "() => document.querySelector('#maps-anytime .plot').data"
            ".filter((trace) => trace.type === 'heatmap').map((trace) => [trace.z, trace.zmin, trace.zmax])"
        )
        step = np.ptp([three, two]) / 60000 + 1e-6
        for (z, low, high), expected in zip(drawn, (three, two, 1e3 * (two - three)), strict=True):
            np.testing.assert_allclose(z, expected, atol=1500 * step if expected.min() < 1 else step)
            assert low <= np.min(z) + 1e-9
            assert high >= np.max(z) - 1e-9
        assert drawn[2][1] == -drawn[2][2]


def test_pointing_at_curves_and_maps_tells_values(opened: Opened) -> None:
    page = opened.page
    for key, words in (
        ("curves-anywhere", ("3D", "2D", "mm")),
        ("maps-anytime", ("x = ", "φ = ", "mm")),
    ):
        page.locator(f"#{key} .plot").scroll_into_view_if_needed()
        box = page.locator(f"#{key} .nsewdrag").first.bounding_box()
        assert box is not None
        page.mouse.move(box["x"] + box["width"] / 3, box["y"] + box["height"] / 2)
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        page.wait_for_selector(f"#{key} .hoverlayer .hovertext, #{key} .hoverlayer .legend")
        said = page.locator(f"#{key} .hoverlayer").text_content() or ""
        assert all(word in said for word in words), said


def test_the_error_over_gamma_is_the_comparisons_own(opened: Opened, finished: Finished) -> None:
    page, host = opened.page, opened.page.locator("#exponents-anywhere")
    host.get_by_label("variant", exact=True).select_option(label="local")
    host.get_by_label("time", exact=True).select_option(index=1)
    host.get_by_label("cell i").select_option(label="6")
    host.get_by_label("row j").select_option(label="4")
    page.wait_for_function(
        "document.querySelector('#exponents-anywhere .readout').textContent"
        ".startsWith('Variant local, i = 6, j = 4')"
    )
    page.wait_for_timeout(200)
    plot = "document.querySelector('#exponents-anywhere .plot')"
    x, y = page.evaluate(f"[[...{plot}.data[0].x], [...{plot}.data[0].y]]")
    with xr.open_dataset(finished[0] / "comparison.nc", decode_times=False) as data:
        curve = (
            data["reference_profile_error_curve"]
            .sel(variant="local")
            .isel(compare_time=1, compare_x=1, compare_phi=1)
        )
        np.testing.assert_allclose(x, curve["exponent"], rtol=1e-5)
        np.testing.assert_allclose(y, 100 * curve, atol=2e-3)
    assert "error %{y" in page.evaluate(f"{plot}.data[0].hovertemplate")


def test_curves_are_those_of_the_chosen_cell(opened: Opened, finished: Finished) -> None:
    page, host = opened.page, opened.page.locator("#curves-anywhere")
    host.get_by_label("variant", exact=True).select_option(label="axisymmetric")
    host.get_by_label("quantity").select_option(label="pressure")
    _set(page, "#curves-anywhere input >> nth=0", 4)
    _set(page, "#curves-anywhere input >> nth=1", 2)
    page.wait_for_function(
        "document.querySelector('#curves-anywhere .readout').textContent.startsWith('pressure, variant axis')"
    )
    page.wait_for_timeout(200)
    drawn = page.evaluate(
        "document.querySelector('#curves-anywhere .plot').data.map((trace) => [...trace.y])"
    )
    with xr.open_dataset(finished[0] / "comparison.nc", decode_times=False) as data:
        cell = data.sel(variant="axisymmetric").isel(x=4, phi=2)
        for y, model in zip(drawn, ("reference", "rom"), strict=False):
            np.testing.assert_allclose(y, 1e-3 * cell[f"{model}_pressure"].values, atol=2e-4)


def test_the_artery_turns_and_changes_its_colours(opened: Opened) -> None:
    page, host = opened.page, opened.page.locator("#artery-turned")
    host.scroll_into_view_if_needed()
    page.wait_for_selector("#artery-turned canvas", state="attached")
    plot = "document.querySelector('#artery-turned .plot')"
    assert page.evaluate(f"{plot}.data.map((trace) => trace.type)") == ["surface", "surface"]
    before = page.evaluate(f"{plot}.data[0].surfacecolor[0][0]")
    host.get_by_label("coloured by").select_option(label="pressure")
    page.wait_for_function(f"{plot}.data[0].surfacecolor[0][0] !== {json.dumps(before)}")
    eye = page.evaluate(f"{plot}.layout.scene.camera.eye.y")
    _set(page, "#artery-turned input >> nth=1", 0)
    page.wait_for_function(f"Math.abs({plot}.layout.scene2.camera.eye.y - {json.dumps(eye)}) > 0.1")


def test_a_browser_without_webgl_says_so(browser: Browser, finished: Finished) -> None:
    context = browser.new_context(viewport=WIDE)
    context.add_init_script(
        "const own = HTMLCanvasElement.prototype.getContext;"
        "HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {"
        " return kind.startsWith('webgl') ? null : own.call(this, kind, ...rest); };"
    )
    page = context.new_page()
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto((finished[0] / "report.html").as_uri())
    assert "draws no WebGL" in page.locator("#artery-turned").inner_text()
    assert page.locator("#artery-still img").is_visible()
    assert errors == []
    context.close()


def test_a_figure_opens_at_full_size_on_a_narrow_screen(browser: Browser, finished: Finished) -> None:
    one = _open(browser, finished[0], viewport=NARROW)
    figure = one.page.locator("figure").first
    figure.get_by_role("button", name="Enlarge").click()
    assert one.page.locator("dialog[open] img").bounding_box()["width"] > 900  # type: ignore[index]
    one.page.get_by_role("button", name="Close").click()
    assert one.page.locator("dialog[open]").count() == 0
    one.page.context.close()


def test_colours_can_be_chosen(opened: Opened) -> None:
    paper = "getComputedStyle(document.body).backgroundColor"
    choice = opened.page.locator("#theme select")
    choice.select_option(label="dark")
    assert opened.page.evaluate(paper) == "rgb(21, 24, 28)"
    choice.select_option(label="light")
    assert opened.page.evaluate(paper) == "rgb(255, 255, 255)"
    choice.select_option(index=0)
