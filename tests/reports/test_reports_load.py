import dataclasses
import hashlib
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import synthetic_comparison as synthetic
import xarray as xr

from reports.command import main
from reports.errors import ReportError
from reports.result.load import load


def _change_dataset(directory: Path, change: Callable[[xr.Dataset], xr.Dataset]) -> None:
    path = directory / "comparison.nc"
    with xr.open_dataset(path, decode_times=False) as opened:
        changed = change(opened.load())
    path.unlink()
    changed.to_netcdf(path, engine="netcdf4")


def _change_json(path: Path, change: Callable[[Any], object]) -> None:
    content = json.loads(path.read_text())
    change(content)
    path.write_text(json.dumps(content))


def test_what_is_read_is_what_was_written(tmp_path: Path) -> None:
    setup = synthetic.Setup()
    synthetic.write(tmp_path, setup)
    arrays = synthetic.fields(setup)
    found = load(tmp_path)
    assert found.variants == setup.variants
    assert (found.i, found.j) == (setup.i, setup.j)
    np.testing.assert_array_equal(
        found.fields["rom_radius"].values[:, :, [k - 1 for k in setup.i]],
        arrays["rom_radius"][:, :, [k - 1 for k in setup.i]],
    )
    states = synthetic.states(setup, arrays)
    at = (2, states[1], setup.i[3] - 1, setup.j[2] - 1)
    np.testing.assert_array_equal(
        found.profiles["reference_axial_velocity"].values[2, found.states[1], 3, 2],
        arrays["reference_axial_velocity"][at],
    )
    assert found.wall_varies_around == {"none": False, "axisymmetric": False, "local": True}
    assert found.rows_of("none") == setup.j[:1]
    assert found.rows_of("local") == setup.j


@pytest.mark.parametrize("name", ["comparison.nc", "metrics.json", "provenance.json"])
def test_a_missing_file_is_named(tmp_path: Path, small: synthetic.Setup, name: str) -> None:
    synthetic.write(tmp_path, small)
    (tmp_path / name).unlink()
    with pytest.raises(ReportError, match=f"{name}: no such file"):
        load(tmp_path)


@pytest.mark.parametrize("name", ["comparison.nc", "metrics.json", "provenance.json"])
def test_a_file_of_another_kind_is_named(tmp_path: Path, small: synthetic.Setup, name: str) -> None:
    synthetic.write(tmp_path, small)
    (tmp_path / name).write_text("not what the name says")
    with pytest.raises(ReportError, match=f"{name}: cannot be read as"):
        load(tmp_path)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d.drop_vars("rom_radius"), "without variable rom_radius"),
        (lambda d: d.drop_vars("phi"), "without coordinate phi"),
        (
            lambda d: d.assign(rom_wall_stiffness=d["rom_wall_stiffness"].transpose("x", "variant", "phi")),
            "dimensions",
        ),
        (lambda d: d.assign_attrs(compare_i=np.array([0, 3])), "compare_i is .0, 3.; .* 1 … 12"),
        (lambda d: d.assign_attrs(compare_j=np.array([9])), "compare_j"),
        (lambda d: d.assign_attrs(baseline="healthy"), "baseline 'healthy'"),
        (lambda d: d.assign_attrs(compare_times_s=np.array([0.1234])), "no state at 0.1234 s .systole."),
        (lambda d: d.assign_attrs(compare_times_s=np.array([0.0, 0.1])), "2 compare_times_s"),
        (lambda d: d.assign_attrs(compare_time_names="systole"), "compare_time_names"),
        (lambda d: d.assign_attrs(compare_time_names=9999 * "["), "compare_time_names"),
        (lambda d: d.assign_attrs(compare_time_names="[1]"), "compare_time_names"),
        (lambda d: d.assign_attrs(compare_time_names=3), "compare_time_names is .*3.*; text is expected"),
        (lambda d: d.assign_attrs(compare_times_s="systole"), "compare_times_s is 'systole'; finite numbers"),
        (lambda d: d.assign_attrs(compare_times_s=np.nan), "compare_times_s is .*nan.*; finite numbers"),
        (lambda d: d.assign_attrs(period_s="0.8 s"), "period_s is '0.8 s'; finite numbers"),
        (lambda d: d.assign_attrs(period_s=0.0), "period_s is .*0.0.*; one positive number"),
        (lambda d: d.assign_attrs(compare_i="1 2"), "compare_i is '1 2'; whole numbers"),
        (lambda d: d.assign_attrs(compare_i=np.array([1.5])), "compare_i is .*1.5.*; whole numbers"),
        (lambda d: d.assign_attrs(case="other"), "case is 'synthetic'; comparison.nc is of 'other'"),
        (lambda d: d.assign_attrs(case_yaml="name: other"), "sha256 is .* not that of the case file's text"),
        (lambda d: d.assign_coords(variant=["ring"]), "variant 'local' is none of ring"),
        (lambda d: d.assign_coords(time=d["time"].values[::-1]), "time does not increase"),
        (lambda d: d.assign_attrs(baselines="{"), "baselines is '{'; a JSON object"),
        (
            lambda d: d.assign_attrs(baselines='{"local": "healthy"}'),
            "baselines is .*a variant for a variant",
        ),
        (lambda d: d.assign_coords(x=[f"{x} m" for x in d["x"].values]), "x is of type .*; numbers are"),
        (lambda d: d.isel(phi=[]).drop_encoding(), "nothing along phi"),
    ],
)
def test_a_dataset_that_does_not_fit_is_refused(
    tmp_path: Path, small: synthetic.Setup, change: Callable[[xr.Dataset], xr.Dataset], message: str
) -> None:
    synthetic.write(tmp_path, small)
    _change_dataset(tmp_path, change)
    with pytest.raises(ReportError, match=message):
        load(tmp_path)


def test_a_netcdf_file_cut_short_is_refused(tmp_path: Path, small: synthetic.Setup) -> None:
    synthetic.write(tmp_path, dataclasses.replace(small, n_time=2, n_x=6, n_y=3, time_names=()))
    path = tmp_path / "comparison.nc"
    whole = path.read_bytes()
    path.unlink()
    for cut in range(0, len(whole), len(whole) // 8):
        path.write_bytes(whole[:cut])
        with pytest.raises(ReportError, match=r"comparison\.nc: cannot be read as NetCDF-4"):
            load(tmp_path)
        path.unlink()


def test_a_missing_attribute_is_named(tmp_path: Path, small: synthetic.Setup) -> None:
    def without_period(dataset: xr.Dataset) -> xr.Dataset:
        del dataset.attrs["period_s"]
        return dataset

    synthetic.write(tmp_path, small)
    _change_dataset(tmp_path, without_period)
    with pytest.raises(ReportError, match="without attribute period_s"):
        load(tmp_path)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda rows: rows[1].pop("unit"), "row 2: without unit"),
        (lambda rows: rows[0].update(status="GOOD"), "row 1, status: .* found 'GOOD'"),
        (lambda rows: rows[0].update(rom="4.7"), "row 1, rom: .* found '4.7'"),
        (lambda rows: rows[0].update(variant=3), "row 1, variant: .* found 3"),
        (lambda rows: rows.append("row"), "row 73: .* an object, found 'row'"),
        (lambda rows: rows[1].update(i=math.inf), "row 2, i: .* found inf"),
        (lambda rows: rows[1].update(i=0), "row 2, i: .* found 0"),
        (lambda rows: rows[1].update(rom=math.nan), "row 2, rom: .* finite"),
        (lambda rows: rows[1].update(rom=10**400), "row 2, rom: "),
        (
            lambda rows: rows[1].update(case="other"),
            "row 2: case is 'other'; comparison.nc is of 'synthetic'",
        ),
        (lambda rows: rows[1].update(variant="ring"), "row 2: variant 'ring' is none of local"),
        (lambda rows: rows.clear(), "without any row"),
    ],
)
def test_a_row_of_metrics_that_does_not_fit_is_named(
    tmp_path: Path, small: synthetic.Setup, change: Callable[[Any], object], message: str
) -> None:
    synthetic.write(tmp_path, small)
    _change_json(tmp_path / "metrics.json", change)
    with pytest.raises(ReportError, match=message):
        load(tmp_path)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"status": "OK"}, "status is 'OK', but an error of 0.03 with a band of 0.02 gives 'FAIL'"),
        ({"error": -0.02, "status": "FAIL"}, "gives 'OK'"),
        ({"error": None}, "gives 'MISSING'"),
        ({"band": None}, "gives ''"),
        ({"status": ""}, "status is ''"),
        ({"band": -0.02, "status": "FAIL"}, "band: .* greater than or equal to 0"),
    ],
)
def test_a_verdict_that_contradicts_its_numbers_is_refused(
    tmp_path: Path, small: synthetic.Setup, change: dict[str, Any], said: str
) -> None:
    rows = synthetic.write(tmp_path, small)
    number = next(k for k, row in enumerate(rows, start=1) if row["status"])
    rows[number - 1].update({"error": 0.03, "band": 0.02, "status": "FAIL"} | change)
    (tmp_path / "metrics.json").write_text(json.dumps(rows))
    with pytest.raises(ReportError, match=f"row {number}.*{said}"):
        load(tmp_path)


def _set(*keys: str | int, value: object) -> Callable[[Any], object]:
    def change(content: Any) -> None:
        for key in keys[:-1]:
            content = content[key]
        content[keys[-1]] = value

    return change


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda p: p.pop("inputs"), "without inputs"),
        (_set("inputs", value="none.xplt"), r"inputs: .* found 'none\.xplt'"),
        (_set("inputs", 0, value="none.xplt"), r"inputs, row 1: .* found 'none\.xplt'"),
        (_set("variants", value="local"), "variants: .* found 'local'"),
        (_set("variants", "local", value="local"), "variants, local: .* found 'local'"),
        (_set("variants", "local", "models", "rom", value=[]), "variants, local, models, rom: "),
        (
            _set("variants", "ring", value={"models": {"rom": {}}, "reference": {}}),
            "variants are local, ring; ",
        ),
        (_set("variants", value={}), "variants are none; comparison.nc has local"),
        (
            _set("variants", "local", "reference", "coverage", value=1.2),
            "coverage: .* less than or equal to 1",
        ),
        (_set("variants", "local", "reference", "coverage", value="all"), "coverage: .* found 'all'"),
        (
            _set("variants", "local", "models", "rom", "cycle_change", value=math.nan),
            "cycle_change: .* found nan",
        ),
        (_set("bands", 0, value="radius"), "bands, row 1: .* found 'radius'"),
        (_set("bands", 0, "limit", value="2 %"), "bands, row 1, limit: .* found '2 %'"),
        (_set("bands", 0, "variants", value=["ring"]), "bands, row 1: variant 'ring' is none of local"),
        (_set("warnings", value=[{}]), "warnings, row 1: "),
        (_set("notes", value="none"), "notes: .* found 'none'"),
        (_set("case", "sha256", value=64 * "0"), "case, sha256 is 0000"),
        (_set("case", value="case.yaml"), r"case: .* found 'case\.yaml'"),
        (_set("wall_times_s", "metrics", value="2 s"), "wall_times_s, metrics: .* found '2 s'"),
        (_set("machine", value=3), "machine: .* found 3"),
    ],
)
def test_provenance_that_does_not_fit_is_refused(
    tmp_path: Path, small: synthetic.Setup, change: Callable[[Any], object], message: str
) -> None:
    synthetic.write(tmp_path, small)
    _change_json(tmp_path / "provenance.json", change)
    with pytest.raises(ReportError, match=message) as refused:
        load(tmp_path)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("name", ["metrics.json", "provenance.json"])
@pytest.mark.parametrize(
    "text", [100_000 * "[", 100_000 * '{"a":', "[" + 9999 * "9" + "]", '["\\ud800"]', "", "null", "\ufeff{}"]
)
def test_no_json_makes_a_traceback(tmp_path: Path, small: synthetic.Setup, name: str, text: str) -> None:
    synthetic.write(tmp_path, small)
    (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(ReportError, match=name):
        load(tmp_path)


@pytest.mark.parametrize(
    "text", [synthetic.CASE_YAML.replace("\n", "\r\n"), "\ufeff" + synthetic.CASE_YAML, synthetic.CASE_YAML]
)
def test_line_endings_and_marks_do_not_make_another_case_file(
    tmp_path: Path, small: synthetic.Setup, text: str
) -> None:
    synthetic.write(tmp_path, small)
    digest = hashlib.sha256(text.encode()).hexdigest()
    _change_json(tmp_path / "provenance.json", _set("case", "sha256", value=digest))
    assert load(tmp_path).case_yaml == synthetic.CASE_YAML


@pytest.mark.parametrize("value", [math.nan, math.inf])
@pytest.mark.parametrize(
    "name",
    [
        "rom_pressure",
        "reference_radius",
        "reference_section_flow_rate",
        "rom_axial_velocity",
        "rom_wall_stiffness",
        "reference_profile_exponent",
        "time",
    ],
)
def test_values_that_are_no_numbers_are_refused(
    tmp_path: Path, small: synthetic.Setup, name: str, value: float
) -> None:
    def spoil(dataset: xr.Dataset) -> xr.Dataset:
        values = dataset[name].values.copy()
        shown = dataset[name].dims.index("x") if "y" in dataset[name].dims else None
        at = [-1] * values.ndim
        if shown is not None:
            at[shown] = small.i[0] - 1  # profiles are read in the shown sections only
        values[tuple(at)] = value
        return dataset.assign({name: (dataset[name].dims, values)})

    synthetic.write(tmp_path, small)
    _change_dataset(tmp_path, spoil)
    if name == "reference_profile_exponent" and math.isinf(value):  # plug flow
        assert load(tmp_path).variants == small.variants
    else:
        with pytest.raises(ReportError, match=f"{name} has 1 values that are not finite"):
            load(tmp_path)


def test_the_command_reports_bad_input_in_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.argv", ["reports", str(tmp_path)])
    assert main() == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.count("\n") == 1
    assert "comparison.nc: no such file" in said.err
    assert list(tmp_path.iterdir()) == []
