"""Bands: declared limits, judged OK, FAIL or MISSING."""

from dataclasses import replace
from types import SimpleNamespace
from typing import get_args

import numpy as np
import pytest
from comparisons import equal_models, two_models
from hypothesis import given
from hypothesis import strategies as st

from cases.sections.compare import RELATIVE_STATISTICS, Band, ComparedQuantity
from validation.metrics.bands import band_rows, judged_value
from validation.metrics.cycle_quantities import CYCLE_QUANTITIES

DIFFERENCES = ("rms_difference", "max_difference")


def band(quantity="radius", statistic="rms_error", limit="2 %", **more):
    return Band.model_validate(
        {"quantity": quantity, "statistic": statistic, "limit": limit, "reason": "stated", **more}
    )


def rows(models, *bands):
    return list(band_rows(models, SimpleNamespace(compare=SimpleNamespace(bands=bands))))


def scaled(models, quantity, factor):
    """The reference's quantity times a factor."""
    changed = models.reference.assign({quantity: models.reference[quantity] * factor})
    return replace(models, reference=changed)


@pytest.mark.parametrize("quantity", get_args(ComparedQuantity))
@pytest.mark.parametrize("statistic", [*RELATIVE_STATISTICS, *DIFFERENCES])
def test_every_band_that_can_be_declared_can_be_judged(quantity, statistic):
    models = two_models()
    value = judged_value(models, SimpleNamespace(quantity=quantity, statistic=statistic))
    assert value is not None
    assert np.isfinite(value)
    assert value != 0.0 or (statistic == "scatter" and quantity in CYCLE_QUANTITIES)


@given(st.floats(0.5, 2.0), st.floats(1e-3, 0.5))
def test_a_band_holds_exactly_where_the_error_keeps_the_limit(factor, limit):
    models = scaled(equal_models(), "radius", factor)
    (row,) = rows(models, band(statistic="max_error", limit=limit))
    assert row.error == pytest.approx(1 / factor - 1, abs=1e-12)
    assert row.status == ("OK" if abs(row.error) <= limit else "FAIL")
    assert row.band == limit


@pytest.mark.parametrize(("factor", "status"), [(1.03, "OK"), (0.97, "FAIL"), (1 / 1.04, "FAIL")])
def test_errors_of_either_sign_break_a_band(factor, status):
    (row,) = rows(scaled(equal_models(), "pressure", factor), band("pressure", "bias", "3 %"))
    assert row.status == status


def test_a_quantity_that_was_not_computed_is_missing():
    models = two_models()
    absent = replace(models, reference=models.reference.drop_vars("mean_velocity"))
    (row,) = rows(absent, band("mean_velocity"))
    assert (row.status, row.error, row.band) == ("MISSING", None, 0.02)


@pytest.mark.parametrize("value", [np.inf, np.nan])
@pytest.mark.parametrize("statistic", ["rms_error", "max_difference"])
def test_a_quantity_without_a_finite_value_is_missing(statistic, value):
    models = two_models()
    exponent = models.reference["profile_exponent"].copy()
    exponent[3, 2, 1] = value
    models = replace(models, reference=models.reference.assign(profile_exponent=exponent))
    (row,) = rows(models, band("profile_exponent", statistic, "100 %" if statistic == "rms_error" else 5))
    assert (row.status, row.error) == ("MISSING", None)


def test_the_wall_where_both_velocities_are_zero_is_not_judged():
    models = equal_models()
    at_rest = models.rom["axial_velocity"].copy()
    at_rest[..., -1] = 0.0
    models = replace(
        models,
        rom=models.rom.assign(axial_velocity=at_rest),
        reference=models.rom.assign(axial_velocity=at_rest),
    )
    (row,) = rows(models, band("axial_velocity", "rms_error", "1 %"))
    assert (row.status, row.error) == ("OK", 0.0)


def test_absolute_limits_are_in_the_unit_of_the_quantity():
    models = two_models()
    worst = np.abs(models.rom["radius"] - models.reference["radius"]).max().item()
    above, below = (f"{factor * worst * 1e6:.6f} um" for factor in (1.01, 0.99))
    first, second = rows(
        models, band(statistic="max_difference", limit=above), band(statistic="max_difference", limit=below)
    )
    assert (first.unit, first.status, second.status) == ("m", "OK", "FAIL")
    assert abs(first.error) == pytest.approx(worst)


def test_bands_for_other_variants_are_not_judged():
    elsewhere, here = band(variants=["local"]), band(variants=["none", "local"])
    assert [row.band for row in rows(two_models("none"), elsewhere, here)] == [0.02]
    assert len(rows(two_models("local"), elsewhere, here)) == 2


@given(st.floats(1e-3, 1e3))
def test_no_limit_depends_on_what_it_judges(factor):
    declared = (band(limit="2 %"), band("largest_radius", "bias", "1 %"), band("pressure", "scatter", "3 %"))
    found = rows(scaled(two_models(), "radius", factor), *declared)
    assert [row.band for row in found] == [0.02, 0.01, 0.03]
    assert len(found) == len(declared)


@pytest.mark.parametrize("quantity", ["pressure", "radius", "section_flow_rate", "axial_velocity"])
def test_a_false_reference_fails_the_bands_of_its_quantity_only(quantity):
    names = ("pressure", "radius", "section_flow_rate", "axial_velocity")
    declared = [band(name, "rms_error", "3 %") for name in names]
    assert {row.status for row in rows(equal_models(), *declared)} == {"OK"}
    found = rows(scaled(equal_models(), quantity, 1.05), *declared)
    assert {row.quantity: row.status for row in found} == {
        name: "FAIL" if name == quantity else "OK" for name in names
    }
