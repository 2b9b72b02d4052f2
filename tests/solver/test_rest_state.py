"""Well balanced: "Q = 0, P constant" (2.2.63 with Q = 0) is kept with any β, jumps included."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from thesis_artery import HEALTHY, RADIUS, artery, pressure

from solver.marching.row_stepper import Stepper
from solver.model.boundary import ResistanceOutlet
from solver.model.parameters import State, uniform_state
from solver.wall.stiffness import pressure_from_area

LOAD = 9330.0


def at_rest(stiffness, by="section", load=LOAD):
    model = artery(*stiffness.shape, outlet=ResistanceOutlet(1.358e9, load, by), stiffness=stiffness)
    return Stepper(model, uniform_state(model, load, 0.0))


def check_rest(stepper, load=LOAD):
    assert np.max(np.abs(stepper.state().flow)) < 1e-12 * RADIUS**2  # u below 1e-12 m/s
    np.testing.assert_allclose(pressure(stepper.model, stepper.state().area), load, rtol=1e-12)


def jump(n_x, n_phi, ratio):
    stiffness = np.full((n_x, n_phi), HEALTHY)
    stiffness[n_x // 3 : 2 * n_x // 3, : n_phi // 2] *= ratio
    return stiffness


@pytest.mark.parametrize("by", ["section", "row"])
@pytest.mark.parametrize("time_step", [1e-4, 1e-3, 1e-2])
@pytest.mark.parametrize("theta", [0.5, 0.52, 1.0])
def test_a_jump_keeps_rest(by, time_step, theta):
    stepper = at_rest(jump(12, 8, 50 / 3), by)
    stepper.advance(np.zeros(400), time_step, theta)
    check_rest(stepper)


@settings(deadline=None, max_examples=30)
@given(
    values=st.lists(st.floats(200.0, 2e4), min_size=24, max_size=24),
    load=st.floats(2e3, 2e4),
    time_step=st.floats(1e-4, 1e-2),
)
def test_any_stiffness_keeps_rest(values, load, time_step):
    stepper = at_rest(np.array(values).reshape(6, 4), load=load)
    stepper.advance(np.zeros(50), time_step, 0.52)
    check_rest(stepper, load)


def test_the_area_at_rest_is_that_of_the_pressure_inlet():
    """A(x) = (√A_in β(0)/β(x) + √A₀ (1 − β(0)/β(x)))² (2.2.63), with A_in the inlet's."""
    stiffness = jump(12, 8, 50 / 3)
    stepper = at_rest(stiffness)
    stepper.advance(np.zeros(100), 1e-3, 0.52)
    inlet_radius = RADIUS + LOAD * RADIUS**2 / stiffness[0]
    ratio = stiffness[0] / stiffness
    expected = (inlet_radius * ratio + RADIUS * (1 - ratio)) ** 2
    np.testing.assert_allclose(stepper.state().area, expected, rtol=1e-13)


def test_a_disturbance_dies_and_leaves_rest():
    """The test above cannot see a scheme that does not move: this start is not at rest."""
    stepper = at_rest(jump(12, 8, 50 / 3))
    start = stepper.state()
    stepper = Stepper(stepper.model, State(0.0, 1.001 * start.area, start.flow))
    disturbed = pressure_from_area(stepper.state().area, stepper.model.stiffness, RADIUS, 0.0)
    assert np.max(np.abs(disturbed - LOAD)) > 100
    stepper.advance(np.zeros(200), 1e-2, 1.0)
    np.testing.assert_allclose(pressure(stepper.model, stepper.state().area), LOAD, rtol=1e-9)
