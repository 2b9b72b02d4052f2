"""Every inlet with every outlet keeps mass, at every step."""

import numpy as np
import pytest
from thesis_artery import DIASTOLE, PATTERNS, artery

from solver.marching.row_stepper import Stepper
from solver.marching.semi_implicit import implicitness
from solver.marching.steady import steady_state
from solver.model.boundary import (
    Inlet,
    NonReflectingOutlet,
    PressureOutlet,
    ResistanceOutlet,
    WindkesselOutlet,
)
from solver.model.parameters import uniform_state
from solver.model.waveform import FourierSeries

LOAD = 11.9e3


def wave(base, share):
    return FourierSeries(0.2, base, (0.0, 0.2 * share * base), (share * base, 0.0))


INLETS = {
    "velocity": Inlet("velocity", wave(DIASTOLE, 0.4)),
    "flow": Inlet("flow", wave(1.9e-6, 0.4)),
    "pressure": Inlet("pressure", wave(LOAD, 0.05)),
}
OUTLETS = {
    "section resistance": ResistanceOutlet(1.358e9, 9330.0),
    "row resistance": ResistanceOutlet(1.358e9, 9330.0, "row"),
    "moving offset": ResistanceOutlet(1.358e9, wave(9330.0, 0.05)),
    "windkessel": WindkesselOutlet(1e9, 5e9, 1e-10, 600.0),
    "non-reflecting": NonReflectingOutlet(),
    "pressure": PressureOutlet(wave(LOAD - 20.0, 0.05)),
}


def check(model, time_step, count, start=None):
    """The balance of every step and cell, from the states alone, and as reported."""
    theta, grid = implicitness(time_step), model.grid
    stepper = Stepper(model, start or uniform_state(model, LOAD, DIASTOLE))
    first = old = stepper.state()
    for n in range(count):
        reported = stepper.advance_through(n * time_step, time_step, 1, theta)
        new = stepper.state()
        passed = time_step * ((1 - theta) * old.flow + theta * new.flow)
        cells = grid.dx * (new.area - old.area) + np.diff(passed, axis=0)
        largest = np.max(np.abs(passed))
        assert np.max(np.abs(cells)) < 1e-10 * largest
        through = abs(passed[0].sum() - passed[-1].sum() - grid.dx * np.sum(new.area - old.area))
        assert through < 1e-10 * grid.n_phi * largest
        assert abs(reported) < 1e-10
        old = new
    assert np.max(np.abs(new.area - first.area)) > 1e-4 * np.max(first.area)


@pytest.mark.parametrize("outlet", list(OUTLETS))
@pytest.mark.parametrize("inlet", list(INLETS))
def test_one_row(inlet, outlet):
    patch = PATTERNS["axisymmetric, sharp"]
    check(artery(16, 1, patch=patch, inlet=INLETS[inlet], outlet=OUTLETS[outlet]), 1e-3, 200)


@pytest.mark.parametrize("outlet", list(OUTLETS))
@pytest.mark.parametrize("inlet", ["velocity", "flow"])
def test_rows_around_a_local_calcification(inlet, outlet):
    patch = PATTERNS["local, sharp"]
    check(artery(16, 8, patch=patch, inlet=INLETS[inlet], outlet=OUTLETS[outlet]), 1e-3, 200)


@pytest.mark.parametrize("outlet", ["section resistance", "row resistance", "windkessel", "moving offset"])
def test_a_pressure_drives_rows_around_a_local_calcification(outlet):
    """A load that keeps every row flowing forwards."""
    inlet = Inlet("pressure", wave(LOAD, 0.01))
    model = artery(16, 8, patch=PATTERNS["local, sharp"], inlet=inlet, outlet=OUTLETS[outlet])
    check(model, 1e-3, 20, steady_state(model, LOAD))


@pytest.mark.parametrize("exponent", [1.0, 2.0, 9.0])
def test_one_row_of_any_profile(exponent):
    patch = PATTERNS["axisymmetric, sharp"]
    check(artery(16, 1, patch=patch, fixed_exponent=exponent, inlet=INLETS["flow"]), 1e-3, 50)
