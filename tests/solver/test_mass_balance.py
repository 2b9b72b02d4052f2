"""Mass: what flows in, flows out or widens the lumen, at every step and in every cell."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from thesis_artery import HEALTHY, PATTERNS, SECTION_OUTLET, artery, patched, thesis_waveform

from solver.geometry.grid import Grid
from solver.marching.row_stepper import Stepper, lumen_volume
from solver.marching.semi_implicit import simulate
from solver.marching.steady import steady_state
from solver.model.boundary import ResistanceOutlet

WAVEFORM = thesis_waveform()


def outlet(by):
    return ResistanceOutlet(SECTION_OUTLET.resistance, SECTION_OUTLET.offset, by)


def pulsatile(n_x, n_phi, by, calcified, pattern="local, sharp"):
    beta = patched(Grid(15e-3, n_x, n_phi), PATTERNS[pattern], calcified)
    return artery(n_x, n_phi, outlet=outlet(by), inlet=WAVEFORM, stiffness=beta)


def check_steps(model, time_step, theta, count):
    """Drive the scheme step by step; every balance is computed here from the states alone."""
    stepper = Stepper(model, steady_state(model, float(WAVEFORM(0.0))))
    grid, old = model.grid, stepper.state()
    for n in range(1, count + 1):
        velocity = float(WAVEFORM(n * time_step))
        reported = stepper.advance(np.array([velocity]), time_step, theta)
        state = stepper.state()

        passed = time_step * ((1 - theta) * old.flow + theta * state.flow)
        sector = 0.5 * grid.dphi
        inflow, outflow = sector * passed[0].sum(), sector * passed[-1].sum()
        change = sector * grid.dx * np.sum(state.area - old.area)
        assert abs(inflow - outflow - change) < 1e-10 * inflow
        assert abs(reported) < 1e-10
        cells = grid.dx * (state.area - old.area) + np.diff(passed, axis=0)
        assert np.max(np.abs(cells)) < 1e-10 * np.max(passed)

        inlet_area = 1.5 * state.area[0] - 0.5 * state.area[1]
        np.testing.assert_allclose(state.flow[0], velocity * inlet_area, rtol=1e-7)
        old = state
    assert stepper.time == pytest.approx(count * time_step)


@settings(deadline=None, max_examples=25)
@given(
    by=st.sampled_from(["section", "row"]),
    ratio=st.floats(0.5, 20.0),
    time_step=st.floats(1e-5, 3e-3),
    theta=st.floats(0.52, 1.0),
    n_phi=st.integers(4, 9),
    n_x=st.integers(3, 16),
)
def test_every_step_balances(by, ratio, time_step, theta, n_phi, n_x):
    check_steps(pulsatile(n_x, n_phi, by, ratio * HEALTHY), time_step, theta, 12)


@pytest.mark.parametrize("by", ["section", "row"])
def test_a_whole_cycle_balances(by):
    check_steps(pulsatile(12, 8, by, 20000 / 3), 1e-3, 0.52, 797)


def test_the_defect_of_a_run_is_that_of_its_intervals():
    model = pulsatile(12, 8, "section", 20000 / 3)
    run = simulate(model, np.linspace(0, WAVEFORM.period, 9), 1e-3)
    assert run.mass_defect.shape == (9,)
    assert np.max(np.abs(run.mass_defect)) < 1e-11
    assert run.steps == 8 * 100
    assert run.longest_step == pytest.approx(WAVEFORM.period / 800)


def test_volume_of_a_cylinder():
    model = artery(7, 5)
    volume = lumen_volume(model, np.full((7, 5), 4e-6))
    assert volume == pytest.approx(np.pi * 4e-6 * 15e-3)
