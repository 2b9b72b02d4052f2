"""Page 1 of a comparison of two reduced models, held against metrics.json and the fields themselves."""

import json
import math
import re
from collections.abc import Callable
from html import unescape
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import synthetic_comparison as synthetic
import xarray as xr

from cases.fields import FIELDS
from cases.statistics import STATISTICS
from reports.figures.trust_map import inside_words

Rows = list[dict[str, Any]]
Finished = tuple[Path, Rows]
MODELS = ("row", "coupled")
PLACES = [(variant, model) for variant in synthetic.VARIANTS for model in MODELS]


def _of_html(directory: Path) -> str:
    source = (directory / "report.html").read_text(encoding="utf-8")
    section = source.partition('<h2 id="answer">')[2].partition("</section>")[0]
    return unescape(re.sub(r"<[^>]+>", " ", section))


@pytest.fixture(scope="module", params=["PDF", "HTML"])
def page(request: pytest.FixtureRequest, two_models: Finished, pdf_pages: Callable[[Path], list[str]]) -> str:
    """What a reader finds on page 1, with single spaces."""
    directory, _ = two_models
    said = pdf_pages(directory / "report.pdf")[0] if request.param == "PDF" else _of_html(directory)
    return re.sub(r"\s+", " ", said.replace("\u00a0", " "))


@pytest.fixture(scope="module")
def rows(two_models: Finished) -> Rows:
    """metrics.json, read again."""
    return list(json.loads((two_models[0] / "metrics.json").read_text()))


@pytest.fixture(scope="module")
def over_limits(two_models: Finished, rows: Rows) -> dict[tuple[str, str, str], np.ndarray]:
    """Error of the cycle in each cell over the limit, (x, phi), by variant, model and quantity."""
    with xr.open_dataset(two_models[0] / "comparison.nc", decode_times=False) as opened:
        data = opened.load()
    found = {}
    for row in rows:
        if row["status"] and row["statistic"] == "rms_error":
            of_variant, name = data.sel(variant=row["variant"]), row["quantity"]
            error = of_variant[f"{row['model']}_{name}"] / of_variant[f"reference_{name}"] - 1
            each = np.sqrt((error**2).mean("time").values) / row["band"]
            shape = (data.sizes["x"], data.sizes["phi"])
            found[row["variant"], row["model"], name] = np.broadcast_to(
                each if each.ndim == 2 else each[:, None], shape
            )
    return found


def _judged(rows: Rows, variant: str, model: str) -> Rows:
    return [row for row in rows if row["status"] and (row["variant"], row["model"]) == (variant, model)]


def _limit(row: dict[str, Any]) -> str:
    return f"{100 * row['band']:g} %"


def _three_digits(value: float, digits: int = 3) -> str:
    if value == 0:
        return "0"
    return f"{value:.{max(0, digits - 1 - math.floor(math.log10(abs(value))))}f}"


def test_each_sentence_says_yes_or_no_as_the_metrics_do(page: str, rows: Rows) -> None:
    checked = {"yes": 0, "no": 0}
    for variant in synthetic.VARIANTS:
        held = {
            model: all(row["status"] == "OK" for row in _judged(rows, variant, model)) for model in MODELS
        }
        title = synthetic.TITLES[variant]
        said = re.search(rf"{title}: (yes|no)\b", page)
        assert said
        assert said[1] == ("yes" if any(held.values()) else "no")
        sentence = page[said.end() :].partition("calcification: ")[0].partition("Which model")[0]
        for model in MODELS:
            assert (f"The {model} model misses" in sentence) == (not held[model])
            assert bool(re.search(rf"with the (?:\w+ and )?{model} model", sentence)) == held[model]
        checked[said[1]] += 1
    assert min(checked.values()) > 0


def test_each_number_of_a_sentence_is_an_error_a_limit_or_a_share_of_the_cells(
    page: str, rows: Rows, over_limits: dict[tuple[str, str, str], np.ndarray]
) -> None:
    for variant in synthetic.VARIANTS:
        sentence = page.partition(f"{synthetic.TITLES[variant]}: ")[2].partition("calcification: ")[0]
        sentence = sentence.partition("Which model")[0]
        for model in MODELS:
            of_model = sentence.partition(f"The {model} model misses ")[2].partition(" model misses")[0]
            failing = [row for row in _judged(rows, variant, model) if row["status"] == "FAIL"]
            expected = []
            for row in failing:
                signed = "" if row["statistic"] == "rms_error" else "+"
                error = f"{100 * row['error']:{signed}.2f}"
                words = f"{FIELDS[row['quantity']].label}, {STATISTICS[row['statistic']].label}"
                assert f"{words} {error} %, limit {_limit(row)}" in of_model
                expected += [error.lstrip("+"), f"{100 * row['band']:g}"]
                if row["statistic"] == "rms_error":
                    (matched,) = (
                        each["error"]
                        for each in rows
                        if (each["variant"], each["model"], each["quantity"], each["statistic"])
                        == (variant, model, row["quantity"], "budget_matched")
                    )
                    assert f"({100 * matched:.2f} % with the inflow of 3D)" in of_model
                    expected += [f"{100 * matched:.2f}", "3"]
                    beyond = over_limits[variant, model, row["quantity"]] > 1
                    assert f"in {100 * beyond.mean():.0f} % of the cells" in of_model
                    expected.append(f"{100 * beyond.mean():.0f}")
            places = r": (?:[xφ] = (?:[\d.]+ to [\d.]+(?: and |; )?)+ ?(?:mm|°)(?:, )?)+"
            numbers = re.findall(r"[\d.]*\d", re.sub(places, "", of_model))
            assert numbers == expected


def test_which_model_is_the_first_within_all_limits(page: str, rows: Rows) -> None:
    said = page.partition("Which model for which question (the first one within its limits): ")[2]
    for quantity in ("section_flow_rate", "radius", "largest_pressure_difference"):
        expected: dict[str, list[str]] = {}
        for variant in synthetic.VARIANTS:
            own = [r for r in rows if r["status"] and (r["variant"], r["quantity"]) == (variant, quantity)]
            good = [m for m in MODELS if all(r["status"] == "OK" for r in own if r["model"] == m)]
            if own:
                expected.setdefault(good[0] if good else "no model", []).append(variant)
        words = [
            f"{model} in {', '.join(names[:-1])}{' and ' if len(names) > 1 else ''}{names[-1]}"
            for model, names in expected.items()
        ]
        assert f"{FIELDS[quantity].label}: {', '.join(words)}" in said


def test_the_table_holds_every_error_over_its_limit_and_what_it_owes(page: str, rows: Rows) -> None:
    table = page.partition("in grey the largest errors that no limit judges.")[2]
    bands = dict.fromkeys((r["quantity"], r["statistic"], r["band"]) for r in rows if r["status"])
    for band in bands:
        found = [
            next(
                (r for r in _judged(rows, *place) if (r["quantity"], r["statistic"], r["band"]) == band), None
            )
            for place in PLACES
        ]
        texts = ["—" if row is None else _three_digits(abs(row["error"]) / row["band"]) for row in found]
        words = f"{FIELDS[band[0]].label}, {STATISTICS[band[1]].label} (limit {100 * band[2]:g} %)"
        assert f"{words} {' '.join(texts)}" in re.sub(r" +", " ", table)
        if band[1] != "rms_error":
            continue
        rest = table.partition(words)[2]
        for part, said in (("matched", "with the inflow of 3D"), ("mesh", "uncertainty of the 3D mesh")):
            shares = [
                next(
                    row["error"] / band[2]
                    for row in rows
                    if (row["variant"], row["model"], row["quantity"], row["statistic"])
                    == (*place, band[0], f"budget_{part}")
                )
                for place in PLACES
            ]
            assert rest.partition(said)[2].split()[: len(PLACES)] == [_three_digits(s, 2) for s in shares]


def test_the_table_names_the_largest_errors_that_nothing_judges(page: str, rows: Rows) -> None:
    judged = {(row["variant"], row["quantity"]) for row in rows if row["status"]}
    for statistic, most in (("rms_error", 1), ("cycle", 1)):
        errors: dict[str, dict[tuple[str, str], float]] = {}
        for row in rows:
            own = (row["variant"], row["quantity"])
            if row["statistic"] == statistic and own not in judged:
                errors.setdefault(row["quantity"], {})[row["variant"], row["model"]] = abs(row["error"])
        ranked = sorted(errors, key=lambda name: -max(errors[name].values()))
        for name in ranked[:most]:
            texts = [
                "—" if place not in errors[name] else "0 %" if errors[name][place] == 0
                else f"{100 * errors[name][place]:.2f} %"
                for place in PLACES
            ]  # fmt: skip
            assert f"{FIELDS[name].label}, not judged {' '.join(texts)}" in page
        for name in ranked[most:]:
            assert f"{FIELDS[name].label}, not judged" not in page


def test_the_map_tells_the_share_of_the_wall_inside_every_limit(
    page: str, over_limits: dict[tuple[str, str, str], np.ndarray]
) -> None:
    said = page.partition("Share of the wall inside: ")[2]
    for variant in synthetic.VARIANTS:
        texts = []
        for model in MODELS:
            worst = np.max([of for place, of in over_limits.items() if place[:2] == (variant, model)], axis=0)
            inside = float((worst <= 1).mean())
            texts.append(f"{model} {inside_words(worst)}")
            assert inside == pytest.approx(float(re.findall(r"\d+", texts[-1])[-1]) / 100, abs=0.01)
        assert f"{variant}: {' and '.join(texts)}" in said


def test_the_cost_is_that_of_a_cycle(two_models: Finished, pdf_text: Callable[[Path], str]) -> None:
    cost = synthetic.COST
    cycle = cost["wall_time_s"] * synthetic.PERIOD / cost["simulated_s"] / 60
    own = 0.5 / synthetic.RUN["cycles"]
    said = f"3D {cycle:.2f} min a cycle (as its log tells), row {own:.3f} s, coupled {own:.3f} s"
    for text in (pdf_text(two_models[0] / "report.pdf"), _of_html(two_models[0])):
        assert said in text.replace("\u00a0", " ")
