"""A run that cannot go on says why, when and where, and gives no numbers."""

from dataclasses import fields

import numpy as np
import pytest
from thesis_artery import DIASTOLE, PATTERNS, SECTION_OUTLET, artery

from solver.errors import (
    ModelError,
    NoAdmissibleProfile,
    NotConverged,
    NotFinite,
    NotSteady,
    RunFailure,
    SolverError,
    WallCollapse,
)
from solver.marching import steady
from solver.marching.columns import columns_of
from solver.marching.row_stepper import Stepper
from solver.marching.semi_implicit import simulate, snapshots
from solver.marching.steady import steady_state
from solver.marching.walk import Stop, history_of
from solver.model.boundary import Inlet, NonReflectingOutlet, ResistanceOutlet
from solver.model.diagnostics import Limits, Monitor
from solver.model.parameters import State, uniform_state
from solver.model.waveform import Waveform, constant


def advance(model, state, velocity=DIASTOLE, time_step=1e-3, steps=1):
    Stepper(model, state).advance(np.full(steps, velocity), time_step, 0.52)


def test_flow_that_reverses_row_by_row_has_no_profile():
    inlet = Waveform(np.linspace(0, 1, 5), 0.08 * np.array([1.0, 1.0, -1.0, -1.0, 1.0]))
    model = artery(12, 8, inlet=inlet, patch=PATTERNS["local, sharp"])
    with pytest.raises(NoAdmissibleProfile) as caught:
        simulate(model, np.linspace(0, 1, 6), 1e-3)
    failure = caught.value
    assert 0.25 < failure.time < 0.5  # while the inlet turns
    assert 1 <= failure.i <= 12
    assert 1 <= failure.j <= 8
    assert f"at t = {failure.time:.6g} s, i = {failure.i}, j = {failure.j}" in str(failure)
    assert "no admissible velocity-profile exponent" in str(failure)


@pytest.mark.parametrize(("face", "cell"), [(0, 1), (5, 6), (12, 12)])
def test_one_jet_has_no_profile_and_is_named(face, cell):
    """Face f lies left of cell f + 1 (counted from 1); the outlet belongs to the last cell."""
    model = artery(12, 8)
    state = uniform_state(model, 9330.0, DIASTOLE)
    state.flow[face, 3] *= 20
    state.time = 0.25
    with pytest.raises(NoAdmissibleProfile, match=rf"at t = 0.251 s, i = {cell}, j = 4$"):
        advance(model, state)


def test_a_single_row_may_reverse():
    """The 1D model has γ = 2 whatever the direction."""
    inlet = Waveform(np.linspace(0, 1, 5), 0.08 * np.array([1.0, 1.0, -1.0, -1.0, 1.0]))
    run = simulate(artery(12, 1, inlet=inlet), np.linspace(0, 1, 6), 1e-3)
    assert run.flow.min() < 0 < run.flow.max()
    assert np.all(np.isfinite(run.area))


def test_suction_collapses_the_wall():
    model = artery(12, 8, outlet=ResistanceOutlet(1.358e9, -4e5, "section"))
    state = uniform_state(artery(12, 8), 9330.0, DIASTOLE)
    state.time = 1.5
    with pytest.raises(WallCollapse, match=r"lumen collapsed .* at t = 1.501 s, i = 12, j = 1$") as caught:
        advance(model, state)
    assert (caught.value.i, caught.value.j) == (12, 1)
    with pytest.raises(WallCollapse):
        simulate(model, [0.0, 0.1], 1e-3, state)
    with pytest.raises(ModelError, match="lumen collapses at P = -3"):
        steady_state(model, DIASTOLE)


def test_a_step_without_solution_does_not_converge():
    """An inlet of 6 m/s beside the wave speed of 7 m/s, from one step to the next."""
    model = artery(24, 4)
    state = uniform_state(model, 9330.0, DIASTOLE)
    state.time = 2.0
    with pytest.raises(
        NotConverged, match=r"did not converge at t = 2.001 s: try a smaller time_step$"
    ) as caught:
        advance(model, state, velocity=6.0)
    assert (caught.value.i, caught.value.j) == (0, 0)


def test_time_counts_the_steps_that_were_taken():
    model = artery(12, 8)
    stepper = Stepper(model, uniform_state(model, 9330.0, DIASTOLE))
    with pytest.raises(NotFinite, match=r"a field is not finite at t = 0.004 s$"):
        stepper.advance(np.array([DIASTOLE, DIASTOLE, DIASTOLE, np.nan]), 1e-3, 0.52)
    assert stepper.steps == 3


def test_a_result_without_profile_is_no_result():
    model = artery(12, 4)
    state = uniform_state(model, 9330.0, DIASTOLE)
    flow = np.array([state.flow, state.flow])
    flow[1, 4:6, 2] *= 20
    twice = [np.array([part] * 2) for part in (state.area, state.pressure)]
    states = [State(t, a, q, p) for t, a, p, q in zip((0.0, 0.1), *twice, flow, strict=True)]
    watched = Monitor(model, Limits()).look(0.0, columns_of(model, states[0]), 0.0, 0.0)
    stops = [Stop(each.time, columns_of(model, each), watched, 1, 1, 0.1, {}) for each in states]
    with pytest.raises(NoAdmissibleProfile, match=r"at t = 0.1 s, i = 4, j = 3$"):
        history_of(stops)


@pytest.mark.parametrize("times", [[], [0.0, 0.0], [0.1, 0.0], [0.0, np.nan], [[0.0, 1.0]]])
def test_times_that_are_refused(times):
    with pytest.raises(ModelError, match="one or more, finite, and increase"):
        simulate(artery(12, 4), times, 1e-3)


@pytest.mark.parametrize("time_step", [0.0, -1e-3, np.nan, np.inf])
def test_time_steps_that_are_refused(time_step):
    with pytest.raises(ModelError, match=r"time step = .* s; allowed: positive"):
        simulate(artery(12, 4), [0.0, 1.0], time_step)


def test_one_family():
    for failure in (NoAdmissibleProfile, WallCollapse, NotConverged, NotFinite):
        assert issubclass(failure, RunFailure)
    assert issubclass(RunFailure, SolverError)
    assert issubclass(ModelError, SolverError)
    assert str(WallCollapse(0.5, 3, 4, "why")).endswith("at t = 0.5 s, i = 3, j = 4: why")


@pytest.mark.parametrize("field", ["area", "flow"])
def test_a_state_that_is_not_a_number_gives_no_result(field):
    model = artery(12, 8)
    state = uniform_state(model, 9330.0, DIASTOLE)
    getattr(state, field)[5, 2] = np.nan
    with pytest.raises(SolverError):
        advance(model, state)


@pytest.mark.parametrize(
    "changes",
    [
        {"reference_pressure": np.nan},
        {"reference_pressure": np.inf},
        {"density": np.inf},
        {"radius": np.inf},
        {"viscosity": np.nan},
        {"length": np.inf},
    ],
    ids=str,
)
def test_a_model_refuses_what_is_not_finite(changes):
    with pytest.raises(ModelError):
        artery(12, 8, **changes)


@pytest.mark.parametrize("values", [(1e9, np.nan), (np.inf, 9330.0), (np.nan, 9330.0), (1e9, np.inf)])
def test_an_outlet_refuses_what_is_not_finite(values):
    with pytest.raises(ModelError):
        ResistanceOutlet(*values)


def test_a_failed_step_does_not_touch_the_state():
    model = artery(12, 8, outlet=ResistanceOutlet(SECTION_OUTLET.resistance, -4e5, "section"))
    state = uniform_state(artery(12, 8), 9330.0, DIASTOLE)
    before, stepper = state.copy(), Stepper(model, state)
    with pytest.raises(WallCollapse):
        stepper.advance(np.full(1, DIASTOLE), 1e-3, 0.52)
    for after in (state, stepper.state()):
        for part in fields(State):
            np.testing.assert_array_equal(getattr(after, part.name), getattr(before, part.name))


def test_a_march_without_a_steady_state_names_it_and_no_time_step(monkeypatch):
    monkeypatch.setattr(steady, "MOST_STEPS", 3)
    with pytest.raises(NotSteady) as caught:
        steady_state(artery(12, 4), DIASTOLE)
    assert str(caught.value).startswith("no steady state was reached at t = ")
    assert "time_step" not in str(caught.value)


def test_a_wave_from_rest_into_a_patch_has_no_profile_at_its_foot():
    """Stiff rows conduct the wave faster: at its foot they carry more than twice the section's mean."""
    inlet = Inlet("pressure", constant(1e3, 1.0))
    model = artery(60, 24, inlet=inlet, outlet=NonReflectingOutlet(), patch=PATTERNS["local, sharp"])
    run = snapshots(model, np.arange(0, 1e-3, 5e-6), 5e-6, uniform_state(model, 0.0, 0.0))
    with pytest.raises(NoAdmissibleProfile) as caught:
        list(run)
    assert caught.value.j == 10  # the first row of the patch
    flow = flow_before(model, caught.value.time)[caught.value.i - 1]
    share = flow / (2 * flow.mean())
    assert np.all(share[9:15] > 1.0)
    assert np.all((share[:9] > 0.0) & (share[:9] < 0.5))


def flow_before(model, failure):
    """Q one step of 5 µs before a failure."""
    times = np.arange(0, failure - 2.5e-6, 5e-6)
    return simulate(model, times, 5e-6, uniform_state(model, 0.0, 0.0)).flow[-1]


@pytest.mark.parametrize("share", [0.05, 0.5])
def test_a_flow_to_begin_with_carries_a_jump_in_small_steps(share):
    model = artery(
        60,
        24,
        inlet=lambda time: DIASTOLE * (1 + share * (np.asarray(time) > 0)),
        patch=PATTERNS["local, sharp"],
    )
    run = simulate(model, [0.0, 5e-3], 2e-5, steady_state(model, DIASTOLE))
    assert run.steps == 250
