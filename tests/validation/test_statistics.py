"""Statistics against plain arithmetic."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from validation.metrics.statistics import extreme_error, relative_error, statistic_value

REFERENCE = np.array([[2.0, 4.0], [-5.0, 8.0]])
ROM = np.array([[2.2, 3.0], [-5.0, 8.8]])
ERROR = np.array([[0.1, -0.25], [-0.0, 0.1]])

POSITIVE = arrays(float, (3, 4), elements=st.floats(0.5, 2.0))


@pytest.mark.parametrize(
    ("statistic", "value"),
    [
        ("rms_error", np.sqrt((0.01 + 0.0625 + 0.01) / 4)),
        ("max_error", -0.25),
        ("bias", -0.05 / 4),
        ("scatter", np.sqrt((0.01 + 0.0625 + 0.01) / 4 - (0.05 / 4) ** 2)),
        ("rms_difference", np.sqrt((0.04 + 1.0 + 0.64) / 4)),
        ("max_difference", -1.0),
        ("systolic_error", 0.1),
        ("diastolic_error", 0.0),
    ],
)
def test_values_worked_out_by_hand(statistic, value):
    assert statistic_value(statistic, ROM, REFERENCE) == pytest.approx(value, rel=1e-12, abs=1e-15)


def test_relative_error_is_signed_and_relative_to_the_reference():
    np.testing.assert_allclose(relative_error(ROM, REFERENCE), ERROR, rtol=1e-12, atol=1e-15)


@given(POSITIVE, POSITIVE)
def test_extremes_are_each_models_own(rom, reference):
    assert extreme_error("systolic_error", rom, reference) == pytest.approx(
        rom.max() / reference.max() - 1, abs=1e-12
    )
    assert extreme_error("diastolic_error", rom, reference) == pytest.approx(
        rom.min() / reference.min() - 1, abs=1e-12
    )


@given(POSITIVE, POSITIVE)
def test_mean_square_is_bias_and_scatter(rom, reference):
    rms, bias, scatter = (statistic_value(name, rom, reference) for name in ("rms_error", "bias", "scatter"))
    assert rms**2 == pytest.approx(bias**2 + scatter**2, abs=1e-12)


@given(POSITIVE, st.floats(0.5, 1.5))
def test_a_factor_is_found(reference, factor):
    rom = factor * reference
    for statistic in ("max_error", "bias", "systolic_error", "diastolic_error"):
        assert statistic_value(statistic, rom, reference) == pytest.approx(factor - 1, abs=1e-12)
    assert statistic_value("rms_error", rom, reference) == pytest.approx(abs(factor - 1), abs=1e-12)
    assert statistic_value("scatter", rom, reference) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("value", [0.0, 1e-12, np.inf, np.nan])
@pytest.mark.parametrize("statistic", ["rms_error", "max_error", "bias", "scatter"])
def test_a_reference_without_meaning_gives_no_relative_error(value, statistic):
    reference = REFERENCE.copy()
    reference[0, 1] = value
    assert statistic_value(statistic, ROM, reference) is None


@pytest.mark.parametrize("statistic", ["rms_error", "bias", "rms_difference", "max_difference"])
@pytest.mark.parametrize("value", [np.inf, np.nan])
def test_a_model_without_a_finite_value_gives_no_error(value, statistic):
    rom = ROM.copy()
    rom[1, 0] = value
    assert statistic_value(statistic, rom, REFERENCE) is None


def test_differences_need_no_reference_other_than_zero():
    assert statistic_value("max_difference", ROM, np.zeros((2, 2))) == 8.8
    assert statistic_value("systolic_error", ROM, np.zeros((2, 2))) is None
