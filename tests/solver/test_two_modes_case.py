"""A case with profiles of two modes: what its result holds, in memory, in batches and resumed."""

import numpy as np
import pytest
import xarray as xr

from cases.reading.case_file import load_case_file
from solver.case.run import run_case
from solver.command import main
from solver.runs.batch import run_batch
from solver.runs.result import cell_dataset

pytestmark = pytest.mark.slow  # compiles a scheme that no other quick test needs

REVERSED = "t_s,mean_velocity_cm_s\n0,8\n0.05,20\n0.12,-6\n0.2,8\n"
TIMES = np.linspace(0.0, 0.2, 11)


@pytest.fixture
def reversing(case_file):
    """Case file of an artery whose flow reverses, by closure and pressure."""
    text = case_file.read_text()

    def of(closure, pressure):
        solver = f"closure: {closure}, profile: two_mode, pressure: {pressure}"
        case_file.write_text(text.replace("closure: average", solver))
        (case_file.parent / "inlet.csv").write_text(REVERSED)
        return case_file

    return of


@pytest.mark.parametrize("pressure", ["row", "section"])
@pytest.mark.parametrize("closure", ["mean", "axis_momentum"])
def test_a_batch_gives_the_same_fields(reversing, closure, pressure):
    case = load_case_file(reversing(closure, pressure)).variants["patch"]
    alone = run_case(case, TIMES)
    assert float(alone["section_flow_rate"].min()) < 0
    assert "profile_exponent" not in alone
    d, bend, u = (alone[name].to_numpy() for name in ("axis_velocity", "profile_bend", "mean_velocity"))
    np.testing.assert_allclose(0.5 * d[..., None] + 0.25 * bend, u, rtol=1e-12, atol=1e-15)
    assert float(np.abs(alone["mass_defect"]).max()) < 1e-12
    (other,) = run_batch([case], TIMES, cell_dataset, threads=1)
    assert other.error is None
    for name in ("axis_velocity", "profile_bend", "pressure", "radius"):
        np.testing.assert_allclose(other.kept[name], alone[name], rtol=1e-9, atol=1e-9)


def test_energy_is_balanced(reversing):
    case = load_case_file(reversing("axis_momentum", "section")).variants["healthy"]
    run = run_case(case, np.linspace(0.0, 0.2, 101))
    assert float(np.nanmax(np.abs(run["energy_defect"]))) < 0.05
    assert float(run["continuity_residual"].max()) == 0.0


def test_an_interrupted_run_goes_on_to_the_same_bits(reversing, tmp_path, monkeypatch):
    path = reversing("axis_momentum", "section")
    arguments = [str(path), "--variant", "patch", "--output"]
    assert main([*arguments, str(tmp_path / "whole.nc")]) == 0
    monkeypatch.setattr("solver.runs.resumable.PIECE", 4)

    def interrupted(*_):
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr("solver.runs.resumable._join", interrupted)
        assert main([*arguments, str(tmp_path / "parts.nc")]) == 130
    pieces = sorted((tmp_path / "parts.nc.pieces").glob("*.npz"))
    for piece in pieces[2:]:
        piece.unlink()
    assert main([*arguments, str(tmp_path / "parts.nc"), "--resume"]) == 0
    with xr.open_dataset(tmp_path / "whole.nc") as one, xr.open_dataset(tmp_path / "parts.nc") as other:
        for name in ("axis_velocity", "profile_bend", "pressure", "energy_defect"):
            assert np.array_equal(one[name], other[name], equal_nan=True)
