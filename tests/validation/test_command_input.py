"""`python -m validation.compare`: every kind of wrong input."""

import json
import shlex
import threading
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from small_case import RUNS, bands, small_case, written
from tube_plot import VARIABLES, write_tube
from tubes import SHORT

from febio_io.feb import command as feb_command
from validation.compare import command as compare


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
        line = refused(case)
        assert line.startswith("small.yaml: reference of variant 'local': missing")
        assert "allowed: kind febio (plot_file, and generate" in line
        assert line.endswith("small.yaml --variant local --output run.nc")

    def test_case_of_one_variant_without_a_reference(self, refused):
        case = small_case("none")
        del case["variants"], case["reference"]
        case["compare"].pop("bands")
        line = refused(case)
        assert line.startswith("small.yaml: reference: missing, there is nothing to compare with; allowed: ")

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

    def test_what_is_seldom_meant_is_warned_of(self, tmp_path, quick, capsys):
        case = small_case("none")
        header, *rows = Path(case["inlet"]["waveform"]).read_text(encoding="utf-8").splitlines()
        pairs = [row.split(",") for row in rows]
        slow = [f"{4.1 * float(time)!r},{value}" for time, value in pairs]
        (tmp_path / "slow.csv").write_text("\n".join([header, *slow, ""]), encoding="utf-8")
        case["inlet"]["waveform"] = "slow.csv"
        path = written(case, tmp_path)
        assert compare.main([str(path), "--output", str(tmp_path / "result")]) == 0
        about = json.loads((tmp_path / "result/provenance.json").read_text(encoding="utf-8"))
        said = "none: inlet: the cycle of slow.csv takes 3.26905 s, a heart's 0.2 to 3 s"
        assert [warning.startswith(said) for warning in about["warnings"]].count(True) == 1
        assert f"warning: {said}" in capsys.readouterr().err

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
