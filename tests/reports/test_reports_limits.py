"""Errors over limits cell by cell, the words for where they are beyond, and which model holds what."""

import dataclasses
import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import synthetic_comparison as synthetic
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from cases.arrays import Floats
from cases.results.metric_row import MetricRow, metric_row
from cases.statistics import JUDGED
from reports.result.load import Comparison, load
from reports.sections import answer
from reports.sections.parts.heat_table import heat_table
from reports.sections.parts.limits import over_limit, place_beyond, worst_over_limits
from reports.sections.parts.trust_figure import trust_figure

SHAPE = (3, 6, 4)  # time, x, phi
SMALL = (3, 2, 2)
POSITIVE = st.floats(0.5, 2.0)
CHANGE = st.floats(-0.4, 0.4)


def _comparison(
    reference: Floats, rom: Floats, quantity: str = "radius", calcified: tuple[int, ...] = ()
) -> Any:
    """Stand-in of one variant whose sections `calcified`, counted from 0, are so all around."""
    dims = ("variant", "time", "x", "phi")[: reference.ndim + 1]
    n_x, n_phi = reference.shape[1], reference.shape[2] if reference.ndim > 2 else SHAPE[2]
    inside = np.zeros((1, n_x, n_phi), dtype=np.int8)
    inside[:, list(calcified)] = 1
    fields = xr.Dataset(
        {
            f"reference_{quantity}": (dims, reference[None]),
            f"rom_{quantity}": (dims, rom[None]),
            "calcified": (("variant", "x", "phi"), inside),
        },
        coords={
            "variant": ["local"],
            "x": 1e-3 * (np.arange(n_x) + 0.5),
            "phi": 2 * np.pi * (np.arange(n_phi) + 0.5) / n_phi,
        },
    )
    own = SimpleNamespace(fields=fields, variants=("local",), n_phi=n_phi)
    own.array = lambda name, variant: Comparison.array(own, name, variant)
    return own


def _band(statistic: str, limit: float, quantity: str = "radius", error: float = 0.5) -> MetricRow:
    row = metric_row("case", "local", "rom", quantity, statistic, unit="m")
    return dataclasses.replace(row, error=error, band=limit, status="OK" if error <= limit else "FAIL")


def _plain(statistic: str, rom: list[float], reference: list[float], every: Floats) -> float:
    """Size of the error of one cell over time; `every` is the reference in all cells."""
    n = len(rom)
    apart = [b - a for b, a in zip(rom, reference, strict=True)]
    share = [d / a for d, a in zip(apart, reference, strict=True)]
    mean = sum(share) / n
    sizes = {
        "rms_error": (sum(s * s for s in share) / n) ** 0.5,
        "max_error": max(abs(s) for s in share),
        "bias": abs(mean),
        "scatter": (sum((s - mean) ** 2 for s in share) / n) ** 0.5,
        "rms_difference": (sum(d * d for d in apart) / n) ** 0.5,
        "max_difference": max(abs(d) for d in apart),
    }
    rms = sizes["rms_difference"]
    sizes["rms_over_rms"] = rms / (sum(v * v for v in every.ravel().tolist()) / every.size) ** 0.5
    sizes["rms_over_largest"] = rms / max(abs(v) for v in every.ravel().tolist())
    return sizes[statistic]


@given(
    reference=arrays.arrays(np.float64, SMALL, elements=POSITIVE),
    change=arrays.arrays(np.float64, SMALL, elements=CHANGE),
    limit=st.floats(1e-3, 10.0),
)
def test_over_limit_is_the_error_of_each_cell_over_the_limit(
    reference: Floats, change: Floats, limit: float
) -> None:
    rom = reference * (1 + change)
    comparison = _comparison(reference, rom)
    for statistic in (name for name in JUDGED if not name.endswith("stolic_error")):
        found = over_limit(comparison, _band(statistic, limit))
        assert found is not None
        for i, j in np.ndindex(*SMALL[1:]):
            expected = _plain(statistic, rom[:, i, j].tolist(), reference[:, i, j].tolist(), reference)
            assert found[i, j] == pytest.approx(expected / limit, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("statistic", ["systolic_error", "diastolic_error", "cycle"])
def test_what_is_of_one_instant_has_no_map(statistic: str) -> None:
    ones = np.ones(SHAPE)
    assert over_limit(_comparison(ones, ones), _band(statistic, 0.1)) is None


def test_a_quantity_that_is_derived_and_a_limit_of_zero_have_no_map() -> None:
    ones = np.ones(SHAPE)
    assert over_limit(_comparison(ones, ones), _band("rms_error", 0.1, "sector_flow_share")) is None
    assert over_limit(_comparison(ones, ones), _band("rms_error", 0.0)) is None


def test_a_quantity_of_sections_counts_all_around() -> None:
    reference = np.ones(SHAPE[:2])
    rom = reference + 0.1 * np.arange(SHAPE[1])
    found = over_limit(
        _comparison(reference, rom, "section_flow_rate"), _band("rms_error", 0.2, "section_flow_rate")
    )
    assert found is not None
    assert found == pytest.approx(np.tile(0.5 * np.arange(SHAPE[1])[:, None], (1, SHAPE[2])))


@pytest.mark.parametrize(
    ("sections", "rows", "said"),
    [
        (range(6), range(4), "in 100 % of the cells"),
        (range(6), [0], "in 25 % of the cells: φ = 0 to 90°"),
        (range(6), [0, 3], "in 50 % of the cells: φ = 270 to 90°"),
        ((2, 3), range(4), "in 33 % of the cells: x = 2.0 to 4.0 mm"),
        ((2, 3), [0, 1], "in 17 % of the cells: x = 2.0 to 4.0 mm, φ = 0 to 180°"),
        ((1, 3), range(4), "in 33 % of the cells: x = 1.0 to 2.0 and 3.0 to 4.0 mm"),
        ((), [], ""),
    ],
)
def test_where_an_error_is_beyond_its_limit_is_said(sections: Any, rows: Any, said: str) -> None:
    reference = np.ones(SHAPE)
    rom = reference.copy()
    for i in sections:
        rom[:, i, list(rows)] = 1.5
    found = place_beyond(_comparison(reference, rom), _band("rms_error", 0.1))
    assert found.replace("\u00a0", " ") == said


def test_where_3d_is_zero_no_place_is_claimed() -> None:
    reference = np.ones(SHAPE)
    reference[:, 0, 0] = 0.0
    assert place_beyond(_comparison(reference, np.ones(SHAPE)), _band("rms_error", 0.1)) == ""


# ---- of a whole comparison


def _bands(*bands: tuple[str, str, float, tuple[str, ...]]) -> list[dict[str, Any]]:
    names = ("quantity", "statistic", "limit", "variants")
    return [dict(zip(names, band, strict=True)) | {"reason": "r"} for band in bands]


TINY = synthetic.Setup(n_x=6, n_phi=4, n_time=9, n_y=5, i=(1, 3), j=(1, 3), variants=("none", "local"))
BOTH = ("none", "local")


def _loaded(folder: Path, models: tuple[str, ...], **changes: Any) -> Comparison:
    synthetic.write(folder, dataclasses.replace(TINY, **changes), models)
    return load(folder)


def _not_periodic(folder: Path, variant: str) -> Comparison:
    path = folder / "provenance.json"
    record = json.loads(path.read_text())
    record["variants"][variant]["reference"]["cycle_change"] = 0.083
    path.write_text(json.dumps(record))
    return load(folder)


def test_which_model_names_none_where_no_limit_judges(tmp_path: Path) -> None:
    bands = _bands(("section_flow_rate", "rms_error", 0.04, ("local",)), ("radius", "rms_error", 0.003, BOTH))
    comparison = _loaded(tmp_path, ("row", "coupled"), bands=bands)
    opening = "Which model for which question (the first one within its limits): "
    said = answer.which_model(comparison)
    assert said == (
        f"{opening}flow rate through the section: coupled in local; lumen radius: no model in none and local."
    )
    assert answer.which_model(_not_periodic(tmp_path, "none")) == said.replace("none and local", "local")
    assert answer.which_model(_not_periodic(tmp_path, "local")) == ""


def test_of_three_models_each_is_named_and_one_alone_is_2d(tmp_path: Path) -> None:
    bands = _bands(("section_flow_rate", "rms_error", 0.03, BOTH))
    three = _loaded(tmp_path / "three", ("a", "b", "c"), bands=bands)
    said = answer.answer(three, "none").replace("\u00a0", " ")
    assert said.startswith("No calcification: yes, for flow rate through the section, with the c model.")
    assert said.count("model misses") == 2
    table = heat_table(three)
    assert table is not None
    assert [(column.title, column.group) for column in table.columns[1:]] == [
        (model, variant) for variant in BOTH for model in "abc"
    ]
    one = _loaded(tmp_path / "one", ("solver",), bands=bands)
    said = answer.answer(one, "none").replace("\u00a0", " ")
    assert said == (
        "No calcification: no. The 2D model misses flow rate through the section, RMS error 4.50 %, "
        "limit 3 %, exceeded in 100 % of the cells."
    )
    assert answer.which_model(one) == ""
    assert {column.title for column in heat_table(one).columns[1:]} == {"2D"}  # type: ignore[union-attr]


def test_a_variant_that_is_not_judged_says_why(tmp_path: Path) -> None:
    comparison = _loaded(tmp_path, ("row", "coupled"), bands=_bands(("radius", "rms_error", 0.5, ("none",))))
    assert answer.answer(comparison, "local") == "Patch of calcification: not judged; no limit was declared."
    assert "yes, for lumen radius, with the row and coupled models (nearest to its limit: lumen radius, " in (
        answer.answer(comparison, "none")
    )
    assert trust_figure(comparison) is None
    said = answer.answer(_not_periodic(tmp_path, "none"), "none").replace("\u00a0", " ")
    assert said == ("No calcification: not judged; 3D is not periodic (it changes by 8.30 % over a cycle).")
    table = heat_table(_not_periodic(tmp_path, "none"))
    assert table is not None
    assert table.shade(0, 1) == "unjudged"


def test_a_missing_figure_could_not_be_judged(tmp_path: Path) -> None:
    lag = ("phase_lag", "cycle", 0.1, BOTH)
    comparison = _loaded(tmp_path / "lag", ("rom",), bands=_bands(lag))
    unknown = "could not be judged by lag of the reduced model's outlet flow behind the reference's."
    assert answer.answer(comparison, "none") == f"No calcification: no. The 2D model {unknown}"
    bands = _bands(("section_flow_rate", "rms_error", 0.01, BOTH), lag)
    said = answer.answer(_loaded(tmp_path / "both", ("rom",), bands=bands), "none")
    assert said.endswith(f"exceeded in 100\u00a0% of the cells. It {unknown}")


def test_an_error_next_to_its_limit_is_told_from_it(tmp_path: Path) -> None:
    comparison = _loaded(tmp_path, ("rom",), bands=_bands(("radius", "rms_error", 0.5, BOTH)))
    rows = json.loads((tmp_path / "metrics.json").read_text())
    for row in rows:
        if row["status"]:
            row.update(error=0.50001, status="FAIL")
    (tmp_path / "metrics.json").write_text(json.dumps(rows))
    comparison = load(tmp_path)
    assert "RMS error 50.001\u00a0%, limit 50\u00a0%" in answer.answer(comparison, "none")
    assert heat_table(comparison).rows[0][1] == "1.00002"  # type: ignore[union-attr]


def test_limits_of_what_has_no_place_are_not_claimed_on_the_map(tmp_path: Path) -> None:
    bands = _bands(
        ("radius", "rms_error", 0.01, BOTH),
        ("mean_velocity", "max_error", 0.3, BOTH),
        ("section_flow_rate", "rms_error", 0.1, BOTH),
    )
    comparison = _loaded(tmp_path / "some", ("row", "coupled"), bands=bands)
    mapped = "RMS error of lumen radius and RMS error of flow rate through the section"
    drawn = trust_figure(comparison)
    assert drawn is not None
    assert f"({mapped}; other limits have no place on it)" in drawn.caption
    found = [over_limit(comparison, row) for row in comparison.metrics.bands() if row.variant == "local"]
    maps = [each for each in found if each is not None]
    assert len(maps) == 2
    assert np.array_equal(worst_over_limits(comparison, "local"), np.maximum(*maps))  # type: ignore[arg-type]
    derived = _bands(("mean_velocity", "max_error", 0.3, BOTH))
    assert trust_figure(_loaded(tmp_path / "none", ("rom",), bands=derived)) is None
