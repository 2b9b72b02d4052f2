"""What each inlet prescribes, exactly and at every step; second order with each."""

from itertools import pairwise

import numpy as np
import pytest
from thesis_artery import DIASTOLE, HEALTHY, LENGTH, PATTERNS, SECTION_OUTLET, artery

from solver.errors import ModelError
from solver.marching.row_stepper import Stepper
from solver.marching.semi_implicit import implicitness, simulate
from solver.marching.steady import steady_state
from solver.model.boundary import Inlet, PressureOutlet, ResistanceOutlet
from solver.model.parameters import uniform_state
from solver.model.waveform import constant

BASE = {"velocity": DIASTOLE, "flow": 1.85e-6, "pressure": 11.9e3}
SWING = {"velocity": 0.5, "flow": 0.5, "pressure": 0.1}


class Rise:
    """Infinitely smooth rise and fall over 0.2 s from a base value."""

    period = 0.2

    def __init__(self, kind):
        self.base, self.swing = BASE[kind], SWING[kind]

    def __call__(self, time):
        return self.base * (1 + self.swing * np.sin(np.pi * np.asarray(time) / 0.2) ** 4)


def driven(kind, n_x, n_phi, stiffness=None, patch=None):
    inlet = Inlet(kind, Rise(kind))
    return artery(n_x, n_phi, inlet=inlet, outlet=SECTION_OUTLET, stiffness=stiffness, patch=patch)


@pytest.mark.parametrize("pattern", ["none", "axisymmetric, sharp", "local, sharp"])
@pytest.mark.parametrize("kind", list(BASE))
def test_what_is_prescribed_holds_at_every_step(kind, pattern):
    model = driven(kind, 12, 8, patch=PATTERNS[pattern])
    stepper = Stepper(model, steady_state(model, BASE[kind]))
    for n in range(100):
        stepper.advance_through(n * 2e-3, 2e-3, 1, implicitness(2e-3))
        state, value = stepper.state(), float(model.inlet.signal((n + 1) * 2e-3))
        velocity = state.flow[0] / (1.5 * state.area[0] - 0.5 * state.area[1])
        if kind == "pressure":
            np.testing.assert_allclose(state.inlet_pressure, value, rtol=1e-15)
            continue
        np.testing.assert_allclose(velocity, velocity.mean(), rtol=1e-7)
        if kind == "velocity":
            np.testing.assert_allclose(velocity, value, rtol=1e-7)
        else:
            assert 0.5 * model.grid.dphi * state.flow[0].sum() == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize("pattern", ["none", "local, smooth"])
def test_the_three_kinds_agree_where_they_state_the_same_flow(pattern):
    """Mean velocity, flow rate and pressure of one steady state lead to that state."""
    patch = PATTERNS[pattern]
    first = steady_state(driven("velocity", 40, 8, patch=patch), DIASTOLE)
    section = 0.5 * 2 * np.pi / 8 * first.flow[0].sum()
    same = steady_state(driven("flow", 40, 8, patch=patch), section)
    np.testing.assert_allclose(same.flow, first.flow, rtol=1e-9)
    np.testing.assert_allclose(same.area, first.area, rtol=1e-11)
    if pattern == "none":  # else the rows' pressures differ at the inlet
        pressure = 1.5 * first.pressure[0] - 0.5 * first.pressure[1]
        same = steady_state(driven("pressure", 40, 8, patch=patch), float(pressure[0]))
        np.testing.assert_allclose(same.flow, first.flow, rtol=1e-6)


def bump(grid, rise=3.0, asymmetry=0.3):
    """Flat at the ends, whose wall is that of the cell beside them."""
    along = np.exp(-(((grid.x / LENGTH - 0.5) / 0.12) ** 2))
    return HEALTHY * (1 + rise * np.outer(along, 1 + asymmetry * np.cos(grid.phi)))


def answers(kind, n_x, time_step, coarsest):
    grid = artery(n_x, 4).grid
    model = driven(kind, n_x, 4, stiffness=bump(grid))
    run = simulate(model, [0.0, 0.08], time_step)
    cells = run.pressure[-1].reshape(coarsest, -1, 4).mean(axis=1)
    return run.flow[-1, :: n_x // coarsest], cells


def orders(kind, resolutions, coarsest):
    found = [answers(kind, n_x, time_step, coarsest) for n_x, time_step in resolutions]
    errors = [
        [norm for a, b in zip(one, two, strict=True) for norm in (np.abs(a - b).max(), np.std(a - b))]
        for one, two in pairwise(found)
    ]
    return np.log2(np.array(errors[:-1]) / np.array(errors[1:]))


@pytest.mark.parametrize("kind", ["flow", "pressure"])
def test_second_order_in_time(kind):
    observed = orders(kind, [(12, dt) for dt in (2e-3, 1e-3, 0.5e-3, 0.25e-3)], 12)
    assert np.all((observed[-1] > 1.9) & (observed[-1] < 2.1)), observed


@pytest.mark.parametrize("kind", ["flow", "pressure"])
def test_second_order_along_the_artery(kind):
    observed = orders(kind, [(n_x, 2e-3) for n_x in (20, 40, 80, 160, 320)], 20)
    assert np.all((observed[-1] > 1.9) & (observed[-1] < 2.3)), observed


def test_a_pressure_difference_drives_poiseuille_flow():
    """A stiff tube: q = π R⁴ ΔP/(8 μ L)."""
    inlet, stiffness = Inlet("pressure", constant(1002.0, 1.0)), np.full((12, 4), 4e7)
    model = artery(
        12, 4, inlet=inlet, outlet=PressureOutlet(constant(1000.0, 1.0)), stiffness=stiffness, length=0.15
    )
    state = steady_state(model, 1002.0)
    section = np.pi * state.flow.mean()
    assert section == pytest.approx(np.pi * 2.5e-3**4 * 2.0 / (8 * 0.003 * 0.15), rel=1e-3)


def test_a_pressure_inlet_and_a_resistance_make_a_divider():
    """Friction is small: P_in − P_res = R_res q + 8μL/(πR⁴) q."""
    inlet = Inlet("pressure", constant(10e3, 1.0))
    model = artery(60, 1, inlet=inlet, outlet=ResistanceOutlet(1e9, 9e3))
    state = steady_state(model, 10e3)
    area = state.area.mean()
    friction = 8 * 0.003 * LENGTH / (np.pi * area**2)
    assert np.pi * state.flow.mean() == pytest.approx(1e3 / (1e9 + friction), rel=2e-4)


@pytest.mark.parametrize("kind", ["speed", "", "Pressure"])
def test_kinds_that_are_refused(kind):
    with pytest.raises(ModelError, match="allowed: velocity, flow, pressure"):
        Inlet(kind, constant(1.0, 1.0))


def test_a_pressure_inlet_moves_blood_at_rest():
    model = artery(12, 4, inlet=Inlet("pressure", constant(1e3, 1.0)))
    run = simulate(model, [0.0, 1e-3, 0.1], 1e-4, uniform_state(model, 0.0, 0.0))
    assert run.flow[1, 0].min() > 0
