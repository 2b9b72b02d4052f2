"""``python -m solver``: one NetCDF file, or one line that says why not."""

import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from thesis_artery import artery

import solver.command as command
import solver.runs.resumable as running
from cases.fields import FIELDS
from solver.model.diagnostics import Diagnostics
from solver.runs.files import pieces_folder
from solver.runs.netcdf import write_netcdf
from solver.runs.result import CellHistory, cell_dataset, cell_fields

ROOT = Path(__file__).parents[2]
VARIABLES = {
    "pressure",
    "radius",
    "mean_velocity",
    "profile_exponent",
    "sector_flow_rate",
    "section_flow_rate",
    "section_pressure",
    "wall_stiffness",
    *Diagnostics._fields,
}


@pytest.fixture
def run(monkeypatch, capsys):
    """Run the command in this process; gives (status, standard output, standard error)."""

    def with_arguments(*arguments):
        monkeypatch.setattr(sys, "argv", ["solver", *map(str, arguments)])
        status = command.main()
        return status, *capsys.readouterr()

    return with_arguments


def stored_change(path):
    with xr.open_dataset(path) as dataset:
        return dataset.attrs["cycle_change"]


@pytest.fixture
def result(run, case_file):
    output = case_file.with_name("run.nc")
    status, text, errors = run(case_file, "--variant", "patch", "--output", output)
    assert (status, errors) == (0, "")
    first, *watched = text.splitlines()
    assert first == f"{output}: 200 steps of at most 0.002 s"
    assert [line.partition(" at most ")[0] for line in watched] == [
        "  courant number",
        "  advective courant number",
        "  mass defect",
        "  continuity residual",
        "  energy defect not evaluated: states too far apart",
        f"  change over the last cycle {stored_change(output):.3g} (relative)",
        f"  {command.USUAL}",
    ]
    with xr.open_dataset(output) as dataset:
        yield dataset.load()


def test_what_is_seldom_meant_is_warned_of(run, case_file):
    case_file.with_name("inlet.csv").write_text(
        "t_ms,mean_velocity_cm_s\n0,8\n25,20\n75,12\n100,8\n", encoding="utf-8"
    )
    status, _, errors = run(case_file, "--variant", "healthy", "--output", case_file.with_name("run.nc"))
    assert status == 0
    assert errors.startswith("warning: inlet: the cycle of inlet.csv takes 0.1 s, a heart's 0.2 to 3 s")


def test_the_module_runs_as_a_command(case_file):
    output = case_file.with_name("run.nc")
    arguments = [sys.executable, "-m", "solver", case_file, "--variant", "healthy", "--output", output]
    done = subprocess.run(arguments, cwd=ROOT, capture_output=True, text=True, check=False)  # noqa: S603
    assert (done.returncode, done.stderr) == (0, "")
    assert output.stat().st_size > 0
    assert sorted(path.name for path in case_file.parent.iterdir()) == ["inlet.csv", "run.nc", "short.yaml"]


UNUSED = {"dask", "matplotlib", "pandas", "pint", "scipy.interpolate", "scipy.sparse", "xarray"}
LOADED = f"""
import sys
import solver.command

status = solver.command.main()
print(*sorted(set(sys.modules) & {UNUSED}), file=sys.stderr)
sys.exit(status)
"""


def test_a_run_loads_no_library_that_it_does_not_use(case_file):
    arguments = [str(case_file), "--variant", "patch", "--output", str(case_file.with_name("run.nc"))]
    done = subprocess.run(  # noqa: S603
        [sys.executable, "-c", LOADED, *arguments], cwd=ROOT, capture_output=True, text=True
    )
    assert (done.returncode, done.stderr) == (0, "\n")


def test_the_file_is_what_xarray_writes(tmp_path):
    model = artery(8, 6)
    shape, rng = (3, 8, 6), np.random.default_rng(5)
    fields = [rng.uniform(1.0, 2.0, shape) for _ in range(4)]
    watched = {name: rng.uniform(size=3) for name in Diagnostics._fields}
    cells = CellHistory(np.array([0.0, 0.1, 0.3]), *fields, watched, azimuthal_flux=rng.uniform(size=shape))
    stated = {"title": "Arterie, verkalkt: β", "share": 0.25}
    dataset = cell_dataset(model, cells).assign_attrs(stated)
    dataset.to_netcdf(tmp_path / "xarray.nc", engine="netcdf4", unlimited_dims=["time"])
    axes = {"time": cells.times, "x": model.grid.x, "phi": model.grid.phi}
    write_netcdf(tmp_path / "own.nc", axes, cell_fields(model, cells), stated)
    assert (tmp_path / "own.nc").read_bytes() == (tmp_path / "xarray.nc").read_bytes()


def test_dimensions_units_and_words(result):
    assert dict(result.sizes) == {"time": 21, "x": 12, "phi": 8}
    assert set(result.data_vars) == VARIABLES
    for name, variable in result.data_vars.items():
        field = FIELDS[name]
        assert variable.dims == field.dims
        assert variable.attrs["units"] == field.unit
        assert variable.attrs["long_name"] == field.label
        if name != "energy_defect":  # these states are too far apart to integrate powers
            assert np.all(np.isfinite(variable))
    assert [result[name].attrs["units"] for name in ("time", "x", "phi")] == ["s", "m", "rad"]
    np.testing.assert_allclose(result["time"], np.linspace(0, 0.4, 21), atol=1e-12)
    np.testing.assert_allclose(result["x"], (np.arange(12) + 0.5) * 15e-3 / 12)
    np.testing.assert_allclose(result["phi"], (np.arange(8) + 0.5) * np.pi / 4)


def test_change_over_the_last_cycle_is_told_where_both_its_ends_are_saved(result, run, case_file):
    begin, end = result.sel(time=[0.2, 0.4], method="nearest").transpose("time", ...)["pressure"]
    flow = result["section_flow_rate"].sel(time=[0.2, 0.4], method="nearest")
    expected = max(
        float(np.abs(end - begin).max() / np.abs(begin).max()),
        float(np.abs(flow[1] - flow[0]).max() / np.abs(flow[0]).max()),
    )
    assert result.attrs["cycle_change"] == pytest.approx(expected, rel=1e-12)
    case_file.write_text(case_file.read_text().replace("output_interval: 20 ms", "output_interval: 30 ms"))
    output = case_file.with_name("sparse.nc")
    status, text, errors = run(case_file, "--variant", "healthy", "--output", output)
    assert (status, errors) == (0, "")
    assert "change over the last cycle not evaluated: no state was saved at its start" in text
    with xr.open_dataset(output) as sparse:
        assert "cycle_change" not in sparse.attrs


def test_a_run_that_drifts_says_so(run, case_file):
    windkessel = (
        "outlet: {kind: windkessel, proximal_resistance: 1e8 Pa s/m^3, distal_resistance: 5e9 Pa s/m^3, "
        "compliance: 1e-10 m^3/Pa}"
    )
    resistance = "outlet: {kind: resistance, resistance: 1.358e9 Pa s/m^3, offset: 9330 Pa}"
    case_file.write_text(case_file.read_text().replace(resistance, windkessel))
    status, text, errors = run(case_file, "--variant", "healthy", "--output", case_file.with_name("run.nc"))
    assert status == 0
    assert errors.startswith("warning: the reduced model is not periodic yet: it changes by ")
    assert "(raise solver.cycles; with scheme semi_implicit solver.start: periodic finds" in errors
    with xr.open_dataset(case_file.with_name("run.nc")) as stored:
        assert stored.attrs["cycle_change"] > 1e-4
        assert f"{stored.attrs['cycle_change']:.3g} (relative)" in text


def test_where_it_comes_from(result, case_file):
    assert result.attrs["case_yaml"] == case_file.read_text()
    expected = {"case": "short", "title": "A short artery", "variant": "patch", "scheme": "semi_implicit"}
    expected["model"] = "rom"
    assert {key: result.attrs[key] for key in expected} == expected
    assert result.attrs["steps"] == 200
    assert result.attrs["time_step_s"] == pytest.approx(2e-3)


def test_fields_agree_with_each_other(result):
    radius, stiffness = result["radius"], result["wall_stiffness"]
    law = (radius - 2.5e-3) * stiffness / 2.5e-3**2
    np.testing.assert_allclose(result["pressure"], law, rtol=1e-9)
    sector = 0.5 * np.pi / 4 * result["mean_velocity"] * radius**2
    np.testing.assert_allclose(result["sector_flow_rate"], sector, rtol=1e-12)
    total = result["sector_flow_rate"].sum("phi")
    np.testing.assert_allclose(result["section_flow_rate"], total, rtol=1e-12)
    exponent, velocity = result["profile_exponent"], result["mean_velocity"]
    axis = (exponent + 2) / exponent * velocity
    np.testing.assert_allclose(axis / (2 * velocity.mean("phi")), 1.0, rtol=1e-10)
    mean = (result["pressure"] * radius**2).sum("phi") / (radius**2).sum("phi")
    np.testing.assert_allclose(result["section_pressure"], mean, rtol=1e-12)
    assert float(np.abs(result["mass_defect"]).max()) < 1e-10


def test_the_patch_is_where_the_case_says(result):
    calcified = result["wall_stiffness"] > 1000
    np.testing.assert_allclose(result["wall_stiffness"].where(calcified, drop=True), 20000 / 3)
    x, phi = result["x"], result["phi"]
    inside = (x > 5e-3) & (x < 10e-3) & (phi > 0.75 * np.pi) & (phi < 1.25 * np.pi)
    np.testing.assert_array_equal(calcified, inside)


def refused(answer, folder, *parts):
    """One line on standard error, status 2, no file but the inputs."""
    status, text, errors = answer
    assert status == 2
    assert text == ""
    assert errors.count("\n") == 1
    for part in parts:
        assert part in errors
    assert sorted(path.name for path in folder.iterdir()) == ["inlet.csv", "short.yaml"]


def test_an_unknown_variant(run, case_file):
    answer = run(case_file, "--variant", "nobody", "--output", case_file.with_name("run.nc"))
    refused(answer, case_file.parent, "short.yaml", "no variant 'nobody'", "allowed: healthy, patch")


def test_no_variant_where_there_are_two(run, case_file):
    answer = run(case_file, "--output", case_file.with_name("run.nc"))
    refused(answer, case_file.parent, "--variant: healthy, patch")


def test_a_missing_case_file(run, case_file):
    missing = case_file.with_name("absent.yaml")
    answer = run(missing, "--variant", "patch", "--output", case_file.with_name("run.nc"))
    refused(answer, case_file.parent, "absent.yaml", "No such file")


def test_a_missing_folder(run, case_file):
    output = case_file.parent / "absent" / "run.nc"
    answer = run(case_file, "--variant", "patch", "--output", output)
    refused(answer, case_file.parent, str(output), "its folder does not exist")


def test_a_wrong_value(run, case_file):
    case_file.write_text(case_file.read_text().replace("n_x: 12", "n_x: 2"))
    answer = run(case_file, "--variant", "patch", "--output", case_file.with_name("run.nc"))
    refused(answer, case_file.parent, "short.yaml, line 9: solver.n_x: 2; allowed: ")


def test_a_run_that_fails(run, case_file):
    case_file.with_name("inlet.csv").write_text("t_s,mean_velocity_cm_s\n0,8\n0.05,-8\n0.2,8\n")
    answer = run(case_file, "--variant", "patch", "--output", case_file.with_name("run.nc"))
    assert pieces_folder(case_file.with_name("run.nc")).is_dir()  # what was reached stays
    shutil.rmtree(pieces_folder(case_file.with_name("run.nc")))
    refused(
        answer,
        case_file.parent,
        "variant patch: no admissible velocity-profile exponent",
        "t = 0.0",
        "i = ",
        "j = ",
    )


def test_an_older_result_survives_a_failure_and_not_a_success(run, case_file):
    output = case_file.with_name("run.nc")
    output.write_text("older")
    assert run(case_file, "--variant", "nobody", "--output", output)[0] == 2
    assert output.read_text() == "older"
    assert run(case_file, "--variant", "healthy", "--output", output)[0] == 0
    with xr.open_dataset(output) as dataset:
        assert dataset.attrs["variant"] == "healthy"


def test_an_output_that_cannot_be_written(run, case_file):
    """A folder of that name stands there."""
    output = case_file.with_name("run.nc")
    output.mkdir()
    status, text, errors = run(case_file, "--variant", "healthy", "--output", output)
    assert (status, text) == (2, "")
    assert errors.count("\n") == 1
    assert "run.nc: is a folder, not a result file" in errors
    names = sorted(path.name for path in case_file.parent.iterdir())
    assert names == ["inlet.csv", "run.nc", "short.yaml"]


def test_an_interrupt_leaves_what_a_resumed_run_needs(run, case_file, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    output = case_file.with_name("run.nc")
    with monkeypatch.context() as patched:
        patched.setattr(running, "walk", interrupted)
        status, text, errors = run(case_file, "--variant", "patch", "--output", output)
    kept = pieces_folder(output)
    assert (status, text) == (130, "")
    assert errors == f"interrupted; --resume goes on from the last piece in {kept}\n"
    assert sorted(path.name for path in case_file.parent.iterdir()) == [
        "inlet.csv",
        "run.nc.pieces",
        "short.yaml",
    ]
    assert [path.name for path in kept.iterdir()] == ["identity"]
    assert run(case_file, "--variant", "patch", "--output", output, "--resume")[0] == 0
    assert sorted(path.name for path in case_file.parent.iterdir()) == ["inlet.csv", "run.nc", "short.yaml"]


def test_the_only_variant_needs_no_name(run, case_file):
    text = case_file.read_text()
    case_file.write_text(text[: text.index("variants:")].replace("cycles: 2", "cycles: 1"))
    output = case_file.with_name("run.nc")
    assert run(case_file, "--output", output)[0] == 0
    with xr.open_dataset(output) as dataset:
        assert dataset.attrs["variant"] == "base"
        assert dataset.sizes["time"] == 11
