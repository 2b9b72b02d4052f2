"""Fourier series, ramps and constants over time."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from solver.errors import ModelError
from solver.model.waveform import FourierSeries, Ramped, Scaled, Waveform, constant, load_curve, local_minima

COEFFICIENTS = st.lists(st.tuples(st.floats(-2, 2), st.floats(-2, 2)), max_size=6)


@given(st.floats(0.1, 3.0), st.floats(-5, 5), COEFFICIENTS, st.floats(-10, 10))
def test_a_series_is_its_sum(period, mean, pairs, time):
    series = FourierSeries(period, mean, tuple(a for a, _ in pairs), tuple(b for _, b in pairs))
    total = mean
    for k, (a, b) in enumerate(pairs, start=1):
        total += a * np.cos(2 * np.pi * k * time / period) + b * np.sin(2 * np.pi * k * time / period)
    assert series(time) == pytest.approx(total, abs=1e-9)
    assert series(time + period) == pytest.approx(total, abs=1e-9)


def test_a_series_keeps_the_shape_of_time_and_its_mean():
    series = FourierSeries(0.8, 3.0, (1.0, 0.5), (0.2, -0.4))
    times = np.arange(64).reshape(8, 8) / 64 * 0.8
    assert series(times).shape == (8, 8)
    assert series(times).mean() == pytest.approx(3.0, rel=1e-13)
    assert series(0.1).shape == ()
    assert FourierSeries(0.8, 3.0, (), ())(np.zeros(3)).tolist() == [3.0, 3.0, 3.0]


@pytest.mark.parametrize(
    "values",
    [
        (0.0, 1.0, (), ()),
        (np.nan, 1.0, (), ()),
        (1.0, np.inf, (), ()),
        (1.0, 1.0, (1.0,), ()),
        (1.0, 1.0, (1.0,), (np.nan,)),
    ],
)
def test_series_that_are_refused(values):
    with pytest.raises(ModelError):
        FourierSeries(*values)


def test_troughs_of_a_series():
    assert local_minima(FourierSeries(1.0, 0.0, (1.0,), (0.0,))) == pytest.approx([0.5], abs=1e-3)


@given(st.floats(-1, 2), st.floats(0.1, 1.0), st.floats(-3, 3), st.floats(-3, 3))
def test_the_load_curve(time, duration, low, high):
    """l(t) = y₀ + (y₁ − y₀)(½ − ½ cos π(t − t₀)/(t₁ − t₀)) between, constant outside."""
    value = float(load_curve(time, 0.2, 0.2 + duration, low, high))
    if time <= 0.2:
        assert value == low
    elif time >= 0.2 + duration:
        assert value == pytest.approx(high, abs=1e-12)
    else:
        share = 0.5 - 0.5 * np.cos(np.pi * (time - 0.2) / duration)
        assert value == pytest.approx(low + (high - low) * share, abs=1e-12)


def test_a_ramp_leads_from_zero_to_the_signal_once():
    signal = Waveform(np.array([0.0, 0.3, 1.0]), np.array([1.0, 2.0, 1.0]))
    ramped = Ramped(signal, 0.4)
    assert ramped(0.0) == 0.0
    assert ramped(0.2) == pytest.approx(0.5 * signal(0.2))
    later = np.linspace(0.4, 3.0, 50)
    np.testing.assert_array_equal(ramped(later), signal(later))
    assert ramped.period == 1.0


@pytest.mark.parametrize("duration", [0.0, -1.0, np.nan, np.inf])
def test_ramps_that_are_refused(duration):
    with pytest.raises(ModelError, match="ramp = "):
        Ramped(constant(1.0, 1.0), duration)


def test_a_scaled_signal_is_the_signal_times_its_factor():
    signal = Waveform(np.array([0.0, 0.3, 1.0]), np.array([1.0, 2.0, 1.0]))
    times = np.linspace(0.0, 3.0, 31)
    np.testing.assert_array_equal(Scaled(signal, 1.25)(times), 1.25 * signal(times))
    assert Scaled(signal, 1.25).period == 1.0


@pytest.mark.parametrize("factor", [0.0, -1.0, np.nan, np.inf])
def test_factors_that_are_refused(factor):
    with pytest.raises(ModelError, match="scale = "):
        Scaled(constant(1.0, 1.0), factor)
