import csv
import dataclasses
import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import synthetic_comparison as synthetic
import xarray as xr

from reports.blocks import Figure, Paragraph, Section, Subsection, Table
from reports.build import write_reports
from reports.figures.heat_maps import MapRow, Maps, heat_maps
from reports.result.load import load
from reports.sections import assumptions, dominance, exponents, maps

Rows = list[dict[str, Any]]


def _figures(section: Section) -> list[Figure]:
    return [
        block
        for part in section.blocks
        if isinstance(part, Subsection)
        for block in part.blocks
        if isinstance(block, Figure) and block.key.endswith("-figure")
    ]


def _tables(section: Section) -> dict[str, Table]:
    return {block.key: block for block in section.blocks if isinstance(block, Table)}


def _number(text: str) -> float:
    return float(text.replace("−", "-"))


@pytest.mark.parametrize("build", [maps.section, exponents.section])
def test_the_data_of_maps_are_all_cells_of_the_models(finished: tuple[Path, Rows], build: Any) -> None:
    directory, _ = finished
    figure = _figures(build(load(directory)))[2]
    rows = list(csv.DictReader(io.StringIO(figure.csv)))
    with xr.open_dataset(directory / "comparison.nc", decode_times=False) as data:
        local = data.sel(variant="local")
        assert len(rows) % (data.sizes["x"] * data.sizes["phi"]) == 0
        for row in rows[::37]:
            at = local.isel(x=int(row["i"]) - 1, phi=int(row["j"]) - 1).sel(
                time=float(row["t_s"]), method="nearest"
            )
            for name in ("x", "phi"):
                unit = {"x": "x_m", "phi": "phi_rad"}[name]
                assert float(row[unit]) == pytest.approx(float(at[name]), rel=1e-5)
            for name in ("rom_profile_exponent", "reference_profile_exponent"):
                assert float(row[name]) == pytest.approx(float(at[name]), rel=1e-5)


def test_a_caption_names_where_the_maps_are_farthest_apart(finished: tuple[Path, Rows]) -> None:
    comparison = load(finished[0])
    figure = _figures(maps.section(comparison))[1]
    data = comparison.maps.sel(variant="axisymmetric").isel(time=0)
    difference = (data["rom_pressure"] - data["reference_pressure"]).values
    i, j = np.unravel_index(np.abs(difference).argmax(), difference.shape)
    said = figure.caption.replace("\u00a0", " ")
    assert f"pressure {difference[i, j]:+.0f} Pa (i = {i + 1}, j = {j + 1})".replace("-", "−") in said
    assert "Framed: the calcified cells." in said


def test_without_calcification_nothing_is_outlined(finished: tuple[Path, Rows]) -> None:
    assert "Framed" not in _figures(maps.section(load(finished[0])))[0].caption


def test_the_worst_fit_is_named(finished: tuple[Path, Rows]) -> None:
    comparison = load(finished[0])
    errors = comparison.maps["reference_profile_error"].sel(variant="local").values
    caption = _figures(exponents.section(comparison))[2].caption.replace("\u00a0", " ")
    assert (
        f"by {100 * np.median(errors):.2f} % in the median, by {100 * errors.max():.2f} % at most" in caption
    )


def test_an_infinite_exponent_is_drawn_and_said_not_to_be_compared(
    tmp_path: Path, small: synthetic.Setup
) -> None:
    arrays = synthetic.fields(small)
    synthetic.write(tmp_path, small)
    for model in ("rom", "reference"):
        arrays[f"{model}_profile_exponent"][:] = np.inf
    arrays["reference_profile_error"][:] = np.nan
    synthetic.dataset(small, arrays).to_netcdf(tmp_path / "comparison.nc")
    comparison = load(tmp_path)
    assert "γ is nowhere finite" in _figures(exponents.section(comparison))[0].caption
    assert "velocity-profile exponent nowhere finite" in _figures(maps.section(comparison))[0].caption


def test_without_instants_there_are_no_maps(tmp_path: Path, small: synthetic.Setup) -> None:
    synthetic.write(tmp_path, dataclasses.replace(small, time_names=()))
    comparison = load(tmp_path)
    for section in (maps.section(comparison), exponents.section(comparison)):
        assert [type(block) for block in section.blocks] == [Paragraph]


def test_cells_are_images_within_a_drawing_that_does_not_change() -> None:
    x, phi = np.linspace(0.5, 14.5, 15), np.linspace(15.0, 345.0, 12)
    values = np.add.outer(x, phi)
    groups = (Maps((values, values + 1), "R (mm)"), Maps((values - 200,), "2D − 3D", difference=True))
    ring = np.zeros(values.shape, dtype=bool)
    ring[5:10] = True
    drawings = [heat_maps(x, phi, ("3D", "2D", "2D − 3D"), [MapRow("", groups)], ring) for _ in range(2)]
    assert drawings[0] == drawings[1]
    assert drawings[0].count("<image") >= 3


def test_dominance_tables_hold_the_metrics(finished: tuple[Path, Rows]) -> None:
    directory, rows = finished
    comparison = load(directory)
    tables = _tables(dominance.section(comparison))
    values = {
        (row["quantity"], row["variant"], row["i"], row["j"]): row["reference"]
        for row in rows
        if row["statistic"] == "value"
    }
    for quantity in ("axial_dominance_radial", "axial_dominance_azimuthal"):
        table = tables[f"{quantity.replace('_', '-')}-{comparison.i[0]}"]
        assert [row[0] for row in table.rows] == ["none", "axisymmetric", "local", "local"]
        for row in table.rows:
            for i, text in zip(comparison.i, row[2:], strict=True):
                value = values[quantity, row[0], i, int(row[1])]
                assert _number(text) == pytest.approx(value, abs=5.001e-4)
    worst = max(row["reference"] for row in rows if row["quantity"] == "axial_dominance_radial")
    sentence = dominance.section(comparison).blocks[0]
    assert isinstance(sentence, Paragraph)
    assert f"not everywhere small beside v_x: the largest ratio, |v_r|/v_x = {worst:.3f}" in sentence.text


@pytest.mark.parametrize(("beside", "told"), [(True, True), (False, False)])
def test_where_the_2d_model_has_its_largest_radial_velocity(
    tmp_path: Path, small: synthetic.Setup, beside: bool, told: bool
) -> None:
    """It has a place of its own, and is explained where the wall jumps there."""
    rows = synthetic.write(tmp_path, small)
    with xr.open_dataset(tmp_path / "comparison.nc", decode_times=False) as data:
        inside = data["calcified"].sel(variant="local").values
    j = int(np.flatnonzero(inside.any(axis=0))[0])
    edge = int(np.flatnonzero(inside[:, j])[0])
    i = edge + 1 if beside else 1
    three = next(
        row for row in rows if row["quantity"] == "axial_dominance_radial" and row["statistic"] == "largest"
    )
    own = {**three, "variant": "local", "reference": None, "rom": 1.217, "i": i, "j": j + 1}
    (tmp_path / "metrics.json").write_text(json.dumps([*rows, own]))
    comparison = load(tmp_path)
    section = dominance.section(comparison)
    assert isinstance(section.blocks[0], Paragraph)
    text = section.blocks[0].text.replace("\u00a0", " ")
    assert f"largest in variant local at i = {i}, j = {j + 1}, |v_r|/v_x = 1.217" in text
    assert ("jumps from one cell to the next" in text) == told
    line = next(row for row in _tables(section)["largest-dominance"].rows if row[0] == "local")
    assert [line[3], line[4].replace("\u00a0", " ")] == ["1.217", f"i = {i}, j = {j + 1}"]
    figures = _tables(assumptions.section(comparison))["assumption-figures"]
    assert next(row for row in figures.rows if row[0] == "no radial velocity")[-1] == "1.217"


def test_assumptions_are_those_of_both_models(finished: tuple[Path, Rows]) -> None:
    directory, _ = finished
    table = _tables(assumptions.section(load(directory)))["assumption-figures"]
    found = {row[0]: [text.replace("\u00a0", " ") for text in row[2:]] for row in table.rows}
    with xr.open_dataset(directory / "comparison.nc", decode_times=False) as data:
        for model, column in (("reference", 4), ("rom", 5)):
            pressure = data[f"{model}_pressure"].sel(variant="local").values
            said = found["the pressure is uniform over a section"][column]
            assert float(said.removesuffix(" Pa")) == pytest.approx(np.ptp(pressure, axis=-1).max(), rel=6e-3)
    assert found["the blood flows forward"] == ["0 %", "—"] * 3
    assert found["mass is conserved"][1] == "< 0.01 %"


def test_an_older_result_without_dominance_is_shown(tmp_path: Path, small: synthetic.Setup) -> None:
    rows = synthetic.write(tmp_path, small)
    kept = [row for row in rows if "dominance" not in row["quantity"]]
    (tmp_path / "metrics.json").write_text(json.dumps(kept))
    section = dominance.section(load(tmp_path))
    assert [type(block) for block in section.blocks] == [Paragraph]


def test_the_sections_are_in_the_order_of_reading(tmp_path: Path, small: synthetic.Setup) -> None:
    synthetic.write(tmp_path, small)
    page = write_reports(tmp_path)[0].read_text(encoding="utf-8")
    keys = ("verdict", "change", "cycle", "profiles", "exponents", "maps", "dominance", "assumptions")
    places = [page.index(f'<h2 id="{key}">') for key in (*keys, "provenance")]
    assert places == sorted(places)
