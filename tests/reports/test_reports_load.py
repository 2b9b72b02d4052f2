import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import synthetic_comparison as synthetic
import xarray as xr

from reports.__main__ import main
from reports.errors import ReportError
from reports.load import load


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
        found.curves["rom_radius"].values, arrays["rom_radius"][:, :, [k - 1 for k in setup.i]]
    )
    states = synthetic.states(setup, arrays)
    at = (2, states[1], setup.i[3] - 1, setup.j[2] - 1)
    np.testing.assert_array_equal(
        found.profiles["reference_axial_velocity"].values[2, 1, 3, 2], arrays["reference_axial_velocity"][at]
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
            lambda d: d.assign(wall_stiffness=d["wall_stiffness"].transpose("x", "variant", "phi")),
            "dimensions",
        ),
        (lambda d: d.assign_attrs(compare_i=np.array([0, 3])), "compare_i is .0, 3.; .* 1 … 12"),
        (lambda d: d.assign_attrs(compare_j=np.array([9])), "compare_j"),
        (lambda d: d.assign_attrs(baseline="healthy"), "baseline 'healthy'"),
        (lambda d: d.assign_attrs(compare_times_s=np.array([0.1234])), "no state at 0.1234 s .systole."),
        (lambda d: d.assign_attrs(compare_times_s=np.array([0.0, 0.1])), "2 compare_times_s"),
        (lambda d: d.assign_attrs(compare_time_names="systole"), "compare_time_names"),
    ],
)
def test_a_dataset_that_does_not_fit_is_refused(
    tmp_path: Path, small: synthetic.Setup, change: Callable[[xr.Dataset], xr.Dataset], message: str
) -> None:
    synthetic.write(tmp_path, small)
    _change_dataset(tmp_path, change)
    with pytest.raises(ReportError, match=message):
        load(tmp_path)


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
        (lambda rows: rows[0].update(status="GOOD"), "row 1: status 'GOOD'"),
        (lambda rows: rows[0].update(rom="4.7"), "row 1: rom is '4.7'"),
        (lambda rows: rows[0].update(variant=3), "row 1: variant is 3"),
        (lambda rows: rows.append("row"), "an object is expected"),
    ],
)
def test_a_row_of_metrics_that_does_not_fit_is_named(
    tmp_path: Path, small: synthetic.Setup, change: Callable[[Any], object], message: str
) -> None:
    synthetic.write(tmp_path, small)
    _change_json(tmp_path / "metrics.json", change)
    with pytest.raises(ReportError, match=message):
        load(tmp_path)


def test_a_missing_key_of_provenance_is_named(tmp_path: Path, small: synthetic.Setup) -> None:
    synthetic.write(tmp_path, small)
    _change_json(tmp_path / "provenance.json", lambda p: p.pop("inputs"))
    with pytest.raises(ReportError, match="without inputs"):
        load(tmp_path)


def test_a_key_of_provenance_of_another_type_is_named(tmp_path: Path, small: synthetic.Setup) -> None:
    synthetic.write(tmp_path, small)
    _change_json(tmp_path / "provenance.json", lambda p: p.update(inputs="none.xplt"))
    with pytest.raises(ReportError, match=r"inputs is 'none\.xplt'; list is expected"):
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
