"""Windkessels of written models, replayed by FEBio's formula on the outlet flow of the reduced model."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from feb_contents import Parsed
from numpy.testing import assert_allclose
from ruamel.yaml import YAML

import solver.case.start as start
from cases.reading.case_file import load_case_file
from febio_io.feb.command import main
from febio_io.feb.from_case import ramp_curve
from febio_io.feb.structure import read_structure
from febio_io.feb.windkessel_start import Periodic, cycles_from_rest
from solver.case.model import model_of
from solver.case.run import walk

ROOT = Path(__file__).parents[2]
RAMP = 0.2
THESIS = {"kind": "velocity", "waveform": str(ROOT / "reference_data/waveforms/thesis_inlet.csv")}
BACKWARD = {
    "kind": "velocity",
    "fourier": {"period": "0.8 s", "mean": "15 cm/s", "cosines": ["-20 cm/s"], "sines": ["5 cm/s"]},
}
DISTAL, PROXIMAL, VENOUS = 2e9, 3e8, 2e3


def stated(inlet, tau, **changes):
    """A small case with a Windkessel."""
    outlet = {
        "kind": "windkessel",
        "proximal_resistance": f"{PROXIMAL} Pa s/m^3",
        "distal_resistance": f"{DISTAL} Pa s/m^3",
        "compliance": f"{tau / DISTAL} m^3/Pa",
        "venous_pressure": f"{VENOUS} Pa",
    }
    case = YAML().load(ROOT / "cases/calcification.yaml")
    for name in ("title", "models", "variants", "compare"):
        del case[name]
    case |= {"inlet": inlet, "outlet": outlet}
    case["solver"] |= {"n_x": 12, "n_phi": 4, "time_step": "4 ms"}
    case["reference"] |= {"time_offset": f"{RAMP} s", "plot_file": "of a run to come.xplt"}
    return case | changes


def dumped(folder, name, case):
    path = folder / f"{name}.yaml"
    with path.open("w", encoding="utf-8") as stream:
        YAML().dump(case, stream)
    return path


def outlet_of(model):
    """Parameters of `fluid RCR` at the model's steps, as FEBio takes them from a parsed model."""
    (item,) = [one for one in model.root.find("Boundary") if one.get("type") == "fluid RCR"]
    curves, control = model.curves(), model.control()
    step = control["/step_size"]
    times = step * np.arange(control["/time_steps"] + 1)

    def values(name):
        parameter = item.find(name)
        curve = curves[parameter.get("lc")].T if parameter.get("lc") else ([0.0], [1.0])
        return float(parameter.text) * np.interp(times, *curve)

    names = {"R": "R", "Rd": "Rd", "C": "capacitance", "offset": "pressure_offset"}
    assert float(item.findtext("initial_pressure")) == 0
    return SimpleNamespace(step=step, times=times, **{key: values(name) for key, name in names.items()})


def replay(rcr, flow):
    """FEFluidRCRBC of FEBio 4.11, step by step; (n,) from the start at rest."""
    pressure = np.zeros(flow.size)
    for n in range(1, flow.size):
        tau = rcr.Rd[n] * rcr.C[n]
        held = pressure[n - 1] - rcr.offset[n - 1] - rcr.R[n] * flow[n - 1]
        pressure[n] = rcr.offset[n] + (rcr.Rd[n] / (1 + tau / rcr.step) + rcr.R[n]) * flow[n]
        pressure[n] += tau / (rcr.step + tau) * held
    return pressure


def outflow(case, times):
    """Flow and pressure of the outlet of a run of the reduced model at times."""
    checked = load_case_file(case, results_exist=False).variants["base"]
    stops = list(walk(checked, model_of(checked), times))
    flow = np.array([0.25 * np.pi * stop.columns.flow[-1].sum() for stop in stops])
    return flow, np.array([stop.columns.pressure[-1].mean() for stop in stops])


def ramped_outflow(folder, model, rcr):
    """Flow of the reduced model through FEBio's ramp and cycles, against the pressure that it replays to."""
    curve = model.curves()["1"]
    end = [rcr.times[-1] + 0.1]
    velocity = np.vstack([curve, [*end, 0.0]])
    np.savetxt(folder / "inlet.csv", velocity, "%.9e", ",", header="t_s,mean_velocity_m_s", comments="")
    flow = np.interp(rcr.times, *curve.T) * np.pi * 2.5e-3**2
    run = stated(
        THESIS | {"waveform": "inlet.csv"}, 1.0, outlet={"kind": "pressure", "waveform": "outlet.csv"}
    )
    for _ in range(2):  # the flow depends on the pressure a little
        table = np.column_stack([np.append(rcr.times, end), np.append(replay(rcr, flow), 0.0)])
        np.savetxt(folder / "outlet.csv", table, "%.9e", ",", header="t_s,pressure_Pa", comments="")
        flow = outflow(dumped(folder, "ramped", run), rcr.times)[0]
    return flow


@pytest.fixture(scope="module", params=[0.2, 1.2, 5.0], ids=lambda tau: f"tau {tau} s")
def tau(request):
    return request.param


@pytest.fixture(scope="module", params=[THESIS, BACKWARD], ids=["forward", "backward at the start"])
def written(request, tau, tmp_path_factory):
    """A case, its model, and the model's outlet."""
    folder = tmp_path_factory.mktemp("written")
    case = dumped(folder, "case", stated(request.param, tau))
    path = folder / "model.feb"
    assert main([str(case), "--output", str(path), "--mesh", "48,2,1,3", "--cycles", "2"]) == 0
    read_structure(path)
    model = Parsed(path)
    return SimpleNamespace(
        case=case,
        model=model,
        rcr=outlet_of(model),
        tau=tau,
        folder=folder,
        case_flows_forward=request.param is THESIS,
    )


@pytest.mark.slow
def test_the_first_cycle_is_periodic(written):
    rcr, period = written.rcr, load_case_file(written.case, results_exist=False).variants["base"].inlet.period
    flow = ramped_outflow(written.folder, written.model, rcr)
    first = int(np.flatnonzero(rcr.times >= RAMP - 1e-6)[0])
    # A plain run of the reduced model, of which the last cycle counts.
    begun = np.ceil(8 * written.tau / period) * period
    times = np.append(0.0, begun + rcr.times[first:] - RAMP)
    expected = outflow(written.case, np.maximum(times, 0.0))[1][1:]
    for more in (1.0, 1.3):  # as if 3D carried more blood through the ramp
        flow[1 : first - 1] *= more
        found = replay(rcr, flow)[first:]
        assert_allclose(found, expected, atol=0.01 * expected.max())
        if (
            written.case_flows_forward
        ):  # backward at the start, that pressure is low: 1.06 % of it at τ = 0.2 s
            assert abs(found[0] / expected[0] - 1) < 0.01


def test_the_pressure_grows_smoothly_from_rest(written):
    rcr = written.rcr
    ramp = rcr.times <= RAMP + 1e-6
    curve = written.model.curves()["1"].T
    found = replay(rcr, np.interp(rcr.times, *curve) * np.pi * 2.5e-3**2)
    assert found[0] == 0
    steps = np.abs(np.diff(found[ramp]))
    assert steps[0] < 0.01 * found[ramp].max()
    assert steps.max() < 0.04 * np.ptp(found[ramp])  # π/2 over 50 steps is 3.1 %


def test_curves_are_those_of_the_formula(written):
    rcr, curves = written.rcr, written.model.curves()
    assert set(curves) == {"1", "2", "3", "4"}
    last = int(np.floor(RAMP / rcr.step + 1e-3))
    assert_allclose(rcr.Rd, np.where(np.arange(rcr.Rd.size) > last, DISTAL, 0.0), atol=1e-3)
    assert_allclose(rcr.C, written.tau / DISTAL)
    missing = rcr.offset[last + 1 :] - VENOUS
    kept = written.tau / (written.tau + rcr.step)
    assert_allclose(missing[1:] / missing[:-1], kept, rtol=1e-5)
    top = VENOUS + missing[0] * kept ** ((RAMP - rcr.times[last + 1]) / rcr.step)
    share = 0.5 - 0.5 * np.cos(np.pi * curves["3"][:51, 0] / RAMP)
    assert_allclose(curves["3"][:51, 1], top * share, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize(("tau", "most"), [(0.2, 2), (1.2, 8), (5.0, 30)])
def test_the_cycles_saved_are_those_of_a_replay_from_rest(tau, most):
    period, step, ramp = 0.8, 4e-3, 0.2
    flow = 3e-6 + 1e-6 * np.sin(2 * np.pi * np.arange(200) / 200)
    times = step * np.arange(round((ramp + 100 * period) / step) + 1)
    share = 0.5 - 0.5 * np.cos(np.pi * np.minimum(times / ramp, 1))
    rcr = SimpleNamespace(
        step=step,
        C=np.full(times.size, tau / DISTAL),
        R=PROXIMAL * share,
        Rd=DISTAL * share,
        offset=VENOUS * share,
    )
    phase = np.maximum(np.rint((times - ramp) / step).astype(int), 0)
    found = replay(rcr, share * flow[phase % 200])[round(ramp / step) :: 200]
    periodic_cycle = replay(rcr, share * flow[phase % 200])[-200:]
    late = np.abs(found - found[-1]) > 0.01 * periodic_cycle.max()
    count = cycles_from_rest(
        Periodic(PROXIMAL, DISTAL, tau / DISTAL, VENOUS, flow, period, step), ramp_curve(ramp)
    )
    assert count == np.flatnonzero(late)[-1] + 1
    assert 1 <= count <= most


def test_the_command_tells_what_it_saves(tmp_path, capsys):
    case = dumped(tmp_path, "case", stated(THESIS, 5.0))
    assert main([str(case), "--output", str(tmp_path / "m.feb"), "--mesh", "8,2,1,3"]) == 0
    line = capsys.readouterr().out.splitlines()[1]
    assert line.startswith("outlet: starts within 0.01 % of its periodic pressure by the reduced model, ")
    assert line.endswith(" cycles to come within 1 %")


def test_a_reduced_model_that_fails_leaves_no_model(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(start, "MOST_CYCLES", 1)
    case = dumped(tmp_path, "case", stated(THESIS, 5.0))
    assert main([str(case), "--output", str(tmp_path / "m.feb"), "--mesh", "8,2,1,3"]) == 2
    assert "the reduced model changes by" in capsys.readouterr().err
    assert not list(tmp_path.glob("*.feb"))


def test_what_cannot_be_a_model_is_refused_before_the_reduced_model_runs(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("solver.case.periodic_outlet.periodic_outlet_flow", None)
    wall = {"law": "thick", "youngs_modulus": "0.6 MPa", "poisson_ratio": 0.48, "reference_pressure": "9 kPa"}
    case = dumped(tmp_path, "case", stated(THESIS, 5.0, wall=wall))
    assert main([str(case), "--output", str(tmp_path / "m.feb")]) == 2
    assert "wall.reference_pressure: 9000 Pa; allowed" in capsys.readouterr().err
