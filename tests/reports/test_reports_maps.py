import csv
import dataclasses
import io
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import synthetic_comparison as synthetic
import xarray as xr

from reports.blocks import Figure, Paragraph, Section, Table
from reports.figures.heat_maps import MapRow, Maps, heat_maps
from reports.result.load import load
from reports.sections import assumptions, dominance, exponents, maps
from reports.sections.parts.places import degrees_words

Rows = list[dict[str, Any]]


def _figure(section: Section | None) -> Figure:
    assert section
    (figure,) = (block for block in section.blocks if isinstance(block, Figure))
    return figure


def _plain(figure: Figure) -> str:
    return figure.caption.replace("\u00a0", " ")


def _tables(section: Section) -> dict[str, Table]:
    return {block.key: block for block in section.blocks if isinstance(block, Table)}


def _number(text: str) -> float:
    return float(text.replace("−", "-"))


def _cells(figure: Figure) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(figure.csv)))


def _percent(data: xr.Dataset, model: str, quantity: str) -> np.ndarray:
    """2D − 3D at the first named instant in percent of 3D, (variant, x, phi)."""
    now = data.sel(time=data.attrs["compare_times_s"][0], method="nearest")
    return np.asarray(100 * (now[f"{model}_{quantity}"] / now[f"reference_{quantity}"] - 1))


@pytest.fixture(scope="module")
def data(two_models: tuple[Path, Rows]) -> xr.Dataset:
    """All models' fields."""
    with xr.open_dataset(two_models[0] / "comparison.nc", decode_times=False) as opened:
        return opened.load()


def test_the_data_of_the_maps_are_all_cells_in_percent(
    two_models: tuple[Path, Rows], data: xr.Dataset
) -> None:
    rows = _cells(_figure(maps.section(load(two_models[0]))))
    assert len(rows) == data.sizes["x"] * data.sizes["phi"]
    for v, variant in enumerate(synthetic.VARIANTS):
        for model in ("row", "coupled"):
            for quantity in ("radius", "sector_flow_rate"):  # those that limits judge
                expected = _percent(data, model, quantity)[v]
                for row in rows:
                    at = int(row["i"]) - 1, int(row["j"]) - 1
                    said = float(row[f"{variant} {model} {quantity} percent"])
                    assert said == pytest.approx(expected[at], rel=1e-4, abs=1e-6)
                    assert float(row["x_m"]) == pytest.approx(float(data["x"][at[0]]), rel=1e-5)
                    assert float(row["phi_rad"]) == pytest.approx(float(data["phi"][at[1]]), rel=1e-5)


def test_the_data_of_the_exponents_are_all_cells(two_models: tuple[Path, Rows], data: xr.Dataset) -> None:
    rows = _cells(_figure(exponents.section(load(two_models[0]))))
    now = data.sel(time=data.attrs["compare_times_s"][0], method="nearest")
    for column, name in (("3D", "reference"), ("coupled", "coupled")):
        found = [float(row[f"local {column}"]) for row in rows]
        expected = now[f"{name}_profile_exponent"].sel(variant="local").values.ravel()
        assert found == pytest.approx(expected, rel=1e-5)


def test_a_caption_names_where_the_maps_are_farthest_apart(
    two_models: tuple[Path, Rows], data: xr.Dataset
) -> None:
    caption = _plain(_figure(maps.section(load(two_models[0]))))
    for quantity, label in (
        ("radius", "lumen radius"),
        ("sector_flow_rate", "flow rate through one sector"),
    ):
        for model in ("row", "coupled"):
            percent = _percent(data, model, quantity)
            said = re.search(
                rf"{label} ([+−][\d.]+) % \({model}, (\w+), x = ([\d.]+) mm, φ = (\d+)°\)", caption
            )
            assert said
            assert abs(_number(said[1])) == pytest.approx(np.abs(percent).max(), abs=0.051)
            i = int(np.abs(1e3 * data["x"].values - float(said[3])).argmin())
            j = int(np.abs(np.degrees(data["phi"].values) - float(said[4])).argmin())
            there = percent[synthetic.VARIANTS.index(said[2]), i, j]
            assert there == pytest.approx(_number(said[1]), abs=0.051)


def test_scales_of_the_maps_end_at_the_limits(two_models: tuple[Path, Rows], tmp_path: Path) -> None:
    caption = _plain(_figure(maps.section(load(two_models[0]))))
    sector = "flow rate through one sector ±4 % (the limit of the flow rate through the section)"
    assert f"scales end at the limits: lumen radius ±0.5 % and {sector}." in caption
    synthetic.write(tmp_path, synthetic.Setup(variants=("local",), baseline="", bands=[]))
    caption = _plain(_figure(maps.section(load(tmp_path))))
    assert "lumen radius ±1 % (no limit)" in caption


def test_the_worst_fit_is_named(finished: tuple[Path, Rows]) -> None:
    comparison = load(finished[0])
    errors = comparison.maps["reference_profile_error"].values
    assert (
        f"by {100 * np.median(errors):.2f} % in the median, by {100 * errors.max():.2f} % at most"
    ) in _plain(_figure(exponents.section(comparison)))


def test_an_infinite_exponent_is_drawn_and_said_not_to_be_compared(
    tmp_path: Path, small: synthetic.Setup
) -> None:
    arrays = synthetic.fields(small)
    synthetic.write(tmp_path, small)
    for model in ("rom", "reference"):
        arrays[f"{model}_profile_exponent"][:] = np.inf
    arrays["reference_profile_error"][:] = np.nan
    synthetic.dataset(small, arrays).to_netcdf(tmp_path / "comparison.nc")
    figure = _figure(exponents.section(load(tmp_path)))
    assert "γ is nowhere finite" in figure.caption
    assert figure.drawing()


def test_without_instants_there_are_no_maps(tmp_path: Path, small: synthetic.Setup) -> None:
    synthetic.write(tmp_path, dataclasses.replace(small, time_names=()))
    comparison = load(tmp_path)
    assert maps.section(comparison) is None
    assert exponents.section(comparison) is None


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
    tables = _tables(dominance.tables(comparison))
    values = {
        (row["quantity"], row["variant"], row["i"], row["j"]): row["reference"]
        for row in rows
        if row["statistic"] == "value"
    }
    for quantity in ("axial_dominance_radial", "axial_dominance_azimuthal"):
        table = tables[f"{quantity.replace('_', '-')}-{comparison.i[0]}"]
        assert [row[0] for row in table.rows] == ["none", "axisymmetric", "local", "local"]
        for row in table.rows:
            (j,) = (j for j in comparison.j if degrees_words(comparison, j) == row[1])
            for i, text in zip(comparison.i, row[2:], strict=True):
                value = values[quantity, row[0], i, j]
                assert _number(text) == pytest.approx(value, abs=5.001e-4)
    ratios = comparison.fields["reference_axial_dominance_radial"].values[:, :-1]  # the outlet's is no flow's
    sentence = dominance.section(comparison).blocks[0]
    assert isinstance(sentence, Paragraph)
    largest = f"the largest ratio before the outlet, |v_r|/v_x = {ratios.max():.3f}"
    assert f"not everywhere small beside v_x: {largest}" in sentence.text


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
    x, phi = (float(comparison.fields[axis][at]) for axis, at in (("x", i - 1), ("phi", j)))
    where = f"x = {1e3 * x:.1f} mm, φ = {np.degrees(phi):.0f}°"
    assert f"largest in variant local at {where}, |v_r|/v_x = 1.217" in text
    assert ("jumps from one cell to the next" in text) == told
    line = next(
        row for row in _tables(dominance.tables(comparison))["largest-dominance"].rows if row[0] == "local"
    )
    assert [line[3], line[4].replace("\u00a0", " ")] == ["1.217", where]
    figures = _tables(assumptions.section(comparison))["assumption-figures"]
    assert next(row for row in figures.rows if row[0] == "no radial velocity")[-1] == "1.217"


@pytest.mark.parametrize(
    ("along", "cells"),
    [
        ((0.1, 0.3, 0.2, 0.05, 0.06, 0.1, 0.2), 3),  # rises from the fourth on
        ((0.1, 0.3, 0.2, 0.05, 0.06, 0.2, 0.1), 1),
        ((0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7), 3),  # no longer than a radius
    ],
)
def test_what_the_outlets_condition_makes_is_left_out(
    finished: tuple[Path, Rows], along: tuple[float, ...], cells: int
) -> None:
    comparison = load(finished[0])
    fields = comparison.fields.isel(x=slice(0, 7)).assign_coords(x=1e-3 * np.arange(7.0))
    name = "reference_axial_dominance_radial"
    rising = fields[name] * 0 + xr.DataArray(np.array(along), dims="x")
    radius = fields["rom_radius"] * 0 + 2.5e-3
    changed = dataclasses.replace(comparison, fields=fields.assign({name: rising, "rom_radius": radius}))
    assert dominance.outlet_cells(changed) == cells
    found = dominance.largest_inside(changed, "axial_dominance_radial", "local")
    assert found is not None
    assert found[:2] == (pytest.approx(max(along[:-cells])), "local")


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
    names = [f"reference_axial_dominance_{way}" for way in ("radial", "azimuthal")]
    with xr.open_dataset(tmp_path / "comparison.nc", decode_times=False) as opened:
        without = opened.load().drop_vars(names)
    (tmp_path / "comparison.nc").unlink()
    without.to_netcdf(tmp_path / "comparison.nc")
    section = dominance.section(load(tmp_path))
    assert [type(block) for block in section.blocks] == [Paragraph]
    assert section.blocks[0].text.endswith("How small they are in 3D was not measured.")
    assert dominance.tables(load(tmp_path)) is None


def test_dominance_is_drawn_of_the_models_that_have_it(two_models: tuple[Path, Rows]) -> None:
    comparison = load(two_models[0])
    row = comparison.of("row")
    without = row.fields.drop_vars("rom_axial_dominance_radial")
    views = comparison.views | {"row": dataclasses.replace(row, fields=without)}
    section = dominance.section(dataclasses.replace(comparison, fields=without, views=views))
    columns = set(_cells(_figure(section))[0]) - {"i", "j", "x_m", "phi_rad"}
    assert columns == {f"{name} {side}" for name in synthetic.VARIANTS for side in ("3D", "coupled")}


def test_the_sections_are_in_the_order_of_reading(two_models: tuple[Path, Rows]) -> None:
    page = (two_models[0] / "report.html").read_text(encoding="utf-8")
    found = re.findall(r'<h2 id="([\w-]+)">', page)
    read = ["answer", "overview", "moved", "profiles", "agreement", "maps", "exponents", "dominance"]
    read += ["assumptions", "budget", "artery", "provenance"]
    assert found == [*read, "verdict", "budget-tables", *found[len(read) + 2 :]]
    assert found[-1] == "settings"
