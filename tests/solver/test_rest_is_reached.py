"""Pressure inlet, non-reflecting outlet: rest at one pressure (2.2.63), reached by marching from elsewhere.

The thesis's scheme cannot reach it with a local calcification (3.3.1): on the way its rows have no common
velocity on the axis.
"""

import numpy as np
import pytest
from closed_forms import rest_area
from thesis_artery import PATTERNS, RADIUS, artery

from solver.marching.row_stepper import Stepper
from solver.marching.steady import steady_state
from solver.model.boundary import Inlet, NonReflectingOutlet
from solver.model.parameters import uniform_state
from solver.model.waveform import constant


def held(pressure, pattern, n_x=24, n_phi=8):
    inlet = Inlet("pressure", constant(pressure, 1.0))
    return artery(n_x, n_phi, patch=PATTERNS[pattern], inlet=inlet, outlet=NonReflectingOutlet())


def closed_form(model, pressure):
    """(√A_in β(0)/β + √A₀ (1 − β(0)/β))²."""
    ratio = model.stiffness[0] / model.stiffness
    inlet_radius = RADIUS + pressure * RADIUS**2 / model.stiffness[0]
    return (inlet_radius * ratio + RADIUS * (1 - ratio)) ** 2


@pytest.mark.parametrize("pressure", [1e3, 1e4])
@pytest.mark.parametrize("pattern", list(PATTERNS))
def test_the_closed_form(pattern, pressure):
    model = held(pressure, pattern)
    given = rest_area(model.stiffness, pressure, RADIUS, 0.0)
    np.testing.assert_allclose(given, closed_form(model, pressure), rtol=1e-14)


@pytest.mark.parametrize("share", [0.0, 0.9])
@pytest.mark.parametrize("pressure", [1e3, 1e4])
@pytest.mark.parametrize("pattern", list(PATTERNS))
def test_the_march_reaches_rest(pattern, pressure, share):
    """From blood at rest at a share of the inlet's pressure, which jumps."""
    model = held(pressure, pattern)
    state = steady_state(model, pressure, uniform_state(model, share * pressure, 0.0))
    np.testing.assert_allclose(state.area, closed_form(model, pressure), rtol=1e-10)
    assert np.max(np.abs(state.flow)) < 1e-9 * RADIUS**2


@pytest.mark.parametrize("pattern", ["local, sharp", "local, smooth"])
def test_the_march_reaches_rest_on_the_thesis_rows(pattern):
    """48 rows exchange momentum so fast that a step of 2 ms does not converge: the march must shorten it."""
    model = held(1e4, pattern, 60, 48)
    state = steady_state(model, 1e4, uniform_state(model, 0.0, 0.0))
    np.testing.assert_allclose(state.area, closed_form(model, 1e4), rtol=1e-10)
    assert np.max(np.abs(state.flow)) < 1e-9 * RADIUS**2


@pytest.mark.parametrize("pattern", list(PATTERNS))
def test_it_is_where_the_march_starts_by_default(pattern):
    model = held(1e4, pattern)
    np.testing.assert_allclose(steady_state(model, 1e4).area, closed_form(model, 1e4), rtol=1e-13)


def test_a_jump_is_not_extrapolated():
    """The third step's first iterate, extrapolated through the jump, has rows of both directions."""
    model = held(1e3, "local, sharp")
    stepper = Stepper(model, uniform_state(model, 0.0, 0.0))
    stepper.advance(np.full(20, 1e3), 1e-3, 1.0)
    together = stepper.state()
    stepper = Stepper(model, uniform_state(model, 0.0, 0.0))
    for _ in range(20):
        stepper.advance(np.full(1, 1e3), 1e-3, 1.0)  # alone, a step extrapolates nothing
    np.testing.assert_allclose(stepper.state().flow, together.flow, rtol=1e-6)
    np.testing.assert_allclose(stepper.state().area, together.area, rtol=1e-8)
