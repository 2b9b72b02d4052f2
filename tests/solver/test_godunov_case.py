"""A case file's `scheme: godunov`, from the case to the dataset."""

import numpy as np
import pytest

from cases.errors import CaseFileError
from cases.reading.case_file import load_case_file
from solver.case.model import model_of
from solver.case.run import run_case, walk

pytestmark = pytest.mark.slow  # compiles a scheme that no other quick test needs

PARTS = {
    "wall": "{law: thin, youngs_modulus: 0.6 MPa, poisson_ratio: 0.5}",
    "calcification": "{pattern: none}",
    "inlet": "{kind: velocity, waveform: inlet.csv}",
    "outlet": "{kind: resistance, resistance: 5.7817e9 Pa s/m^3, offset: 7205.2 Pa, flow: row}",
    "solver": "{scheme: godunov, n_x: 30, n_phi: 4, time_step: 20 us, cycles: 1, closure: average}",
}
IMPLICIT = "{scheme: semi_implicit, n_x: 30, n_phi: 4, time_step: 0.5 ms, cycles: 1, closure: average}"
SHARP = "{pattern: axisymmetric, youngs_modulus: 10 MPa, x: [5 mm, 10 mm], transition: sharp}"


@pytest.fixture
def case(tmp_path):
    def load(**changes):
        lines = [
            "name: one",
            "geometry: {length: 15 mm, radius: 2.5 mm, wall_thickness: 0.5 mm}",
            "blood: {density: 1060 kg/m^3, viscosity: 0.003 Pa s}",
            *(f"{key}: {value}" for key, value in (PARTS | changes).items()),
        ]
        (tmp_path / "inlet.csv").write_text("t_s,mean_velocity_cm_s\n0,8\n0.05,20\n0.15,12\n0.2,8\n")
        (tmp_path / "one.yaml").write_text("\n".join(lines))
        return load_case_file(tmp_path / "one.yaml").variants["base"]

    return load


def test_both_schemes_agree_without_calcification(case):
    times = np.linspace(0.0, 0.2, 11)
    explicit, implicit = run_case(case(), times), run_case(case(solver=IMPLICIT), times)
    assert explicit.attrs["scheme"] == "godunov"
    assert 0.1 < float(explicit["courant_number"].max()) < 1.0
    for name, share in (("section_flow_rate", 2e-3), ("pressure", 2e-3), ("radius", 1e-4)):
        difference = np.abs(explicit[name].to_numpy() - implicit[name].to_numpy())
        assert np.max(difference) < share * np.max(implicit[name].to_numpy()), name
    np.testing.assert_allclose(explicit["profile_exponent"], 2.0, rtol=1e-9)


BOUNDARIES = {
    "flow": {"inlet": "{kind: flow, value: 2 cm^3/s, period: 0.2 s, ramp: 0.1 s}"},
    "pressure": {
        "inlet": "{kind: pressure, "
        "fourier: {period: 0.2 s, mean: 10.02 kPa, cosines: [0 Pa], sines: [15 Pa]}}",
        "outlet": "{kind: pressure, value: 10 kPa}",
    },
    "windkessel": {
        "outlet": "{kind: windkessel, proximal_resistance: 2e8 Pa s/m^3, distal_resistance: 5e9 Pa s/m^3, "
        "compliance: 1e-11 m^3/Pa, venous_pressure: 1 kPa}"
    },
    "section": {"outlet": "{kind: resistance, resistance: 5e9 Pa s/m^3, offset: 1 kPa}"},
}


@pytest.mark.parametrize("name", list(BOUNDARIES))
def test_both_schemes_agree_with_every_boundary(case, name):
    """The last half of the cycle, when the start is forgotten."""
    times = np.linspace(0.0, 0.2, 21)
    explicit, implicit = (
        run_case(case(**BOUNDARIES[name], solver=solver), times) for solver in (PARTS["solver"], IMPLICIT)
    )
    for field, share in (("section_flow_rate", 5e-3), ("pressure", 5e-3), ("radius", 2e-4)):
        one, other = (result[field].to_numpy()[10:] for result in (explicit, implicit))
        assert np.max(np.abs(one - other)) < share * np.max(np.abs(other)), field


def test_windkessel_keeps_its_own_balance(case):
    """C dP_c/dt = q − (P_c − P_v)/R₂ and P = P_c + R₁q, from the saved states alone."""
    checked = case(**BOUNDARIES["windkessel"])
    model = model_of(checked)
    stops = list(walk(checked, model, np.linspace(0.0, 0.02, 1001)))  # each step of 20 µs
    section = 0.5 * model.grid.dphi
    flow = np.array([section * stop.columns.flow[-1].sum() for stop in stops])
    held = np.array([float(stop.kept["reservoir"]) for stop in stops])
    outlet = np.array([stop.columns.pressure[-1] for stop in stops])
    np.testing.assert_allclose(outlet, np.repeat((held + 2e8 * flow)[:, None], 4, axis=1), rtol=1e-9)
    middle = 0.5 * (held[1:] + held[:-1])
    charge = 0.5 * (flow[1:] + flow[:-1]) - (middle - 1e3) / 5e9
    np.testing.assert_allclose(
        1e-11 * np.diff(held), 20e-6 * charge, atol=1e-6 * 20e-6 * np.abs(charge).max()
    )


def test_a_flow_inlet_gives_its_flow_at_one_velocity(case):
    checked = case(**BOUNDARIES["flow"])
    model = model_of(checked)
    stops = list(walk(checked, model, np.linspace(0.0, 0.2, 11)))
    for stop in stops[1:]:
        inlet = stop.columns.flow[0]
        wanted = float(model.inlet.signal(stop.time))
        assert 0.5 * model.grid.dphi * inlet.sum() == pytest.approx(wanted, rel=1e-12)
        np.testing.assert_allclose(
            inlet / stop.columns.area[0], inlet[0] / stop.columns.area[0, 0], rtol=1e-12
        )


def test_a_sharp_calcification_is_refused(case):
    allowed = "semi_implicit with a sharp calcification; godunov with transition lengths"
    with pytest.raises(CaseFileError, match=f"scheme: godunov; allowed: {allowed}"):
        case(calcification=SHARP)
