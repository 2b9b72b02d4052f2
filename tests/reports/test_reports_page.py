"""The page in a real browser, opened from the file system."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from opened_page import NARROW, PRESS_EACH, WIDE, Opened, open_page, overflowing, serious_defects
from playwright.sync_api import Browser, Page

pytestmark = pytest.mark.slow

Finished = tuple[Path, list[dict[str, Any]]]
PICTURES = ("curves", "profiles", "errors", "maps", "artery", "metrics")


def _open(browser: Browser, directory: Path, **how: Any) -> Opened:
    return open_page(browser, directory / "report.html", **how)


def _unfold(page: Page) -> None:
    page.evaluate("document.querySelectorAll('main details').forEach((fold) => { fold.open = true; })")


def _draw_everything(page: Page) -> None:
    _unfold(page)
    for host in page.query_selector_all("[data-interactive]"):
        host.scroll_into_view_if_needed()
        page.wait_for_function("(host) => host.querySelector('.readout').textContent.length > 0", arg=host)
    page.wait_for_function("[...document.querySelectorAll('figure img')].every((i) => i.src.length > 1000)")


@pytest.fixture(scope="module")
def opened(browser: Browser, finished: Finished) -> Iterator[Opened]:
    """The report at 1400 px with all its pictures drawn."""
    one = _open(browser, finished[0], viewport=WIDE, bypass_csp=True)  # tests may evaluate; readers may not
    _draw_everything(one.page)
    yield one
    one.page.context.close()


@pytest.fixture(scope="module")
def narrow(browser: Browser, finished: Finished) -> Iterator[Opened]:
    """The report at 400 px with all its pictures drawn."""
    one = _open(browser, finished[0], viewport=NARROW, bypass_csp=True)
    _draw_everything(one.page)
    yield one
    one.page.context.close()


def test_it_opens_with_its_own_security_policy_and_asks_for_nothing(
    browser: Browser, finished: Finished
) -> None:
    one = _open(browser, finished[0], viewport=WIDE)
    for picture in PICTURES:
        host = one.page.locator(f"[data-interactive={picture}]")
        host.scroll_into_view_if_needed()
        if picture == "metrics":  # closed until a reader opens it
            host.locator("summary").first.click()
        host.locator(".readout:not(:empty)").wait_for(state="attached")
    one.page.wait_for_timeout(400)
    address = (finished[0] / "report.html").as_uri()
    assert [url for url in one.requests if not url.startswith(("data:", "blob:"))] == [address]
    assert one.console == []
    one.page.context.close()


@pytest.mark.parametrize("place", ["opened", "narrow"], ids=["1400 px", "400 px"])
def test_nothing_overflows_and_axe_finds_nothing_serious(place: str, request: pytest.FixtureRequest) -> None:
    one: Opened = request.getfixturevalue(place)
    for scheme in ("light", "dark"):  # by the machine's settings: the page takes its colours, and draws again
        one.page.emulate_media(color_scheme=scheme)  # type: ignore[arg-type]
        one.page.wait_for_timeout(300)
        assert overflowing(one.page) == [], scheme
        assert serious_defects(one.page, colours_only=scheme == "dark") == [], scheme
    assert one.console == []
    one.page.emulate_media(color_scheme="light")


def test_a_defect_in_one_row_of_many_alike_is_found(browser: Browser) -> None:
    rows = "".join(
        f"<tr><td{style}>{n}0 mm</td></tr>" for n, style in enumerate(["", "", " class='faint'", ""])
    )
    head = "<html lang='en'><title>rows</title><style>.faint { color: #ddd; }</style>"
    page = browser.new_page()
    page.set_content(f"{head}<table>{rows}</table></html>")
    for colours_only in (False, True):
        assert serious_defects(page, colours_only) == [("color-contrast", '<td class="faint">20 mm</td>')]
    page.close()


def test_without_scripts_everything_is_there(browser: Browser, finished: Finished) -> None:
    one = _open(browser, finished[0], viewport=WIDE, java_script_enabled=False)
    page = one.page
    for size in (WIDE, NARROW):
        page.set_viewport_size(size)  # type: ignore[arg-type]
        page.evaluate("document.querySelectorAll('main details').forEach((fold) => { fold.open = false; })")
        assert page.locator("[data-interactive]:visible, #choice:visible").count() == 0
        page.locator("main details.fold > summary").evaluate_all(PRESS_EACH)
        assert page.locator("main img:visible").count() == page.locator("main figure").count() > 10
        assert page.locator("main table:visible").count() == page.locator("main table").count() > 10
        assert "bands hold" in page.locator("#main").inner_text()
        empty = """() => [...document.querySelectorAll("main > section")]
            .filter((section) => section.checkVisibility() && !section.innerText.trim().includes("\\n"))
            .map((section) => section.innerText)"""
        assert page.evaluate(empty) == []
        assert page.locator("nav a:visible").count() == page.locator("main h2:visible").count() > 10
        numbers = page.locator("nav li:visible").evaluate_all("(items) => items.map((item) => item.value)")
        assert [f"{n}." for n in numbers] == [
            text.split()[0] for text in page.locator("main h2:visible").all_inner_texts()
        ]
    page.context.close()


def test_print_leaves_out_what_cannot_be_printed(opened: Opened) -> None:
    opened.page.emulate_media(media="print")
    assert opened.page.locator(".controls:visible, .interactive:visible, .bar:visible").count() == 0
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


def _set(page: Page, label: str, value: int, place: str = "#choice") -> None:
    page.locator(place).get_by_label(label, exact=True).evaluate(
        "(input, value) => { input.value = value; input.dispatchEvent(new Event('input')); }", value
    )


def _choose(page: Page, label: str, value: str) -> None:
    page.locator("#choice").get_by_label(label, exact=True).select_option(label=value)


def _await_words(page: Page, key: str, *words: str) -> None:
    page.wait_for_function(
        "([key, words]) => words.every((word) => document.querySelector(`#${key} .readout`).textContent"
        ".replaceAll('\u00a0', ' ').includes(word))",
        arg=[key, list(words)],
    )


def _data(directory: Path) -> Any:
    return xr.open_dataset(directory / "comparison.nc", decode_times=False)


def test_the_time_slider_shows_the_maps_of_that_state(opened: Opened, finished: Finished) -> None:
    page = opened.page
    page.locator("#maps-anytime").scroll_into_view_if_needed()
    _choose(page, "quantity", "lumen radius")
    _choose(page, "variant", "local")
    for state in (0, 7):
        _set(page, "time", state)
        with _data(finished[0]) as data:
            local = data.sel(variant="local").isel(time=state)
            t = float(local["time"])
            three, two = (1e3 * local[f"{model}_radius"].values for model in ("reference", "rom"))
        _await_words(page, "maps-anytime", f"lumen radius, variant local, t = {t:.3f} s")
        drawn = page.evaluate(
            "() => document.querySelector('#maps-anytime .plot').drawn"
            ".map((panel) => [[...panel.values], panel.low, panel.high])"
        )
        step = np.ptp([three, two]) / 60000 + 1e-6
        for (z, low, high), expected in zip(drawn, (three, two, 1e3 * (two - three)), strict=True):
            np.testing.assert_allclose(z, expected.ravel(), atol=1500 * step if expected.min() < 1 else step)
            assert low <= np.min(z) + 1e-9
            assert high >= np.max(z) - 1e-9
        assert drawn[2][1] == -drawn[2][2]


def test_the_maps_have_the_colours_of_their_values(opened: Opened) -> None:
    page = opened.page
    page.locator("#maps-anytime").scroll_into_view_if_needed()
    _choose(page, "variant", "local")
    _set(page, "time", 3)
    _set(page, "x", 0)
    _await_words(page, "maps-anytime", "t = 0.")
    page.wait_for_timeout(300)
    # the largest and the least value of a panel have the ends of its colours
    found = page.evaluate(
        """() => {
        const place = document.querySelector("#maps-anytime .plot"), canvas = place.querySelector("canvas");
        const pen = canvas.getContext("2d");
        const seen = new Set();
        const { data } = pen.getImageData(0, 0, canvas.width, canvas.height);
        for (let k = 0; k < data.length; k += 4) seen.add(`${data[k]},${data[k + 1]},${data[k + 2]}`);
        return ["68,1,84", "253,231,37"].map((colour) => seen.has(colour));
    }"""
    )
    assert found == [True, True]


def test_pointing_at_curves_and_maps_tells_values(opened: Opened) -> None:
    page = opened.page
    _choose(page, "quantity", "lumen radius")
    for key, target, words in (
        ("curves-anywhere", "svg", ("t = ", "3D", "2D", "mm")),
        ("maps-anytime", "canvas", ("x = ", "φ = ", "mm")),
        ("artery-turned", "canvas >> nth=1", ("x = ", "R ", "mm", "kPa")),
    ):
        picture = page.locator(f"#{key} .plot {target}").first
        tip = page.locator(f"#{key} .plot > .tip:not([hidden])").first
        for aside in range(0, 60, 3):  # until it is drawn, and nothing above moves it any more
            box = picture.bounding_box()
            assert box is not None
            picture.hover(position={"x": box["width"] / 4 + aside, "y": box["height"] / 2})
            page.wait_for_timeout(250)
            if tip.is_visible():
                break
        said = tip.inner_text()
        assert all(word in said for word in words), said


def test_a_click_on_the_map_opens_that_places_curves(opened: Opened, finished: Finished) -> None:
    page = opened.page
    host = page.locator("#maps-anytime")
    host.scroll_into_view_if_needed()
    _choose(page, "variant", "local")
    _choose(page, "quantity", "lumen radius")
    host.locator("details details").evaluate("(fold) => { fold.open = false; }")
    box = host.locator("canvas").first.bounding_box()
    assert box is not None
    before = page.url
    page.mouse.click(box["x"] + 52, box["y"] + 40)  # near the inlet, near the last row
    page.wait_for_function("(before) => location.href !== before", arg=before)
    where = dict(part.split("=") for part in page.url.partition("#")[2].split("&") if "=" in part)
    i, j = int(where["i"]), int(where["j"])
    assert i <= 2
    assert j >= 7
    curves = host.locator("details details .plot")
    page.wait_for_function(
        "(x) => document.querySelector('#maps-anytime details details .readout').textContent.includes(x)",
        arg=page.locator("#choice .place").inner_text().partition("x = ")[2],
    )
    with _data(finished[0]) as data:
        cell = data.sel(variant="local").isel(x=i - 1, phi=j - 1)
        for line, model in zip(
            curves.evaluate("(place) => place.drawn.map((line) => [...line.y])"),
            ("reference", "rom"),
            strict=False,
        ):
            np.testing.assert_allclose(line, 1e3 * cell[f"{model}_radius"].values, atol=2e-4)


def test_the_address_states_the_choice(browser: Browser, finished: Finished) -> None:
    """A page opened at an address shows what it states; another choice changes it, and a link keeps it."""
    at = "#maps&variant=axisymmetric&quantity=pressure&time=0.3&i=5&j=3"
    one = _open(browser, finished[0], at=at, viewport=WIDE, bypass_csp=True)
    page = one.page
    with _data(finished[0]) as data:
        t = float(data["time"].sel(time=0.3, method="nearest"))
    _await_words(page, "maps-anytime", f"pressure, variant axisymmetric, t = {t:.3f} s")
    assert page.evaluate("document.getElementById('maps').getBoundingClientRect().top") < 900
    _set(page, "φ", 5)
    page.wait_for_function("location.hash.endsWith('&i=5&j=6')")
    page.locator("#contents a", has_text="Provenance").click()
    page.wait_for_function("location.hash.startsWith('#provenance&variant=axisymmetric&')")
    assert one.console == []
    page.context.close()


def test_what_an_address_cannot_mean_is_passed_over(browser: Browser, finished: Finished) -> None:
    at = "#nowhere&variant=nobody&time=soon&i=0&j=999&__proto__=1&quantity=radius"
    one = _open(browser, finished[0], at=at, viewport=WIDE, bypass_csp=True)
    page = one.page
    page.locator("#curves-anywhere").scroll_into_view_if_needed()
    _await_words(page, "curves-anywhere", "lumen radius, variant local")
    assert one.console == []
    page.context.close()


def test_the_error_over_gamma_is_the_comparisons_own(opened: Opened, finished: Finished) -> None:
    page = opened.page
    page.locator("#exponents-anywhere").scroll_into_view_if_needed()
    with _data(finished[0]) as data:
        state = int(np.abs(data["time"].values - data.attrs["compare_times_s"][1]).argmin())
        x, phi = float(1e3 * data["x"][5]), float(np.degrees(data["phi"][3]))
        curve = (
            data["reference_profile_error_curve"]
            .sel(variant="local")
            .isel(compare_time=1, compare_x=1, compare_phi=1)
        )
        exponents, expected = curve["exponent"].values, 100 * curve.values
    _choose(page, "variant", "local")
    _set(page, "time", state)
    _set(page, "x", 5)
    _set(page, "φ", 3)
    _await_words(page, "exponents-anywhere", f"Variant local, x = {x:.1f} mm, φ = {phi:.0f}°")
    page.wait_for_timeout(200)
    plot = "document.querySelector('#exponents-anywhere .plot')"
    found, errors = page.evaluate(f"[[...{plot}.drawn[0].x], [...{plot}.drawn[0].y]]")
    np.testing.assert_allclose(found, exponents, rtol=1e-5)
    np.testing.assert_allclose(errors, expected, atol=2e-3)


def test_curves_are_those_of_the_chosen_cell(opened: Opened, finished: Finished) -> None:
    page = opened.page
    page.locator("#curves-anywhere").scroll_into_view_if_needed()
    _choose(page, "variant", "axisymmetric")
    _choose(page, "quantity", "pressure")
    _set(page, "x", 4)
    _set(page, "φ", 2)
    with _data(finished[0]) as data:
        cell = data.sel(variant="axisymmetric").isel(x=4, phi=2)
        where = f"x = {1e3 * float(cell['x']):.1f} mm, φ = {np.degrees(float(cell['phi'])) + 0.01:.0f}°"
        _await_words(page, "curves-anywhere", f"pressure, variant axisymmetric, {where}")
        page.wait_for_timeout(200)
        drawn = page.evaluate(
            "document.querySelector('#curves-anywhere .plot').drawn.map((line) => [...line.y])"
        )
        for y, model in zip(drawn, ("reference", "rom"), strict=False):
            np.testing.assert_allclose(y, 1e-3 * cell[f"{model}_pressure"].values, atol=2e-4)


def test_both_arteries_turn_together_and_stay_so(opened: Opened) -> None:
    page, host = opened.page, opened.page.locator("#artery-turned")
    host.scroll_into_view_if_needed()
    plot = "document.querySelector('#artery-turned .plot')"
    pixels = f"[...{plot}.querySelectorAll('.pair canvas')].map((c) => c.toDataURL())"
    host.get_by_label("coloured by").select_option(label="pressure")
    page.wait_for_function(f"{plot}.drawn.shades.reference[0] > 5")
    before = page.evaluate(pixels)
    first = host.locator(".pair canvas").first
    box = first.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] / 2 + 40, box["y"] + box["height"] / 2 + 30, steps=3)
    page.mouse.up()
    page.wait_for_function(f"{plot}.drawn.aim.tilt === 32")
    assert all(a != b for a, b in zip(before, page.evaluate(pixels), strict=True))
    aim = page.evaluate(f"{plot}.drawn.aim")
    _set(page, "time", 9)
    _await_words(page, "artery-turned", page.locator("#choice output").nth(1).inner_text().split(",")[0])
    assert page.evaluate(f"{plot}.drawn.aim") == aim
    _set(page, "turn about the axis", 0, "#artery-turned")
    page.wait_for_function(f"{plot}.drawn.aim.turn === 0")


def test_a_figures_smallest_letters_can_be_read_on_a_narrow_screen(narrow: Opened) -> None:
    card = narrow.page.locator("figure .card").first
    card.scroll_into_view_if_needed()
    drawn = card.locator("img").bounding_box()
    assert drawn is not None
    assert 6.5 / 72 * drawn["width"] / 6.9 > 9  # px; letters of 6.5 pt in 6.9 inches
    card.focus()
    narrow.page.keyboard.press("End")
    narrow.page.keyboard.press("ArrowRight")
    narrow.page.wait_for_function("document.querySelector('figure .card').scrollLeft > 0")


def test_values_beside_each_other_tell_as_many_digits(opened: Opened, finished: Finished) -> None:
    page = opened.page
    page.locator("#curves-anywhere").scroll_into_view_if_needed()
    _choose(page, "variant", "local")
    _choose(page, "quantity", "lumen radius")
    found = set()
    with _data(finished[0]) as data:
        places = [(x, phi) for phi in (0, 3) for x in range(data.sizes["x"])]
        for x, phi in places:
            _set(page, "x", x)
            _set(page, "φ", phi)
            degrees = np.degrees(float(data["phi"][phi])) + 0.01
            where = f"x = {1e3 * float(data['x'][x]):.1f} mm, φ = {degrees:.0f}°"
            _await_words(page, "curves-anywhere", where)
            said = page.locator("#curves-anywhere .readout").inner_text()
            found |= set(re.findall(r"(?:3D|2D) ([\d.]+)\u00a0mm", said))
    assert len(found) >= 10
    assert {len(text) for text in found} == {len("2.633")}


def test_a_figure_opens_at_full_size_on_a_narrow_screen(narrow: Opened) -> None:
    figure = narrow.page.locator("figure").first
    figure.get_by_role("button", name="Enlarge").click()
    assert narrow.page.locator("dialog[open] img").bounding_box()["width"] > 900  # type: ignore[index]
    narrow.page.get_by_role("button", name="Close").click()
    assert narrow.page.locator("dialog[open]").count() == 0


def test_colours_can_be_chosen(opened: Opened) -> None:
    paper = "getComputedStyle(document.body).backgroundColor"
    choice = opened.page.locator("#theme select")
    choice.select_option(label="dark")
    assert opened.page.evaluate(paper) == "rgb(21, 24, 28)"
    choice.select_option(label="light")
    assert opened.page.evaluate(paper) == "rgb(255, 255, 255)"
    choice.select_option(index=0)


def test_figures_take_the_colours_of_the_page(opened: Opened) -> None:
    page = opened.page
    figure = page.locator("figure img").first
    figure.scroll_into_view_if_needed()
    page.wait_for_function("document.querySelector('figure img').src.length > 1000")
    corner = """async () => {
        const image = document.querySelector("figure img");
        const canvas = document.createElement("canvas");
        const pen = canvas.getContext("2d");
        await image.decode();
        pen.drawImage(image, 0, 0, 300, 150);
        return [...pen.getImageData(2, 2, 1, 1).data];
    }"""
    for name, paper in (("dark", [21, 24, 28, 255]), ("light", [255, 255, 255, 255])):
        page.locator("#theme select").select_option(label=name)
        page.wait_for_timeout(200)
        assert page.evaluate(corner) == paper
    page.locator("#theme select").select_option(index=0)


def test_a_wide_table_scrolls_beside_its_first_column(narrow: Opened) -> None:
    frame = narrow.page.locator(".scroll:has(> #bands)")
    frame.evaluate("(frame) => { frame.scrollLeft = 150; }")
    left = frame.evaluate("(frame) => frame.getBoundingClientRect().left")
    cells = "(cells) => cells.map((cell) => cell.getBoundingClientRect().left)"
    assert frame.evaluate("(frame) => frame.scrollLeft") == 150
    assert frame.locator("tbody th").evaluate_all(cells) == pytest.approx(
        [left] * frame.locator("tbody th").count(), abs=1
    )


def test_the_first_picture_is_within_three_screens_of_a_telephone(
    browser: Browser, finished: Finished
) -> None:
    one = _open(browser, finished[0], viewport=NARROW)
    top = one.page.locator("figure, [data-interactive]").first.evaluate(
        "(e) => e.getBoundingClientRect().top"
    )
    assert top < 3 * NARROW["height"]
    one.page.context.close()
