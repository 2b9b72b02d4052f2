"""The periodic flow through a Windkessel, beside that of a plain run through many cycles."""

import numpy as np
import pytest

import solver.case.periodic_outlet as periodic
import solver.case.start as start
from cases.reading.case_file import load_case_file
from cases.sections.outlet import NonReflectingOutlet
from solver.case.model import model_of
from solver.case.periodicity import cycle_change
from solver.case.run import walk
from solver.errors import SolverError

CASE = """
name: small
geometry: {length: 15 mm, radius: 2.5 mm, wall_thickness: 0.5 mm}
blood: {density: 1060 kg/m^3, viscosity: 0.0035 Pa s}
wall: {law: thick, youngs_modulus: 0.6 MPa, poisson_ratio: 0.48, reference_pressure: 0 Pa}
calcification: {pattern: none}
inlet: {kind: velocity, ramp: 0.1 s,
        fourier: {period: 0.8 s, mean: 15 cm/s, cosines: [-3 cm/s], sines: [5 cm/s]}}
outlet: {kind: windkessel, proximal_resistance: 3e8 Pa s/m^3, distal_resistance: 2e9 Pa s/m^3,
         compliance: COMPLIANCE m^3/Pa, venous_pressure: 2 kPa}
solver: {scheme: semi_implicit, n_x: 12, n_phi: 4, time_step: 4 ms, cycles: 2, closure: average}
"""


@pytest.fixture
def case(tmp_path):
    def of(compliance, **changes):
        text = CASE.replace("COMPLIANCE", compliance)
        for old, new in changes.items():
            assert old in text
            text = text.replace(old, new)
        path = tmp_path / "case.yaml"
        path.write_text(text, encoding="utf-8")
        return load_case_file(path).variants["base"]

    return of


@pytest.mark.parametrize(("compliance", "most"), [("1e-10", 3), ("6e-10", 4), ("2.5e-9", 4)])
def test_it_is_that_of_many_plain_cycles(case, compliance, most):
    stated = case(compliance)
    counted = []
    found = periodic.periodic_outlet_flow(stated, lambda done, _: counted.append(done))
    assert len(counted) <= most
    times = 60 * 0.8 + 0.8 * np.arange(periodic.INSTANTS) / periodic.INSTANTS  # 7.7 of the longest R₂C
    stops = list(walk(stated, model_of(stated), np.insert(times, 0, 0.0)))[1:]
    plain = np.array([0.25 * np.pi * stop.columns.flow[-1].sum() for stop in stops])
    np.testing.assert_allclose(found, plain, atol=1e-3 * plain.max())


def test_an_artery_without_flow_is_periodic(case):
    still = case(
        "1e-10", **{"mean: 15 cm/s": "mean: 0 cm/s", "[-3 cm/s]": "[0 cm/s]", "[5 cm/s]": "[0 cm/s]"}
    )
    still = still.model_copy(update={"outlet": still.outlet.model_copy(update={"venous_pressure": 0.0})})
    np.testing.assert_array_equal(periodic.periodic_outlet_flow(still), 0.0)


@pytest.mark.parametrize(("last", "expected"), [(0.0, 0.0), (-3.0, 1.0)])
def test_a_cycle_that_starts_at_rest_has_a_finite_change(case, last, expected):
    values = np.zeros((3, 2, 2))
    values[2, 1] = last
    fields = {"time": np.array([0.0, 0.8, 1.6]), "pressure": values, "section_flow_rate": values[..., 0]}
    assert cycle_change(case("1e-10"), fields) == expected


def test_limits_and_ramp_of_a_case_do_not_count(case):
    plain = periodic.periodic_outlet_flow(case("1e-10"))
    limited = case("1e-10", **{"cycles: 2,": "cycles: 7, limits: {mass_defect: 1e-15},", "ramp: 0.1 s,": ""})
    np.testing.assert_array_equal(periodic.periodic_outlet_flow(limited), plain)


def test_a_run_that_does_not_become_periodic_is_told(case, monkeypatch):
    monkeypatch.setattr(start, "MOST_CYCLES", 1)
    with pytest.raises(SolverError, match=r"changes by .* \(relative\) over cycle 1"):
        periodic.periodic_outlet_flow(case("6e-10"))


def test_an_outlet_without_a_capacitor_is_refused(case):
    resistance = case("1e-10").model_copy(update={"outlet": NonReflectingOutlet(kind="non_reflecting")})
    with pytest.raises(SolverError, match=r"outlet\.kind: non_reflecting; allowed"):
        periodic.periodic_outlet_flow(resistance)
