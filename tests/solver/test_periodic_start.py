"""`start: periodic`: one cycle is that of a plain run through many."""

import numpy as np
import pytest

from cases.errors import CaseFileError
from cases.reading.case_file import load_case_file
from solver.case.periodicity import PERIODIC, cycle_change
from solver.case.run import run_case
from solver.runs.batch import run_batch
from solver.runs.result import cell_dataset

PERIOD = 0.8
PARTS = {
    "wall": "{law: thick, youngs_modulus: 0.6 MPa, poisson_ratio: 0.48, reference_pressure: 0 Pa}",
    "calcification": "{pattern: none}",
    "inlet": "{kind: velocity, fourier: {period: 0.8 s, mean: 15 cm/s, cosines: [-3 cm/s], sines: [5 cm/s]}}",
    "outlet": "{kind: windkessel, proximal_resistance: 3e8 Pa s/m^3, distal_resistance: 2e9 Pa s/m^3, "
    "compliance: 2.5e-9 m^3/Pa, venous_pressure: 2 kPa}",
    "solver": "{scheme: semi_implicit, n_x: 12, n_phi: 4, time_step: 4 ms, CYCLES, closure: average}",
}
RESISTANCE = "{kind: resistance, resistance: 3e9 Pa s/m^3, offset: 2 kPa}"
PATCH = "{pattern: local, youngs_modulus: 10 MPa, x: [5 mm, 10 mm], phi: [0 deg, 90 deg], transition: sharp}"
SECTIONS = (
    "{scheme: semi_implicit, pressure: section, n_x: 12, n_phi: 8, time_step: 4 ms, CYCLES, "
    "closure: axis_momentum, profile: two_mode}"
)
ADAPTIVE = PARTS["solver"].replace("CYCLES", "CYCLES, error_tolerance: 1e-5")
KINDS = {
    "a Windkessel of 5 s": {},
    "a resistance": {"outlet": RESISTANCE},
    "a pressure": {"outlet": "{kind: pressure, value: 10 kPa}"},
    "sections of two modes": {"outlet": RESISTANCE, "calcification": PATCH, "solver": SECTIONS},
    "steps by their error": {"outlet": RESISTANCE, "solver": ADAPTIVE},
}


@pytest.fixture
def case(tmp_path):
    def load(cycles, **changes):
        parts = {key: value.replace("CYCLES", cycles) for key, value in (PARTS | changes).items()}
        lines = [
            "name: one",
            "geometry: {length: 15 mm, radius: 2.5 mm, wall_thickness: 0.5 mm}",
            "blood: {density: 1060 kg/m^3, viscosity: 0.0035 Pa s}",
            *(f"{key}: {value}" for key, value in parts.items()),
        ]
        (tmp_path / "one.yaml").write_text("\n".join(lines))
        return load_case_file(tmp_path / "one.yaml").variants["base"]

    return load


@pytest.mark.slow
@pytest.mark.parametrize("changes", KINDS.values(), ids=list(KINDS))
def test_one_cycle_is_that_of_a_long_run(case, changes):
    times, cycles = np.linspace(0.0, PERIOD, 9), 5 if "outlet" in changes else 40
    one = run_case(case("cycles: 1, start: periodic", **changes), times)
    assert cycle_change(case("cycles: 1, start: periodic", **changes), one) <= 2 * PERIODIC
    longer = case(f"cycles: {cycles + 1}", **changes)
    many = run_case(longer, np.insert(cycles * PERIOD + times, 0, 0.0)).isel(time=slice(1, None))
    for name in ("pressure", "section_flow_rate", "radius"):
        apart = np.abs(one[name].to_numpy() - many[name].to_numpy())
        assert np.max(apart) < 1e-3 * np.max(np.abs(many[name].to_numpy())), name


def test_a_time_constant_of_two_minutes_is_no_obstacle(case):
    outlet = PARTS["outlet"].replace("2.5e-9", "6e-8")
    stated = case("cycles: 1, start: periodic", outlet=outlet)
    assert cycle_change(stated, run_case(stated, np.array([0.0, PERIOD]))) <= 2 * PERIODIC


def test_a_batch_starts_alike(case):
    stated, times = case("cycles: 1, start: periodic", calcification=PATCH), np.linspace(0.0, PERIOD, 5)
    (outcome,) = run_batch([stated], times, cell_dataset)
    np.testing.assert_allclose(outcome.kept["pressure"], run_case(stated, times)["pressure"], rtol=1e-9)


@pytest.mark.parametrize(
    "changes",
    [
        {"inlet": PARTS["inlet"].replace("velocity,", "velocity, ramp: 0.1 s,")},
        {"outlet": "{kind: non_reflecting}"},
        {"solver": PARTS["solver"].replace("semi_implicit", "godunov")},
    ],
    ids=["a ramp", "a non-reflecting outlet", "the explicit scheme"],
)
def test_what_has_no_periodic_start_is_told(case, changes):
    with pytest.raises(CaseFileError, match=r"solver\.start: periodic; allowed: (rest|steady) or "):
        case("cycles: 1, start: periodic", **changes)
