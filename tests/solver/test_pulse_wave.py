"""The pulse wave: speed and damping of a small standing wave in a closed tube without friction.

P = P_m + ε cos(πx/L) between walls at x = 0 and L swings with the period 2L/c, c² = β√A/(2ρA₀).
"""

import numpy as np
import pytest
from thesis_artery import DENSITY, HEALTHY, LENGTH, RADIUS, artery, pressure

from solver.marching.row_stepper import Stepper
from solver.model.boundary import ResistanceOutlet
from solver.model.parameters import State, uniform_state

MEAN, AMPLITUDE = 9330.0, 10.0


def closed_tube(n_x, n_phi, by):
    """A resistance of 1e18 Pa s/m³ lets nothing through."""
    model = artery(n_x, n_phi, outlet=ResistanceOutlet(1e18, MEAN, by), viscosity=0.0)
    state = uniform_state(model, MEAN, 0.0)
    load = MEAN + AMPLITUDE * np.cos(np.pi * model.grid.x / LENGTH)
    area = ((RADIUS + load * RADIUS**2 / HEALTHY) ** 2)[:, None] * np.ones(n_phi)
    return Stepper(model, State(0.0, area, state.flow))


def amplitude(stepper):
    """Component of P along cos(πx/L), Pa."""
    mode = np.cos(np.pi * stepper.model.grid.x / LENGTH)
    return 2 * np.mean(pressure(stepper.model, stepper.state().area).mean(axis=1) * mode)


def wave_speed():
    radius = RADIUS + MEAN * RADIUS**2 / HEALTHY
    return np.sqrt(HEALTHY * radius / (2 * DENSITY * RADIUS**2))


@pytest.mark.parametrize("by", ["section", "row"])
@pytest.mark.parametrize("n_phi", [1, 4])
def test_speed_of_the_wave(n_phi, by):
    assert wave_speed() == pytest.approx(9.0, abs=0.2)  # m/s
    stepper, steps = closed_tube(40, n_phi, by), 400
    quarter = LENGTH / (2 * wave_speed())
    swing = [amplitude(stepper)]
    for _ in range(4):
        stepper.advance(np.zeros(steps), quarter / steps, 0.5)
        swing.append(amplitude(stepper))
    np.testing.assert_allclose(np.array(swing) / AMPLITUDE, [1, 0, -1, 0, 1], atol=0.01)


def test_an_implicit_step_damps_the_wave_and_a_centred_one_does_not():
    swings = {}
    for theta in (0.5, 0.6):
        stepper = closed_tube(40, 1, "row")
        period = 2 * LENGTH / wave_speed()
        stepper.advance(np.zeros(100), period / 100, theta)
        swings[theta] = amplitude(stepper) / AMPLITUDE
    assert swings[0.5] == pytest.approx(1, abs=0.01)
    # |growth per step|² ≈ 1 − (2θ−1)(ωΔt)² over 100 steps of ωΔt = 2π/100
    assert swings[0.6] == pytest.approx(np.exp(-0.5 * 0.2 * (2 * np.pi / 100) ** 2 * 100), abs=0.01)
