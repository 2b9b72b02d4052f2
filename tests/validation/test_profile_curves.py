"""error(γ): its least value is the closest profile's, and its rows are the curve at the models' own γ."""

from dataclasses import replace

import numpy as np
import pytest
from closest import closest_profile
from comparisons import CELLS, PERIOD, TIMES, two_models
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from validation.mapping.profiles import errors_at
from validation.metrics.profile_curves import EXPONENTS, error_curves, profile_rows

Y = np.linspace(0.0, 1.0, 25)
ABOUT = {"compare_i": CELLS[0], "compare_j": CELLS[1], "compare_times_s": TIMES}


def family(gamma):
    return (gamma + 2) / gamma * (1 - Y**gamma)


@given(st.floats(0.3, 50.0), st.floats(0.3, 50.0))
def test_error_of_one_profile_against_another(gamma, other):
    v, s = 0.2 * family(gamma), family(other)
    u = (v @ s) / (s @ s)
    expected = np.linalg.norm(v - u * s) / np.linalg.norm(v)
    assert_allclose(errors_at(v[None], Y, np.array([[other]])), expected, atol=1e-12)


@given(st.lists(st.floats(0.05, 1.0), min_size=24, max_size=24))
def test_the_closest_profile_is_the_curves_lowest_point(values):
    v = np.append(values, 0.0)[None]
    best = closest_profile(v, Y)
    curve = errors_at(v, Y, EXPONENTS[None])
    assert curve.min() >= best.error[0] - 1e-12
    assert_allclose(errors_at(v, Y, best.exponent[:, None]), best.error[:, None], atol=1e-12)


def test_no_flow_has_no_error():
    assert np.all(np.isnan(errors_at(np.zeros((1, 25)), Y, EXPONENTS[None])))


@pytest.fixture
def models():
    """Two models whose velocity profiles belong to the family of profiles."""
    found = two_models()
    gamma = found.reference["profile_exponent"]
    y = found.reference["y"]
    profile = 0.2 * (1 - y**gamma)
    axial = profile.transpose("time", "x", "phi", "y")
    error = found.reference["profile_error"] * 0.0
    return replace(found, reference=found.reference.assign(axial_velocity=axial, profile_error=error))


def test_curves_stand_at_the_tabulated_cells(models):
    curves = error_curves(models, ABOUT)
    assert curves.dims == ("compare_time", "compare_x", "compare_phi", "exponent")
    assert curves.shape == (2, 3, 2, EXPONENTS.size)
    lowest = EXPONENTS[np.argmin(curves.to_numpy(), axis=-1)]
    own = models.reference["profile_exponent"].to_numpy()
    for place in np.ndindex(2, 3, 2):
        n = round(TIMES[place[0]] / PERIOD * 20)
        expected = own[n, CELLS[0][place[1]] - 1, CELLS[1][place[2]] - 1]
        assert lowest[place] == pytest.approx(expected, rel=0.03)


def test_rows_hold_the_error_with_either_models_exponent(models):
    found = list(profile_rows(models, ABOUT))
    assert len(found) == 12
    for row in found:
        n = round(row.t_s / PERIOD * 20)
        at = (n, row.i - 1, row.j - 1)
        y = models.reference["y"].to_numpy()
        v = models.reference["axial_velocity"].to_numpy()[at]
        gamma = models.rom["profile_exponent"].to_numpy()[at]
        assert row.reference == 0.0
        assert row.rom == pytest.approx(errors_at(v[None], y, np.array([[gamma]]))[0, 0], abs=1e-12)


def test_a_reference_without_profiles_has_no_rows(models):
    nothing = models.reference["axial_velocity"] * np.nan
    bare = replace(models, reference=models.reference.assign(axial_velocity=nothing))
    assert list(profile_rows(bare, ABOUT)) == []
    assert np.all(np.isnan(error_curves(bare, ABOUT)))


def test_what_the_mesh_does_between_nodes_is_no_error(models):
    """Profiles known at nodes only are told from what a mesh makes of them, and the curve says the same."""
    nodes = np.array([0.0, 0.4, 1.0])
    y = models.reference["y"].to_numpy()
    k = np.clip(np.searchsorted(nodes, y, side="right") - 1, 0, 1)
    weight = (y - nodes[k]) / (nodes[k + 1] - nodes[k])
    gamma = models.reference["profile_exponent"]
    at_nodes = gamma.to_numpy()[..., None]
    axial = 0.2 * (1 - (1 - weight) * nodes[k] ** at_nodes - weight * nodes[k + 1] ** at_nodes)
    rings = np.stack([nodes[k], nodes[k + 1], weight], axis=-1)
    shape = (gamma.sizes["time"], len(CELLS[0]), len(CELLS[1]), *rings.shape)
    fields = models.reference.assign(
        axial_velocity=(("time", "x", "phi", "y"), axial),
        node_rings=(("time", "compare_x", "compare_phi", "y", "ring"), np.broadcast_to(rings, shape)),
    )
    same = replace(models, reference=fields, rom=models.rom.assign(profile_exponent=gamma))
    without = replace(same, reference=fields.drop_vars("node_rings"))
    assert max(row.rom for row in profile_rows(same, ABOUT)) < 1e-12
    assert max(row.rom for row in profile_rows(without, ABOUT)) > 1e-3
    lowest = EXPONENTS[np.argmin(error_curves(same, ABOUT).to_numpy(), axis=-1)]
    cells = {"x": np.array(CELLS[0]) - 1, "phi": np.array(CELLS[1]) - 1}
    assert_allclose(lowest, gamma.sel(time=TIMES, method="nearest").isel(cells), rtol=0.03)
