"""Error control: what the tolerance promises, where the steps go, and what stops it."""

import numpy as np
import pytest
from thesis_artery import DIASTOLE, PATTERNS, PULSATILE_OUTLET, artery, thesis_waveform

from solver.errors import NoAdmissibleProfile, NotConverged
from solver.marching.semi_implicit import loosened, simulate, snapshots
from solver.model.parameters import uniform_state
from solver.model.waveform import Waveform

WAVEFORM = thesis_waveform()
TIMES = np.linspace(0, WAVEFORM.period, 9)


@pytest.fixture(scope="module")
def model():
    patch = PATTERNS["local, sharp"]
    return artery(12, 8, inlet=WAVEFORM, outlet=PULSATILE_OUTLET, patch=patch)


@pytest.fixture(scope="module")
def exact(model):
    return simulate(model, TIMES, 5e-5).flow


def test_the_error_follows_the_tolerance(model, exact):
    errors, steps = [], []
    for tolerance in (1e-3, 1e-4, 1e-5, 1e-6):
        run = simulate(model, TIMES, 20e-3, error_tolerance=tolerance)
        errors.append(np.sqrt(np.mean((run.flow - exact) ** 2) / np.mean(exact**2)))
        steps.append(run.steps)
        assert np.max(np.abs(run.mass_defect)) < 1e-10
        assert errors[-1] < 10 * tolerance
    assert errors[3] < 0.05 * errors[0]
    assert np.all(np.diff(errors) < 0)
    assert np.all(np.diff(steps) > 0)
    # local error Δt³: a tenth of the tolerance costs 10^(1/3) = 2.15 times the steps
    assert steps[3] < 30 * steps[0]


def test_steps_are_spent_in_systole(model):
    """The first of eight intervals holds the upstroke, the last ones diastole."""
    states = list(snapshots(model, TIMES, 20e-3, error_tolerance=1e-5))
    spent = np.diff([state.steps for state in states])
    assert spent[0] > 4 * spent[-4:].max()
    longest = [state.longest_step for state in states[1:]]
    assert longest[0] < 0.5 * min(longest[-2:])


def test_no_step_is_longer_than_the_largest(model):
    run = simulate(model, TIMES, 0.4e-3, error_tolerance=0.1)
    assert run.longest_step <= 0.4e-3
    assert run.steps >= WAVEFORM.period / 0.4e-3


def test_every_output_time_is_met(model):
    times = [0.0, 0.0101, 0.013, 0.1, 0.100001]
    run = simulate(model, times, 20e-3, error_tolerance=1e-4)
    np.testing.assert_array_equal(run.times, times)
    fine = simulate(model, times, 5e-5)
    np.testing.assert_allclose(run.flow, fine.flow, rtol=5e-3)


def test_a_run_goes_on_with_the_step_that_was_next(model):
    whole = list(snapshots(model, TIMES, 20e-3, error_tolerance=1e-4))
    middle = whole[4]
    rest = list(snapshots(model, TIMES[4:], 20e-3, middle.state, 1e-4, middle.next_step))
    for one, other in zip(whole[4:], rest, strict=True):
        np.testing.assert_array_equal(one.state.flow, other.state.flow)
        np.testing.assert_array_equal(one.state.area, other.state.area)
        assert one.next_step == other.next_step


def test_a_step_that_fails_is_shortened():
    """An inlet that rises to 2 m/s within 5 ms: one step of 20 ms does not converge."""
    model = artery(24, 1, inlet=lambda time: DIASTOLE + 2.0 * np.clip(np.asarray(time) / 5e-3, 0.0, 1.0))
    start = uniform_state(model, 9330.0, DIASTOLE)
    with pytest.raises(NotConverged):
        simulate(model, [0.0, 20e-3], 20e-3, start)
    run = simulate(model, [0.0, 20e-3], 20e-3, start, error_tolerance=1e-4)
    fine = simulate(model, [0.0, 20e-3], 2e-5, start)
    np.testing.assert_allclose(run.flow[-1], fine.flow[-1], rtol=2e-2)


def test_a_tolerance_that_no_step_keeps_is_named():
    """An inlet that jumps at t > 0, and a tolerance near round-off."""
    inlet = lambda time: np.where(np.asarray(time) > 1.23e-3, 2 * DIASTOLE, DIASTOLE)  # noqa: E731
    model = artery(12, 1, inlet=inlet)
    with pytest.raises(NotConverged, match="no step keeps the error below 1e-14"):
        simulate(model, [0.0, 5e-3], 1e-3, error_tolerance=1e-14)


def test_a_profile_that_is_impossible_stays_named():
    """Shorter steps do not help where the flow reverses row by row."""
    turning = Waveform(np.linspace(0, 1, 5), 0.08 * np.array([1.0, 1.0, -1.0, -1.0, 1.0]))
    model = artery(12, 8, inlet=turning, patch=PATTERNS["local, sharp"])
    with pytest.raises(NoAdmissibleProfile) as caught:
        simulate(model, np.linspace(0, 1, 6), 1e-2, error_tolerance=1e-3)
    assert 0.25 < caught.value.time < 0.5


def test_an_initial_state_is_left_alone(model):
    start = uniform_state(model, 9e3, DIASTOLE)
    before = start.copy()
    simulate(model, [0.5, 0.52], 1e-3, start, error_tolerance=1e-3)
    assert start.time == before.time
    np.testing.assert_array_equal(start.area, before.area)
    np.testing.assert_array_equal(start.flow, before.flow)


@pytest.mark.parametrize("time_step", [2e-3, 4e-3, 8e-3])
def test_the_iteration_of_long_steps_errs_far_less_than_they_do(model, monkeypatch, time_step):
    times = np.linspace(0, WAVEFORM.period, 21)
    exact = simulate(model, times, 1e-4)
    found = simulate(model, times, time_step)
    monkeypatch.setattr("solver.marching.semi_implicit.loosened", lambda tolerance, _: 1e-3 * tolerance)
    converged = simulate(model, times, time_step)
    assert found.sweeps < 0.75 * converged.sweeps
    for name in ("flow", "pressure", "area"):
        iterated, ours, true = (getattr(run, name) for run in (converged, found, exact))
        assert np.max(np.abs(ours - iterated)) < 0.01 * np.max(np.abs(iterated - true))


def test_the_tolerance_of_short_steps_is_not_loosened():
    assert loosened(3e-8, 1e-3) == loosened(3e-8, 1e-5) == 3e-8
    assert loosened(3e-8, 2e-3) == pytest.approx(2.4e-7)
    assert loosened(3e-8, 1.0) == pytest.approx(9e-6)
