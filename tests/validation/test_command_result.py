"""`python -m validation.compare`: what a small case leaves, from end to end."""

import json
import math
import subprocess
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import pyvista as pv
import xarray as xr
from small_case import GENEROUS, IMPOSSIBLE, bands, small_case, written
from vtkmodules.vtkIOHDF import vtkHDFReader

from cases.fields import FIELDS
from cases.quantities import tabulated
from validation.compare import command as compare

FILES = {
    *("checksums.json", "comparison.nc", "metrics.csv", "metrics.json", "provenance.json"),
    *("report.html", "report.pdf"),
}


@pytest.fixture(scope="module")
def finished(tmp_path_factory, runs_read):
    """Everything that one run leaves, reports included."""
    folder = tmp_path_factory.mktemp("finished")
    path = written(bands(small_case(), GENEROUS, IMPOSSIBLE), folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(*runs_read)
        assert compare.main([str(path), "--output", str(folder / "result")]) == 0
    return path, folder / "result"


class TestResult:
    def test_all_files_are_there_and_no_other(self, finished):
        case, result = finished
        walls = {f"{model}_{name}.vtkhdf" for model in ("rom", "reference") for name in ("none", "local")}
        assert {path.name for path in result.iterdir()} == FILES | walls
        assert sorted(path.name for path in result.parent.iterdir()) == sorted([case.name, result.name])
        assert all(path.stat().st_size for path in result.iterdir())
        assert result.stat().st_mode & 0o777 == 0o755
        assert (result / "report.pdf").read_bytes().startswith(b"%PDF")
        assert "<html" in (result / "report.html").read_text(encoding="utf-8")

    def test_comparison_holds_both_models_on_the_same_cells(self, finished):
        with xr.open_dataset(finished[1] / "comparison.nc") as data:
            sizes = dict(data.sizes)
            assert (sizes["variant"], sizes["time"], sizes["x"], sizes["phi"]) == (2, 41, 12, 8)
            assert list(data["variant"].to_numpy()) == ["none", "local"]
            for name in ("pressure", "radius", "mean_velocity", "profile_exponent", "sector_flow_rate"):
                for model in ("rom", "reference"):
                    field = data[f"{model}_{name}"]
                    assert field.dims == ("variant", "time", "x", "phi")
                    assert field.attrs["units"] == FIELDS[name].unit
                    assert field.attrs["long_name"]
                    assert np.all(np.isfinite(field))
            assert data["rom_axial_velocity"].dims[-1] == "y"
            assert data["rom_axial_velocity"].dtype == np.float32
            fields = data.drop_vars("rom_error_budget")  # NaN there: not known
            assert all(np.all(np.isfinite(fields[name])) for name in fields.data_vars)
            assert np.all(
                np.isfinite(data["rom_error_budget"].sel(quantity="pressure", part=["error", "grid"]))
            )
            assert {data[axis].attrs["units"] for axis in ("time", "x", "phi", "y")} == {"s", "m", "rad", "1"}

    def test_comparison_says_where_it_comes_from(self, finished):
        case, result = finished
        with xr.open_dataset(result / "comparison.nc") as data:
            about = data.attrs
            assert (about["case"], about["baseline"]) == ("calcification", "none")
            assert about["case_yaml"] == case.read_text(encoding="utf-8")
            assert about["period_s"] == pytest.approx(2.392 / 3, rel=1e-5)
            assert list(about["compare_i"]) == [1, 6, 12]
            assert json.loads(about["compare_time_names"]) == ["systole", "second trough", "end diastole"]
            assert all(np.min(np.abs(data["time"].to_numpy() - t)) < 1e-12 for t in about["compare_times_s"])
            assert about["Conventions"].startswith("CF")
            assert data["calcified"].sum("x").sum("phi").to_numpy().tolist() == [0, 8]

    def test_json_and_csv_hold_the_same_rows(self, finished):
        rows = json.loads((finished[1] / "metrics.json").read_text(encoding="utf-8"))
        table = pd.read_csv(finished[1] / "metrics.csv", keep_default_na=False)
        assert len(rows) == len(table) > 1000
        for row, line in zip(rows, table.to_dict("records"), strict=True):
            assert list(row) == list(line)
            for key, value in row.items():
                text = line[key]
                if value is None:
                    assert text == ""
                elif isinstance(value, str):
                    assert text == value
                else:
                    assert float(text) == value

    def test_each_value_is_in_the_dataset(self, finished):
        rows = json.loads((finished[1] / "metrics.json").read_text(encoding="utf-8"))
        compared = tabulated()
        values = [row for row in rows if row["statistic"] == "value" and row["quantity"] in compared]
        assert len(values) == 2 * (5 * 3 * 2 + 2 * 3) * 3
        with xr.open_dataset(finished[1] / "comparison.nc") as data:
            for row in values:
                where = {"variant": row["variant"], "x": data["x"][row["i"] - 1]}
                if row["j"] is not None:
                    where["phi"] = data["phi"][row["j"] - 1]
                for model in ("rom", "reference"):
                    field = data[f"{model}_{row['quantity']}"].sel(where)
                    assert field.sel(time=row["t_s"]).item() == row[model]

    def test_bands_are_judged_for_every_variant(self, finished):
        table = pd.read_csv(finished[1] / "metrics.csv")
        judged = table[table["status"].notna()]
        assert judged["status"].tolist() == ["OK", "FAIL"] * 2
        assert judged["band"].tolist() == [0.5, 1e-8] * 2
        assert judged["variant"].tolist() == ["none", "none", "local", "local"]
        repeated = judged.iloc[0]
        same = table[
            (table["variant"] == "none")
            & (table["quantity"] == "radius")
            & (table["statistic"] == "rms_error")
            & table["i"].isna()
            & table["status"].isna()
        ]
        assert same["error"].tolist() == [repeated["error"]]

    def test_walls_for_paraview_are_the_cells(self, finished):
        with xr.open_dataset(finished[1] / "comparison.nc") as data:
            last = data.sel(variant="local").isel(time=-1).load()
        for model in ("rom", "reference"):
            reader = vtkHDFReader()
            reader.SetFileName(str(finished[1] / f"{model}_local.vtkhdf"))
            reader.UpdateInformation()
            assert reader.GetNumberOfSteps() == 41
            reader.SetStep(40)
            reader.Update()
            wall = pv.wrap(reader.GetOutput())
            assert wall.n_cells == 12 * 8
            for name in ("pressure", "radius", "mean_velocity", "sector_flow_rate", "profile_exponent"):
                expected = last[f"{model}_{name}"].to_numpy().ravel()
                np.testing.assert_allclose(wall.cell_data[name], expected, rtol=1e-6)
            middle = wall.cell_centers().points.reshape(12, 8, 3)
            np.testing.assert_allclose(
                middle[..., 0], last["x"].to_numpy()[:, None] + 0 * middle[..., 0], rtol=1e-5
            )
            angle = np.arctan2(middle[..., 2], middle[..., 1]) % (2 * np.pi)
            np.testing.assert_allclose(angle, last["phi"].to_numpy() + 0 * angle, atol=0.02)

    def test_provenance_names_every_input(self, finished):
        about = json.loads((finished[1] / "provenance.json").read_text(encoding="utf-8"))
        assert about.keys() == {
            "created", "command", "git_commit", "package_version", "python", "versions", "machine",
            "case", "inputs", "wall_times_s", "notes", "variants", "bands", "warnings", "seeds",
        }  # fmt: skip
        names = {Path(item["path"]).name for item in about["inputs"]}
        runs = {f"{run}{kind}" for run in ("none", "local") for kind in RUN_FILES}
        assert names == runs | {"thesis_inlet.csv"}
        for item in about["inputs"]:
            assert item["bytes"] == Path(item["path"]).stat().st_size
            assert item["sha256"] == output_checksum(Path(item["path"]))
        assert about["variants"]["none"]["reference"]["nodes"] == 8215
        assert about["variants"]["local"]["models"]["rom"]["n_x"] == 12
        assert [band["limit"] for band in about["bands"]] == [0.5, 1e-8]
        assert any("viscosity" in note for note in about["notes"])

    def test_the_cost_of_the_3d_run_is_told(self, finished):
        rows = json.loads((finished[1] / "metrics.json").read_text(encoding="utf-8"))
        cost = {
            (row["variant"], row["quantity"]): (row["rom"], row["reference"], row["unit"])
            for row in rows
            if row["statistic"] == "cost"
        }
        about = json.loads((finished[1] / "provenance.json").read_text(encoding="utf-8"))
        steps = about["variants"]["local"]["models"]["rom"]["steps"]
        assert len(cost) == 2 * 3
        assert cost["local", "wall_time"] == (None, 881.072, "s")
        assert cost["local", "time_steps"] == (steps, 450, "1")
        assert cost["local", "iterations"] == (None, 2247, "1")
        assert about["variants"]["none"]["reference"]["cost"]["ended"] == "normally"
        report = (finished[1] / "report.html").read_text(encoding="utf-8")
        assert "14.7\u00a0min" in report

    def test_the_inputs_of_the_3d_run_are_told_beside_those_of_the_case(self, finished):
        about = json.loads((finished[1] / "provenance.json").read_text(encoding="utf-8"))
        reference = about["variants"]["local"]["reference"]
        found = {item["name"]: (item["reference"], item["case"]) for item in reference["inputs"]}
        assert found["Young's modulus of Healthy"] == (6e5, 6e5)
        assert found["Young's modulus of Calcified"] == (1e7, 1e7)
        assert found["viscosity of Blood"] == (0.0035, 0.0035)
        assert found["density of Healthy"] == (1000.0, None)
        assert "materials" not in reference
        assert any("those that the case has are the same" in note for note in about["notes"])

    def test_data_records_confirm_the_plot_file(self, finished):
        about = json.loads((finished[1] / "provenance.json").read_text(encoding="utf-8"))
        records = about["variants"]["none"]["reference"]["data_records"]
        assert [Path(record["file"]).name for record in records] == [
            "none_axis_nodes.txt",
            "none_mid_elements.txt",
        ]
        assert max(record["largest_difference"] for record in records) < 1e-7
        assert any("none_axis_nodes.txt: 7626 values" in note for note in about["notes"])
        assert about["warnings"] == []

    @pytest.mark.slow
    def test_a_second_run_gives_the_same_figures(self, finished, tmp_path, quick):
        assert compare.main([str(finished[0]), "--output", str(tmp_path / "again")]) == 0
        again, first = ((d / "metrics.csv").read_text() for d in (tmp_path / "again", finished[1]))
        assert again == first


RUN_FILES = (".xplt", ".log", "_axis_nodes.txt", "_mid_elements.txt")


def output_checksum(path):
    listed = subprocess.run(["sha256sum", str(path)], capture_output=True, text=True, check=True)  # noqa: S603, S607
    return listed.stdout.split()[0]


def test_every_number_in_metrics_is_finite_or_empty(finished):
    rows = json.loads((finished[1] / "metrics.json").read_text(encoding="utf-8"))
    assert all(math.isfinite(v) for row in rows for v in row.values() if isinstance(v, float))
