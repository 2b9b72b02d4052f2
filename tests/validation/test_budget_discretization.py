"""Orders and uncertainties from levels of numbers whose error is known."""

import numpy as np
import pytest

from validation.compare.budget.discretization import (
    SURE,
    UNSURE,
    Estimate,
    observed_order,
    of_finest_level,
    of_middle_level,
    trusted,
)
from validation.compare.budget.levels import Level, mesh_estimates, refined_enough, refinement_told
from validation.mapping.derived import as_dataset
from validation.mapping.rays import rays
from validation.metrics.statistics import rms

PERIOD = 0.8
SHAPE = np.sin(np.linspace(0.0, 3.0, 7))[:, None, None] + np.linspace(1.0, 2.0, 6)[:, None] + np.ones(4)
FIELDS = ("pressure", "radius", "mean_velocity", "sector_flow_rate", "profile_exponent")
SECTIONS = ("section_flow_rate", "section_pressure")


def fields(relative_error):
    """A model that is off by a relative error that differs from cell to cell."""
    values = dict.fromkeys(FIELDS, SHAPE * (1.0 + relative_error * SHAPE))
    values |= dict.fromkeys(SECTIONS, values["pressure"][..., 0])
    points = rays((np.arange(6) + 0.5) / 6, (np.arange(4) + 0.5) * np.pi / 2)
    return as_dataset(values, points, np.linspace(0.0, PERIOD, 7))


def mesh(elements, constant, order):
    """A tube on a mesh whose error of the given order is known."""
    return Level(elements, fields(0.0), fields(constant * elements ** (-order / 3.0)))


@pytest.mark.parametrize("order", [0.8, 1.0, 1.5, 2.0])
@pytest.mark.parametrize("ratios", [(2.0, 2.0), (1.3, 1.6), (1.6, 1.3)])
def test_three_levels_observe_the_order(order, ratios):
    sizes = np.array([ratios[0] * ratios[1], ratios[1], 1.0])
    coarse, fine = -np.diff(0.01 * sizes**order)
    assert observed_order(coarse, fine, *ratios) == pytest.approx(order, rel=1e-6)


def test_changes_that_grow_have_no_order():
    assert observed_order(1.0, 2.0, 2.0, 2.0) is None
    assert observed_order(1.0, 0.0, 2.0, 2.0) is None
    assert trusted(None, 1.0) == (0.5, UNSURE)


def test_the_factor_of_safety_follows_the_order():
    assert trusted(1.95, 2.0) == (1.95, SURE)
    assert trusted(2.1, 2.0) == (2.0, SURE)
    assert trusted(1.5, 2.0) == (1.5, UNSURE)
    assert trusted(1.5, 1.0) == (1.5, SURE)
    assert trusted(3.0, 1.0) == (2.0, UNSURE)
    assert trusted(0.2, 1.0) == (0.5, UNSURE)


def test_the_middle_of_three_grids_has_its_own_error():
    error = 0.004
    found = of_middle_level(error * (4.0 - 1.0), error * (1.0 - 0.25))
    assert found.observed == pytest.approx(2.0)
    assert found.uncertainty == pytest.approx(SURE * error, rel=1e-6)
    assert of_middle_level(0.0, 1e-16).uncertainty == 0.0


def test_two_meshes_of_a_known_order_give_its_index():
    found = mesh_estimates([mesh(2688, 0.2, 2.0), mesh(7920, 0.2, 2.0)], PERIOD)
    true = rms(0.2 * 7920 ** (-2.0 / 3.0) * SHAPE)
    pressure = found["pressure"]
    assert pressure.uncertainty == pytest.approx(UNSURE * true, rel=0.05)
    assert (pressure.observed, pressure.order, pressure.safety) == (None, 2.0, UNSURE)
    assert pressure.extrapolated < 0.05 * true
    assert "no order can be observed" in refinement_told([2688, 7920], found)


def test_three_meshes_observe_the_order_and_are_trusted():
    levels = [mesh(n, 0.2, 2.0) for n in (1000, 2688, 7920)]
    found = mesh_estimates(levels, PERIOD)
    true = rms(0.2 * 7920 ** (-2.0 / 3.0) * SHAPE)
    for quantity in ("pressure", "radius", "section_flow_rate"):
        assert found[quantity].observed == pytest.approx(2.0, rel=0.05)
        assert found[quantity].safety == SURE
    assert found["radius"].uncertainty == pytest.approx(SURE * true, rel=0.05)
    assert refined_enough(levels)
    assert not refined_enough(levels[::-1])


def test_meshes_that_agree_leave_nothing_open():
    assert of_finest_level([0.0], [1.5]) == Estimate(0.0, None, 2.0, SURE)
