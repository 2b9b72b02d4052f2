"""`python -m validation.compare`: a small case from end to end, and every kind of wrong input."""

import json
import math
import os
import shlex
import signal
import subprocess
import sys
import threading
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import pyvista as pv
import xarray as xr
from small_case import ROOT, RUNS, bands, small_case, written
from tube_plot import VARIABLES, write_tube
from tubes import Tube
from vtkmodules.vtkIOHDF import vtkHDFReader

from cases.fields import FIELDS
from febio_io.feb import command as feb_command
from validation import cached_runs, compare, febio_reference, output
from validation.metrics import CELL_QUANTITIES, SECTION_QUANTITIES

FILES = {"comparison.nc", "metrics.csv", "metrics.json", "provenance.json", "report.html", "report.pdf"}
GENEROUS = ("radius", "rms_error", "50 %")
IMPOSSIBLE = ("radius", "rms_error", "0.000001 %")
SHORT = Tube(sectors=8, rings=2, stacks=6, layers=1)


@pytest.fixture
def quick(monkeypatch):
    """Without drawing reports."""
    monkeypatch.setattr(compare, "write_reports", lambda directory: None)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A case against a small tube, which a second suffices for."""
    plot = write_tube(tmp_path_factory.mktemp("tube") / "tube.xplt", SHORT, np.linspace(0.0, 0.79, 5))

    def case(*declared):
        content = bands(small_case("none"), *declared)
        content["reference"] |= {"lumen": ["Blood"], "wall": ["Wall"], "time_offset": "0 s"}
        content["variants"]["none"]["reference"] = {"plot_file": str(plot)}
        return content

    return case


@pytest.fixture
def refused(tmp_path, capsys, quick):
    """Run a case that must be refused; give its one line."""

    def line(case, *options):
        result = tmp_path / "out" / "result"
        result.parent.mkdir()
        path = case if isinstance(case, Path) else written(case, tmp_path)
        assert compare.main([str(path), "--output", str(result), *options]) == 2
        captured = capsys.readouterr()
        assert captured.out == ""
        assert "Traceback" not in captured.err
        assert list(result.parent.iterdir()) == []
        lines = captured.err.splitlines()
        assert len(lines) == 1, captured.err
        return lines[0].replace(f"{tmp_path}/", "")

    return line


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """Everything that one run leaves, reports included."""
    folder = tmp_path_factory.mktemp("finished")
    path = written(bands(small_case(), GENEROUS, IMPOSSIBLE), folder)
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
            assert all(np.all(np.isfinite(data[name])) for name in data.data_vars)
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
        compared = (*CELL_QUANTITIES, *SECTION_QUANTITIES)
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
            for name in CELL_QUANTITIES:
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
        assert about["variants"]["local"]["rom"]["n_x"] == 12
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
        steps = about["variants"]["local"]["rom"]["steps"]
        assert len(cost) == 2 * 3
        assert cost["local", "wall_time"] == (None, 881.072, "s")
        assert cost["local", "time_steps"] == (steps, 450, "1")
        assert cost["local", "iterations"] == (None, 2247, "1")
        assert about["variants"]["none"]["reference"]["cost"]["ended"] == "normally"
        report = (finished[1] / "report.html").read_text(encoding="utf-8")
        assert "14.7\u00a0min" in report

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

    def test_a_second_run_gives_the_same_figures(self, finished, tmp_path, quick):
        assert compare.main([str(finished[0]), "--output", str(tmp_path / "again")]) == 0
        again, first = ((d / "metrics.csv").read_text() for d in (tmp_path / "again", finished[1]))
        assert again == first


RUN_FILES = (".xplt", ".log", "_axis_nodes.txt", "_mid_elements.txt")


def output_checksum(path):
    listed = subprocess.run(["sha256sum", str(path)], capture_output=True, text=True, check=True)  # noqa: S603, S607
    return listed.stdout.split()[0]


@pytest.mark.parametrize(
    ("band", "options", "status"),
    [(IMPOSSIBLE, ["--check"], 1), (GENEROUS, ["--check"], 0), (IMPOSSIBLE, [], 0)],
)
def test_exit_status_follows_the_bands_if_asked(tmp_path, quick, capsys, band, options, status, made):
    path = written(made(band), tmp_path)
    assert compare.main([str(path), "--output", str(tmp_path / "result"), *options]) == status
    verdict = "1 FAIL" if band == IMPOSSIBLE else "1 OK"
    assert capsys.readouterr().out.startswith(f"calcification: bands: {verdict}; report: ")


def test_a_missing_quantity_breaks_its_band(tmp_path, quick, monkeypatch, made):
    monkeypatch.setattr("validation.bands.judged_value", lambda models, band: None)
    path = written(made(GENEROUS), tmp_path)
    assert compare.main([str(path), "--output", str(tmp_path / "result"), "--check"]) == 1
    assert pd.read_csv(tmp_path / "result/metrics.csv")["status"].dropna().tolist() == ["MISSING"]


def test_a_case_without_bands_is_complete(tmp_path, quick, capsys, made):
    path = written(made(), tmp_path)
    assert compare.main([str(path), "--output", str(tmp_path / "result"), "--check"]) == 0
    assert "bands: none declared" in capsys.readouterr().out


ALL_BANDS = [
    *(("pressure", "bias", "3 %"), ("section_pressure", "bias", "3 %"), ("systolic_pressure", "bias", "3 %")),
    *(("pulse_pressure", "bias", "5 %"), ("radius", "bias", "2 %"), ("largest_radius", "bias", "2 %")),
    *(("mean_velocity", "bias", "3 %"), ("sector_flow_rate", "bias", "3 %")),
    *(("section_flow_rate", "bias", "3 %"), ("axial_velocity", "rms_difference", "8 mm/s")),
    ("profile_exponent", "bias", "15 %"),
]
OF_PRESSURE = {"pressure", "section_pressure", "systolic_pressure", "pulse_pressure"}
OF_VELOCITY = {"mean_velocity", "sector_flow_rate", "section_flow_rate", "axial_velocity"}


@pytest.mark.parametrize(
    ("false", "factor", "failing", "also_changed"),
    [
        (
            "pressure",
            1.1,
            OF_PRESSURE,
            {"diastolic_pressure", "largest_pressure_difference", "section_pressure_range"},
        ),
        ("velocity", 1.05, OF_VELOCITY, set()),
    ],
)
def test_a_false_reference_fails_just_the_rows_that_speak_of_it(
    tmp_path, quick, monkeypatch, false, factor, failing, also_changed
):
    path = written(bands(small_case("none"), *ALL_BANDS), tmp_path)
    assert compare.main([str(path), "--output", str(tmp_path / "right"), "--check"]) == 0
    model_of = febio_reference.plot_model

    def false_model(plot, stated):
        model = model_of(plot, stated)

        def read(state):
            values = model.read(state)
            return values._replace(**{false: factor * getattr(values, false)})

        return replace(model, read=read)

    monkeypatch.setattr(febio_reference, "plot_model", false_model)
    assert compare.main([str(path), "--output", str(tmp_path / "false"), "--check"]) == 1
    right, wrong = (pd.read_csv(tmp_path / name / "metrics.csv") for name in ("right", "false"))
    judged = wrong[wrong["status"].notna()]
    assert set(judged.loc[judged["status"] == "FAIL", "quantity"]) == failing
    assert set(right["status"].dropna()) == {"OK"}
    numbers = ["rom", "reference", "error"]
    same = np.isclose(right[numbers], wrong[numbers], rtol=1e-3, atol=1e-15, equal_nan=True).all(axis=1)
    lag = {"phase_lag"} if false == "velocity" else set()  # found by search
    consequences = {"mass_defect"} if false == "velocity" else set()
    changed = set(right.loc[~same, "quantity"]) - lag - consequences
    assert changed == (failing | also_changed) - ({"axial_velocity"} - set(right.loc[~same, "quantity"]))
    values = right["statistic"].isin(["value", "cycle"]) & right["quantity"].isin(changed)
    np.testing.assert_allclose(wrong["reference"][values] / right["reference"][values], factor, rtol=1e-6)
    np.testing.assert_array_equal(wrong["rom"][values], right["rom"][values])


class TestTarget:
    def test_a_result_is_replaced_whole(self, tmp_path, quick, made):
        path, result = written(made(), tmp_path), tmp_path / "result"
        for _ in range(2):
            assert compare.main([str(path), "--output", str(result)]) == 0
            (result / "report.pdf").write_text("older")
        assert compare.main([str(path), "--output", str(result)]) == 0
        assert not (result / "report.pdf").exists()
        assert {item.name for item in tmp_path.iterdir()} == {path.name, result.name}

    def test_a_result_with_files_of_others_is_refused(self, tmp_path, capsys, quick, made):
        path, result = written(made(), tmp_path), tmp_path / "result"
        assert compare.main([str(path), "--output", str(result)]) == 0
        (result / "my notes.txt").write_text("precious")
        assert compare.main([str(path), "--output", str(result)]) == 2
        assert "my notes.txt" in capsys.readouterr().err
        assert (result / "my notes.txt").read_text() == "precious"

    def test_an_empty_directory_is_used(self, tmp_path, quick, made):
        (tmp_path / "result").mkdir()
        path = written(made(), tmp_path)
        assert compare.main([str(path), "--output", str(tmp_path / "result")]) == 0
        assert (tmp_path / "result/metrics.csv").is_file()

    def test_a_directory_of_something_else_is_refused(self, tmp_path, capsys, monkeypatch, made):
        monkeypatch.setattr(compare, "compare_case", lambda *_: pytest.fail("something was computed"))
        keep = tmp_path / "result" / "thesis.txt"
        keep.parent.mkdir()
        keep.write_text("precious")
        path = written(made(), tmp_path)
        assert compare.main([str(path), "--output", str(keep.parent)]) == 2
        assert capsys.readouterr().err.endswith("is no result of a comparison; choose another --output\n")
        assert keep.read_text() == "precious"
        assert {item.name for item in tmp_path.iterdir()} == {path.name, "result"}

    @pytest.mark.parametrize("below", [".", "deeper/result"])
    def test_a_file_in_the_way_is_refused(self, tmp_path, capsys, quick, below, made):
        (tmp_path / "result").write_text("precious")
        path = written(made(), tmp_path)
        assert compare.main([str(path), "--output", str(tmp_path / "result" / below)]) == 2
        assert len(capsys.readouterr().err.splitlines()) == 1
        assert (tmp_path / "result").read_text() == "precious"

    def test_the_current_directory_is_used_or_refused(self, tmp_path, capsys, quick, monkeypatch, made):
        path = written(made(), tmp_path)
        (tmp_path / "here").mkdir()
        monkeypatch.chdir(tmp_path / "here")
        assert compare.main([str(path), "--output", "."]) in (0, 2)
        assert {item.name for item in tmp_path.iterdir()} == {path.name, "here"}

    def test_several_cases_go_side_by_side(self, tmp_path, quick, capsys, made):
        first, second = made(), made(IMPOSSIBLE)
        second["name"] = "second"
        paths = [written(first, tmp_path, "a.yaml"), written(second, tmp_path, "b.yaml")]
        assert compare.main([*map(str, paths), "--output", str(tmp_path / "both")]) == 0
        assert {item.name for item in (tmp_path / "both").iterdir()} == {
            "calcification", "second", "side_by_side.csv", "side_by_side.json"
        }  # fmt: skip
        assert len(capsys.readouterr().out.splitlines()) == 3
        table = pd.read_csv(tmp_path / "both/side_by_side.csv")
        lines = json.loads((tmp_path / "both/side_by_side.json").read_text(encoding="utf-8"))
        assert [line["quantity"] for line in lines] == table["quantity"].tolist()
        for name in ("calcification", "second"):
            own = pd.read_csv(tmp_path / "both" / name / "metrics.csv")
            rms = own[(own["quantity"] == "radius") & (own["statistic"] == "rms_error") & own["i"].isna()]
            line = table[(table["quantity"] == "radius") & (table["statistic"] == "rms_error")]
            assert line[f"{name}: error"].tolist() == rms["error"].tolist()[:1]
        assert table["second: status"].dropna().tolist() == ["FAIL"]
        assert table["calcification: status"].dropna().tolist() == []

    def test_cases_of_one_name_are_refused(self, tmp_path, quick, capsys, made):
        path = str(written(made(), tmp_path))
        assert compare.main([path, path, "--output", str(tmp_path / "both")]) == 2
        assert "case names must differ" in capsys.readouterr().err
        assert not (tmp_path / "both").exists()


def edited(section, key, value):
    case = small_case("none")
    case[section][key] = value
    return case


def patch(**values):
    case = small_case("local")
    case["variants"]["local"]["calcification"] |= values
    return case


class TestWrongInput:
    def test_missing_case_file(self, tmp_path, refused):
        assert refused(tmp_path / "absent.yaml").startswith("absent.yaml")

    @pytest.mark.parametrize(
        ("case", "key", "allowed"),
        [
            (edited("solver", "n_y", 3), "solver", "n_x"),
            (edited("geometry", "length", "15 s"), "geometry.length", "mm"),
            (edited("geometry", "wall_thickness", "-0.5 mm"), "geometry.wall_thickness", "allowed"),
            (patch(phi=["135 deg", "600 deg"]), "calcification.phi", "360 deg"),
            (edited("solver", "n_x", 1), "solver.n_x", "from 3 to"),
        ],
    )
    def test_wrong_value(self, refused, case, key, allowed):
        line = refused(case)
        assert line.startswith("small.yaml, line ")
        assert key in line
        assert allowed in line

    def plot(self, path, **changes):
        case = bands(small_case("none"))
        case["variants"]["none"]["reference"] = {"plot_file": str(path)}
        case["reference"] |= changes
        return case

    def test_plot_file_to_be_computed(self, tmp_path, monkeypatch, capsys):
        monkeypatch.chdir(tmp_path)
        case = small_case("none", "local")
        for name, variant in case["variants"].items():
            variant["reference"] = {"plot_file": f"my runs/{name}.xplt", "generate": {"mesh": [8, 2, 1, 12]}}
        written(case, tmp_path)
        (tmp_path / "my runs").mkdir()
        assert compare.main(["small.yaml"]) == 2
        lines = capsys.readouterr().err.splitlines()
        assert lines[:3] == [
            "variant 'none': reference.plot_file: my runs/none.xplt: not there yet; to make it:",
            "  python -m febio_io.feb small.yaml --variant none --output 'my runs/none.feb'",
            "  python -m febio_io.run 'my runs/none.feb'",
        ]
        assert len(lines) == 6
        assert feb_command.main(shlex.split(lines[1])[3:]) == 0
        assert (tmp_path / "my runs/none.feb").is_file()

    def test_log_that_the_run_has_not_left(self, tmp_path, refused):
        case = self.plot(RUNS / "none.xplt", generate={}, log="absent.log")
        assert refused(case) == "variant 'none': absent.log: no such file (reference)"

    def test_missing_plot_file(self, tmp_path, refused):
        line = refused(self.plot("absent.xplt"))
        assert "plot_file" in line
        assert "absent.xplt" in line

    def test_text_named_xplt(self, tmp_path, refused):
        (tmp_path / "text.xplt").write_text("time,pressure\n0,1\n")
        assert refused(self.plot(tmp_path / "text.xplt")).startswith("text.xplt: not an FEBio plot file")

    def test_empty_file_named_xplt(self, tmp_path, refused):
        (tmp_path / "empty.xplt").touch()
        assert refused(self.plot(tmp_path / "empty.xplt")).startswith("empty.xplt: ")

    @pytest.mark.parametrize("missing", VARIABLES)
    def test_missing_plot_variable(self, tmp_path, refused, missing):
        others = [name for name in VARIABLES if name != missing]
        path = write_tube(tmp_path / "tube.xplt", SHORT, np.linspace(0, 0.79, 5), variables=others)
        line = refused(self.plot(path, lumen=["Blood"], wall=["Wall"], time_offset="0 s"))
        assert line.startswith("tube.xplt: plot variable ")
        assert missing in line
        assert all(name in line for name in others)

    def test_mesh_of_another_length(self, refused):
        case = edited("geometry", "length", "20 mm")
        line = refused(case)
        assert "0.015 m" in line
        assert "0.02 m long (geometry.length)" in line

    def test_wrong_axis(self, refused):
        line = refused(self.plot(RUNS / "none.xplt", axis="x", phi_zero="y"))
        assert line.startswith(str(RUNS)) or "the lumen has no plane inlet" in line

    def test_domain_not_in_the_file(self, refused):
        line = refused(self.plot(RUNS / "none.xplt", lumen=["Blut"]))
        assert "no domain for reference.lumen: Blut; the file has: LumenCore, Lumen, WallHealthy" in line

    def test_variants_on_different_grids(self, refused):
        case = small_case()
        case["variants"]["local"]["solver"] = {"n_phi": 12}
        assert refused(case).startswith("variants 'none' and 'local' differ in solver.n_phi (8 and 12)")

    def test_variant_without_a_reference(self, refused):
        case = small_case()
        case["variants"]["local"]["reference"] = None
        assert "reference" in refused(case)

    def test_nothing_is_left_of_folders_made_for_the_result(self, tmp_path, quick, capsys):
        (tmp_path / "text.xplt").write_text("no plot file")
        path = written(self.plot(tmp_path / "text.xplt"), tmp_path)
        assert compare.main([str(path), "--output", str(tmp_path / "new/result")]) == 2
        assert not (tmp_path / "new").exists()

    def cut(self, tmp_path, share):
        content = (RUNS / "none.xplt").read_bytes()
        path = tmp_path / "cut.xplt"
        path.write_bytes(content[: int(share * len(content))])
        return path

    def test_plot_file_cut_off_is_used_as_far_as_it_goes(self, tmp_path, quick):
        path = written(self.plot(self.cut(tmp_path, 0.6)), tmp_path)
        assert compare.main([str(path), "--output", str(tmp_path / "result")]) == 0
        about = json.loads((tmp_path / "result/provenance.json").read_text(encoding="utf-8"))
        assert "cut.xplt is cut off after state 20: 20 complete states are used" in about["notes"]
        assert any("cover 47.5% of it" in note for note in about["notes"])
        assert any("cover only 47.5% of the cycle" in warning for warning in about["warnings"])
        assert any("cut off" in warning for warning in about["warnings"])
        assert about["variants"]["none"]["reference"]["states_compared"] == 20
        table = pd.read_csv(tmp_path / "result/metrics.csv")
        assert table.loc[table["quantity"] == "phase_lag", "rom"].isna().all()

    def test_instants_that_the_states_do_not_reach_are_not_tabulated(self, tmp_path, quick):
        path = written(self.plot(self.cut(tmp_path, 0.6)), tmp_path)
        assert compare.main([str(path), "--output", str(tmp_path / "result")]) == 0
        with xr.open_dataset(tmp_path / "result/comparison.nc") as data:
            named = dict(
                zip(json.loads(data.attrs["compare_time_names"]), data.attrs["compare_times_s"], strict=True)
            )
        assert "end diastole" not in named or named["end diastole"] > 0.7

    def test_plot_file_cut_off_in_its_mesh(self, tmp_path, refused):
        assert refused(self.plot(self.cut(tmp_path, 0.1))).startswith("cut.xplt: the file is cut off")

    def test_plot_file_with_too_few_states(self, tmp_path, refused):
        path = write_tube(tmp_path / "tube.xplt", SHORT, [0.1, 0.2])
        line = refused(self.plot(path, lumen=["Blood"], wall=["Wall"], time_offset="0 s"))
        assert "states in the last cycle: 2, allowed: 3 or more" in line

    def test_plot_file_with_too_few_states_is_named(self, tmp_path, refused):
        path = write_tube(tmp_path / "tube.xplt", SHORT, [0.1, 0.2])
        assert "tube.xplt" in refused(self.plot(path, lumen=["Blood"], wall=["Wall"], time_offset="0 s"))

    def test_one_broken_variant_of_two_stops_the_other(self, tmp_path, refused, monkeypatch):
        (tmp_path / "text.xplt").write_text("no plot file")
        case = small_case()
        case["variants"]["local"]["reference"] = {"plot_file": str(tmp_path / "text.xplt")}
        assert refused(case).startswith("text.xplt: not an FEBio plot file")
        assert threading.active_count() == 1 or not [
            thread for thread in threading.enumerate() if thread.name.startswith("ThreadPoolExecutor")
        ]


def interrupt(*_arguments, **_options):
    raise KeyboardInterrupt


class TestInterrupt:
    @pytest.mark.parametrize(
        ("module", "name"),
        [
            (cached_runs, "run_reduced_model"),
            (compare, "both_models"),
            (compare, "comparison_file"),
            (compare, "write_walls"),
            (compare, "write_reports"),
        ],
    )
    def test_nothing_is_left(self, tmp_path, capsys, monkeypatch, module, name, made):
        monkeypatch.setattr(module, name, interrupt)
        path = written(made(), tmp_path)
        old = tmp_path / "result"
        old.mkdir()
        (old / output.MARK).write_text("{}")
        assert compare.main([str(path), "--output", str(old)]) == 130
        assert capsys.readouterr().err == "interrupted; no result was written\n"
        assert {item.name for item in tmp_path.iterdir()} == {path.name, "result"}
        assert [item.name for item in old.iterdir()] == [output.MARK]

    @pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
    def test_a_signal_while_it_runs(self, tmp_path):
        case = bands(small_case("none", "axisymmetric", "local"))
        case["solver"] |= {"time_step": "1 ms", "cycles": 30}
        path, result = written(case, tmp_path), tmp_path / "out" / "result"
        result.parent.mkdir()
        command = [sys.executable, "-m", "validation.compare", str(path), "--output", str(result)]
        with subprocess.Popen(  # noqa: S603
            command,
            cwd=ROOT,
            stderr=subprocess.PIPE,
            text=True,
            # a test run in the background ignores the signal, and so would its children
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        ) as process:
            while process.poll() is None and not any(result.parent.iterdir()):
                time.sleep(0.02)
            process.send_signal(signal.SIGINT)
            _, err = process.communicate(timeout=120)
        assert (process.returncode, err) == (130, "interrupted; no result was written\n")
        assert list(result.parent.iterdir()) == []


def test_every_number_in_metrics_is_finite_or_empty(finished):
    rows = json.loads((finished[1] / "metrics.json").read_text(encoding="utf-8"))
    assert all(math.isfinite(v) for row in rows for v in row.values() if isinstance(v, float))
