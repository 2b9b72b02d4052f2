"""What must not matter: the number of equal rows, where φ = 0 lies, its direction, the cycle's number, Δt."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from thesis_artery import (
    DIASTOLE,
    PATTERNS,
    PULSATILE_OUTLET,
    RING,
    SECTION_OUTLET,
    STEADY_OUTLET,
    artery,
    section_flow,
    thesis_waveform,
)

from solver.geometry.calcification import Patch
from solver.geometry.grid import Grid
from solver.marching.semi_implicit import simulate
from solver.model.parameters import uniform_state

WAVEFORM = thesis_waveform()
OUTLETS = pytest.mark.parametrize("outlet", [SECTION_OUTLET, STEADY_OUTLET], ids=["section", "row"])
TIMES = np.linspace(0, 0.2, 5)


def run(n_phi, outlet=SECTION_OUTLET, times=TIMES, time_step=1e-3, **model):
    return simulate(artery(12, n_phi, outlet=outlet, inlet=WAVEFORM, **model), times, time_step)


@OUTLETS
@pytest.mark.parametrize("pattern", ["none", "axisymmetric, sharp", "axisymmetric, smooth"])
def test_one_row_is_as_good_as_eight_equal_ones(pattern, outlet):
    one, eight = (run(n_phi, outlet, patch=PATTERNS[pattern]) for n_phi in (1, 8))
    np.testing.assert_allclose(eight.flow, np.repeat(one.flow, 8, axis=-1), rtol=1e-10)
    np.testing.assert_allclose(eight.area, np.repeat(one.area, 8, axis=-1), rtol=1e-12)


@settings(deadline=None, max_examples=20)
@given(turn=st.integers(1, 15), first=st.integers(0, 15), width=st.integers(1, 12), by=st.booleans())
def test_turning_the_patch_turns_the_answer(turn, first, width, by):
    dphi = Grid(1.0, 3, 16).dphi
    outlet = SECTION_OUTLET if by else STEADY_OUTLET

    def turned(row):
        ends = (row % 16 * dphi, (row + width) % 16 * dphi)
        return run(16, outlet, [0.0, 0.1], 2e-3, patch=Patch(RING, ends))

    here, there = turned(first), turned(first + turn)
    np.testing.assert_allclose(there.flow, np.roll(here.flow, turn, axis=-1), rtol=1e-10)
    np.testing.assert_allclose(there.area, np.roll(here.area, turn, axis=-1), rtol=1e-12)


@settings(deadline=None, max_examples=10)
@given(st.lists(st.floats(300.0, 7000.0), min_size=4, max_size=4), st.booleans())
def test_mirroring_phi_mirrors_the_answer(ring, by):
    stiffness = np.full((12, 4), 400.0)
    stiffness[4:8] = ring
    outlet = SECTION_OUTLET if by else STEADY_OUTLET
    here = run(4, outlet, [0.0, 0.1], 2e-3, stiffness=stiffness)
    mirrored = run(4, outlet, [0.0, 0.1], 2e-3, stiffness=stiffness[:, ::-1].copy())
    np.testing.assert_allclose(mirrored.flow, here.flow[..., ::-1], rtol=1e-10)


@pytest.mark.parametrize("cycles", [1, 7])
def test_whole_cycles_later_is_the_same(cycles):
    now = run(8, patch=PATTERNS["local, sharp"])
    later = run(8, times=TIMES + cycles * WAVEFORM.period, patch=PATTERNS["local, sharp"])
    np.testing.assert_allclose(later.flow, now.flow, rtol=1e-8)
    np.testing.assert_allclose(later.times - cycles * WAVEFORM.period, now.times, atol=1e-12)


def test_a_cycle_repeats():
    """No drift: the second and the third cycle are equal at their ends."""
    period = WAVEFORM.period
    cycles = run(8, PULSATILE_OUTLET, [0.0, 1.3 * period, 2.3 * period], patch=PATTERNS["local, sharp"])
    np.testing.assert_allclose(cycles.flow[2], cycles.flow[1], rtol=1e-6)


@OUTLETS
@pytest.mark.parametrize("pattern", ["none", "local, sharp"])
def test_a_millisecond_is_short_enough(pattern, outlet):
    """1 ms against 0.25 ms: less than 1e-4 of the peak flow at the instants the thesis prints."""
    times = [0.0, 1.693 % WAVEFORM.period, 1.884 % WAVEFORM.period, WAVEFORM.period]
    coarse, fine = (run(8, outlet, times, dt, patch=PATTERNS[pattern]) for dt in (1e-3, 0.25e-3))
    difference = np.abs(section_flow(coarse) - section_flow(fine))
    assert np.max(difference) < 1e-4 * np.max(section_flow(fine))


@pytest.mark.parametrize("outlet", [SECTION_OUTLET, PULSATILE_OUTLET], ids=["section", "row"])
def test_saving_more_states_changes_nothing(outlet):
    patch = PATTERNS["local, smooth"]
    often = run(8, outlet, np.linspace(0, 0.2, 41), patch=patch)
    seldom = run(8, outlet, [0.0, 0.1, 0.2], patch=patch)
    assert often.steps == seldom.steps == 200
    np.testing.assert_allclose(often.flow[::20], seldom.flow, rtol=1e-7)


def test_intervals_are_cut_into_equal_steps():
    uneven = simulate(artery(12, 4), [0.0, 0.0105, 0.0125, 0.0130], 1e-3)
    assert uneven.steps == 11 + 2 + 1
    assert uneven.longest_step == pytest.approx(1e-3)


def test_a_given_initial_state_is_used_and_kept():
    model = artery(12, 4)
    start = uniform_state(model, 9e3, DIASTOLE)
    result = simulate(model, [0.5, 0.52], 1e-3, start)
    np.testing.assert_array_equal(result.area[0], start.area)
    np.testing.assert_array_equal(start.area, uniform_state(model, 9e3, DIASTOLE).area)
    assert not np.allclose(result.area[1], start.area, rtol=1e-6)
    np.testing.assert_array_equal(result.times, [0.5, 0.52])


def test_progress_is_told_at_every_state():
    seen = []
    simulate(artery(12, 4), [0.0, 0.01, 0.02], 1e-3, progress=lambda done, total: seen.append((done, total)))
    assert seen == [(0.0, 0.02), (0.01, 0.02), (0.02, 0.02)]
