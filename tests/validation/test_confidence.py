"""Confidence of the bias: what the bootstrap's interval promises, and the rows that carry it."""

from dataclasses import replace

import numpy as np
import pytest
from comparisons import N_T, equal_models, two_models
from hypothesis import given
from hypothesis import strategies as st

from validation.metrics.confidence import block_length, confidence_rows, mean_interval


def red_noise(rng, n, memory):
    """Series in which neighbours are alike, of mean 0."""
    series = np.empty(n)
    series[0] = rng.normal()
    for k in range(1, n):
        series[k] = memory * series[k - 1] + np.sqrt(1 - memory**2) * rng.normal()
    return series


@pytest.mark.parametrize(("memory", "least"), [(0.0, 0.88), (0.6, 0.80)])
def test_the_interval_holds_the_mean_about_as_often_as_it_says(memory, least):
    rng = np.random.default_rng(7)
    intervals = [mean_interval(red_noise(rng, 120, memory)) for _ in range(150)]
    held = np.mean([low <= 0.0 <= high for low, high in intervals])
    assert least <= held <= 1.0


def test_blocks_make_the_interval_of_a_smooth_cycle_wider():
    smooth = np.sin(np.linspace(0, 2 * np.pi, 40, endpoint=False))
    shuffled = np.random.default_rng(3).permutation(smooth)
    width = [high - low for low, high in (mean_interval(smooth), mean_interval(shuffled))]
    assert block_length(smooth) > 5 * block_length(shuffled)
    assert width[0] > 1.5 * width[1]


@given(st.floats(-1.0, 1.0), st.integers(3, 60))
def test_a_constant_error_is_certain(value, n):
    assert mean_interval(np.full(n, value)) == pytest.approx((value, value), abs=1e-15)
    assert block_length(np.full(n, value)) == 1


@given(st.lists(st.floats(-1.0, 1.0), min_size=3, max_size=41).map(np.array))
def test_the_interval_lies_within_the_series_and_is_the_same_again(series):
    low, high = mean_interval(series)
    assert series.min() - 1e-12 <= low <= high <= series.max() + 1e-12
    assert mean_interval(series) == (low, high)


def rows(models):
    return {(row.quantity, row.statistic): row for row in confidence_rows(models)}


def test_the_bias_lies_between_its_limits():
    found = rows(two_models())
    rom, reference = two_models().pair("radius")
    bias = np.mean((rom - reference)[:-1] / reference[:-1])
    assert found["radius", "bias_low"].error < bias < found["radius", "bias_high"].error


def test_the_end_of_the_cycle_counts_once():
    models = equal_models()
    radius = models.reference["radius"].copy()
    radius[N_T - 1] /= 1.5
    found = rows(replace(models, reference=models.reference.assign(radius=radius)))
    assert found["radius", "bias_high"].error == pytest.approx(0.0, abs=1e-15)


def test_the_worst_cell_is_found():
    models = equal_models()
    pressure = models.reference["pressure"].copy()
    pressure[:, 4, 2] /= 1.1
    row = rows(replace(models, reference=models.reference.assign(pressure=pressure)))[
        "pressure", "worst_cell"
    ]
    assert (row.i, row.j, row.error) == (5, 3, pytest.approx(0.1))


def test_without_a_meaningful_error_there_is_no_interval():
    models = equal_models()
    plug = models.reference["profile_exponent"].copy()
    plug[3, 2, 1] = np.inf
    found = rows(replace(models, reference=models.reference.assign(profile_exponent=plug)))
    assert found["profile_exponent", "bias_low"].error is None
    assert ("profile_exponent", "worst_cell") not in found
