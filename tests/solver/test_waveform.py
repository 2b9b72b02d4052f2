"""Waveforms: PCHIP or a spline, periodic."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import PchipInterpolator
from thesis_artery import DIASTOLE, thesis_waveform

from solver.errors import ModelError
from solver.model.waveform import Waveform, constant, local_minima

speeds = st.integers(-10_000, 10_000).map(lambda tenths_of_a_millimetre: tenths_of_a_millimetre / 10_000)


@st.composite
def waveforms(draw):
    steps = draw(st.lists(st.floats(0.01, 1.0), min_size=2, max_size=12))
    inner = draw(st.lists(speeds, min_size=len(steps) - 1, max_size=len(steps) - 1))
    first = draw(speeds)
    return Waveform(np.concatenate(([0.0], np.cumsum(steps))), np.array([first, *inner, first]))


@given(waveforms())
def test_through_its_points(waveform):
    np.testing.assert_allclose(waveform(waveform.times), waveform.values, atol=1e-12)
    assert waveform.period == waveform.times[-1]


@given(waveforms(), st.lists(st.floats(0, 1), min_size=1, max_size=20))
def test_scipys_interpolant_to_the_bit(waveform, phases):
    times = np.concatenate([waveform.times[:-1], np.array(phases) * waveform.period % waveform.period])
    exact = PchipInterpolator(waveform.times, waveform.values)(times)
    np.testing.assert_array_equal(waveform(times), exact)


@pytest.mark.parametrize("values", [[0.1, 0.1], [0.1, 0.3, 0.1], [0.1, -0.2, 0.4, 0.4, 0.1]])
def test_scipys_interpolant_of_few_points(values):
    waveform = Waveform(np.linspace(0.0, 0.8, len(values)), np.array(values))
    times = np.linspace(0.0, 0.79, 80)
    exact = PchipInterpolator(waveform.times, waveform.values)(times)
    np.testing.assert_array_equal(waveform(times), exact)


@given(waveforms(), st.floats(0, 1), st.integers(-3, 5))
def test_periodic(waveform, phase, cycles):
    time = phase * waveform.period
    steepest = 4 * np.max(np.abs(np.diff(waveform.values) / np.diff(waveform.times)))
    rounding = steepest * 1e-14 * waveform.period * (1 + abs(cycles))
    again = waveform(time + cycles * waveform.period)
    assert again == pytest.approx(waveform(time), abs=1e-12 + rounding)


@given(waveforms())
def test_monotone_between_points(waveform):
    for begin, end in zip(waveform.times[:-1], waveform.times[1:], strict=True):
        inside = waveform(np.linspace(begin, end, 50, endpoint=False))
        rise = np.diff(inside)
        assert np.all(rise >= -1e-12) or np.all(rise <= 1e-12)


def test_a_spline_follows_a_smooth_curve_at_fourth_order():
    def off(count, spline):
        times, fine = np.linspace(0, 0.8, count + 1), np.linspace(-0.8, 1.6, 999)
        curve = Waveform(times, np.sin(2 * np.pi * times / 0.8), spline)
        return np.abs(curve(fine) - np.sin(2 * np.pi * fine / 0.8)).max()

    assert off(20, True) / off(40, True) == pytest.approx(16, rel=0.05)
    assert off(40, False) > 100 * off(40, True)


@given(waveforms())
def test_a_spline_goes_through_its_points_with_one_slope_where_cycles_meet(waveform):
    curve = Waveform(waveform.times, waveform.values, spline=True)
    np.testing.assert_allclose(curve(waveform.times), waveform.values, atol=1e-12)
    step = 1e-6 * np.diff(waveform.times).min()
    before, at, after = curve(np.array([-step, 0.0, step]))
    steepest = np.abs(np.diff(waveform.values) / np.diff(waveform.times)).max()
    assert abs(after - 2 * at + before) <= 1e-3 * step * max(steepest, 1e-6) + 1e-15


def test_shape_of_the_answer():
    waveform = thesis_waveform()
    assert waveform(0.1).shape == ()
    assert waveform(np.zeros((2, 3))).shape == (2, 3)


def test_constant():
    np.testing.assert_array_equal(constant(0.2, 0.8)(np.linspace(-1, 5, 50)), 0.2)


def test_the_thesis_inlet():
    waveform = thesis_waveform()
    assert waveform(0.0) == pytest.approx(DIASTOLE, rel=1e-12)
    assert waveform.period == pytest.approx(2.392 / 3, rel=1e-5)
    minima = local_minima(waveform)
    np.testing.assert_allclose(minima, [0.169, 0.2825, 0.74], atol=5e-4)
    assert waveform(minima[1]) < waveform(minima[0])


@given(st.integers(1, 4), st.floats(0, 0.1))
def test_minima_of_a_wave_with_known_ones(count, floor):
    """A cosine with ``count`` periods a cycle has its minima half way; the first crest is at 0."""
    times = np.linspace(0, 1, 40 * count + 1)
    values = np.cos(2 * np.pi * count * times) - floor * times * (1 - times)
    minima = local_minima(Waveform(times, values))
    np.testing.assert_allclose(minima, (np.arange(count) + 0.5) / count, atol=0.5 / count / 20)


@pytest.mark.parametrize(
    ("times", "values", "message"),
    [
        ([0.0], [1.0], "two or more times"),
        ([0.1, 1.0], [1.0, 1.0], "start at 0"),
        ([0.0, 0.5, 0.5, 1.0], [1.0, 2.0, 1.0, 1.0], "increase"),
        ([0.0, np.nan, 1.0], [1.0, 2.0, 1.0], "increase"),
        ([0.0, 0.5, 1.0], [1.0, np.nan, 1.0], "finite"),
        ([0.0, 0.5, 1.0], [1.0, np.inf, 1.0], "finite"),
    ],
)
def test_unusable_waveforms_are_refused(times, values, message):
    with pytest.raises(ModelError, match=message):
        Waveform(np.array(times), np.array(values))
