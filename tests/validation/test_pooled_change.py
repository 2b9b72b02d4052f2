"""What calcification changes over all cells, and the assumptions' rows."""

from dataclasses import replace

import numpy as np
import pytest
from comparisons import CELLS, PERIOD, TIMES, equal_models, two_models

from validation.metrics.assumptions import assumption_rows
from validation.metrics.pooled_change import pooled_change_rows, without_rays

ABOUT = {"compare_i": CELLS[0], "compare_j": CELLS[1], "compare_times_s": TIMES}
BASELINES = {"none": "none", "local": "none"}


def changed(models, rom=1.0, reference=1.0, quantity="radius"):
    """The models of another variant: a field of each multiplied by a factor."""
    return replace(
        models,
        variant="local",
        rom=models.rom.assign({quantity: models.rom[quantity] * rom}),
        reference=models.reference.assign({quantity: models.reference[quantity] * reference}),
    )


def rows(healthy, calcified):
    compared = {("none", "rom"): without_rays(healthy), ("local", "rom"): without_rays(calcified)}
    return {row.quantity: row for row in pooled_change_rows(compared, BASELINES)}


def test_equal_changes_have_no_error():
    row = rows(equal_models(), changed(equal_models(), 0.9, 0.9))["radius"]
    size = 0.1 * np.sqrt(np.mean(equal_models().rom["radius"].to_numpy() ** 2))
    assert (row.rom, row.reference, row.error) == pytest.approx((size, size, 0.0))
    assert (row.variant, row.statistic, row.unit) == ("local", "change_rms", "m")


def test_a_change_half_as_large_is_half_wrong():
    row = rows(equal_models(), changed(equal_models(), 0.95, 0.9))["radius"]
    assert row.error == pytest.approx(0.5)
    assert row.rom == pytest.approx(0.5 * row.reference)


def test_only_the_changed_quantity_changes():
    found = rows(equal_models(), changed(equal_models(), 0.95, 0.9))
    assert {name for name, row in found.items() if row.reference} == {"radius"}
    assert all(row.error is None for name, row in found.items() if name != "radius")


def test_plug_flow_has_no_change():
    models = equal_models()
    plug = models.reference["profile_exponent"].copy()
    plug[0, 0, 0] = np.inf
    calcified = replace(models, variant="local", reference=models.reference.assign(profile_exponent=plug))
    row = rows(models, calcified)["profile_exponent"]
    assert (row.rom, row.reference, row.error) == (None, None, None)


def test_a_baseline_has_no_change():
    models = without_rays(equal_models())
    assert list(pooled_change_rows({("none", "rom"): models}, BASELINES)) == []
    assert list(pooled_change_rows({("local", "rom"): models}, BASELINES)) == []


def test_a_model_changes_from_its_own_baseline():
    stiff = replace(changed(equal_models(), 0.5, 0.9), model="stiff")
    compared = {(each.variant, each.model): without_rays(each) for each in (equal_models(), stiff)}
    assert list(pooled_change_rows(compared, BASELINES)) == []
    own = replace(changed(equal_models(), 0.9, 0.9), variant="none", model="stiff")
    compared["none", "stiff"] = without_rays(own)
    (row,) = (row for row in pooled_change_rows(compared, BASELINES) if row.quantity == "radius")
    size = np.sqrt(np.mean(equal_models().rom["radius"].to_numpy() ** 2))
    assert (row.model, row.rom, row.reference) == ("stiff", pytest.approx(0.4 * size), 0.0)


def test_assumptions_are_tabulated_where_results_are():
    models = two_models()
    found = list(assumption_rows(models, ABOUT))
    counts = {
        name: sum(row.quantity == name and row.statistic == "value" for row in found)
        for name in ("axis_velocity_spread", "section_pressure_range", "mass_defect", "backflow_fraction")
    }
    assert list(counts.values()) == [6, 6, 2, 2]
    for row in found:
        if row.statistic == "value":
            n = round(row.t_s / PERIOD * 20)
            at = (n,) if row.i is None else (n, row.i - 1)
            assert row.reference == models.reference[row.quantity].to_numpy()[at]
            assert row.rom == models.rom[row.quantity].to_numpy()[at]


def test_pressure_within_a_section_is_compared_with_the_pulse():
    models = two_models()
    row = next(row for row in assumption_rows(models, ABOUT) if row.statistic == "over_pulse")
    pressure = models.reference["section_pressure"]
    pulse = float(pressure.max() - pressure.min())
    assert row.reference == pytest.approx(float(models.reference["section_pressure_range"].max()) / pulse)
    assert row.unit == "1"
