"""Which states are compared, and when."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from validation.errors import UnusableReferenceError
from validation.reference.alignment import align

PERIOD = 0.8


def test_the_last_cycle_with_both_its_ends():
    times = np.arange(0.0, 2.01, 0.1) * PERIOD
    found = align(times, 0.0, PERIOD, 3)
    assert_array_equal(found.states, np.arange(10, 21))
    assert_allclose(found.cycle_times, np.linspace(0.0, PERIOD, 11), atol=1e-12)
    assert_allclose(found.rom_times, np.linspace(2 * PERIOD, 3 * PERIOD, 11))
    assert found.cycles_later == 1
    assert found.coverage == pytest.approx(1.0)


@given(st.floats(-3.0, 3.0), st.integers(1, 5), st.floats(0.1, 2.0))
def test_an_offset_moves_nothing_in_the_cycle(offset, cycles, period):
    times = np.linspace(0.0, 3.0, 61) * period
    found = align(times + offset, offset, period, cycles)
    assert_array_equal(found.states, np.arange(40, 61))
    assert_allclose(found.cycle_times, np.linspace(0.0, 1.0, 21) * period, atol=1e-9)
    assert_allclose(found.rom_times - found.cycle_times, (cycles - 1) * period, atol=1e-9)
    assert found.cycles_later == cycles - 3


@given(st.integers(1, 4), st.integers(2, 6))
def test_whole_cycles_are_the_only_shift(reference_cycles, rom_cycles):
    times = np.linspace(0.0, reference_cycles, 20 * reference_cycles + 1) * PERIOD
    found = align(times, 0.0, PERIOD, rom_cycles)
    assert_allclose(times[found.states] + found.cycles_later * PERIOD, found.rom_times, atol=1e-12)
    assert found.cycles_later == rom_cycles - reference_cycles


def test_single_precision_times_miss_no_end_of_the_cycle():
    offset = 0.199333
    times = (offset + PERIOD * np.linspace(1.0, 2.0, 41)).astype(np.float32).astype(float)
    found = align(times, offset, PERIOD, 2)
    assert len(found.states) == 41
    assert found.cycle_times.min() >= 0.0
    assert_allclose(found.cycle_times, np.linspace(0, 1, 41) * PERIOD, atol=1e-6)


def test_a_run_cut_in_its_second_cycle_gives_its_whole_first():
    found = align(np.arange(0.0, 1.45, 0.1) * PERIOD, 0.0, PERIOD, 2)
    assert_array_equal(found.states, np.arange(0, 11))
    assert found.coverage == pytest.approx(1.0)
    assert found.cycles_later == 1


def test_without_a_whole_cycle_the_one_covered_best_is_used():
    found = align(np.arange(0.3, 1.65, 0.1) * PERIOD, 0.0, PERIOD, 2)
    assert_array_equal(found.states, np.arange(0, 8))
    assert found.coverage == pytest.approx(0.7)


def test_times_that_are_not_finite_are_refused():
    with pytest.raises(UnusableReferenceError, match="not finite"):
        align(np.array([0.0, np.nan, 0.5, 0.8]), 0.0, PERIOD, 1)


def test_states_in_any_order_come_out_in_time():
    times = np.array([0.5, 0.1, 0.9, 0.3, 0.7]) * PERIOD
    found = align(times, 0.0, PERIOD, 1)
    assert_array_equal(found.states, [1, 3, 0, 4, 2])
    assert np.all(np.diff(found.cycle_times) > 0)


def test_repeated_instants_count_once():
    found = align(np.array([0.1, 0.1, 0.4, 0.4, 0.4, 0.8]) * PERIOD, 0.0, PERIOD, 1)
    assert_array_equal(found.states, [1, 4, 5])


def test_states_before_the_offset_belong_to_no_cycle_of_the_last():
    found = align(np.array([-0.5, -0.2, 0.2, 0.6, 1.0]) * PERIOD, 0.0, PERIOD, 1)
    assert_array_equal(found.states, [2, 3, 4])


@pytest.mark.parametrize(
    "times",
    [
        [],
        [0.1],
        [0.1, 0.5],
        [0.1, 0.5, 0.5],
        [0.2, 0.4, 1.5, 1.7],
    ],
)
def test_fewer_than_three_instants_are_refused(times):
    with pytest.raises(UnusableReferenceError, match=r"^states in the last cycle: [012], allowed: 3 or more"):
        align(np.array(times) * PERIOD, 0.0, PERIOD, 2)
