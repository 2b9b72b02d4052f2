"""The closest member of the profile family."""

import numpy as np
import pytest
from closest import closest_profile
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.optimize import minimize_scalar

Y = np.linspace(0.0, 1.0, 25)
EXPONENTS = st.floats(0.3, 50.0)
VELOCITIES = st.floats(1e-4, 10.0).flatmap(lambda u: st.sampled_from([u, -u]))
NOISE = st.lists(st.floats(-1.0, 1.0), min_size=Y.size, max_size=Y.size).map(np.array)


def family(gamma, y=Y):
    """s(y; γ) = (γ + 2)/γ (1 − y^γ)."""
    return (gamma + 2) / gamma * (1 - y**gamma)


def plug(y=Y):
    return (y < 1).astype(float)


def fit(profile, y=Y, weights=None):
    """u, γ and error of one profile."""
    closest = closest_profile(np.asarray(profile, dtype=float)[None, :], y, weights)
    return tuple(float(part[0]) for part in closest)


def error_of(profile, gamma, weights=1.0):
    """Relative error with the best u for a given γ."""
    shape = plug() if np.isinf(gamma) else family(gamma)
    u = np.sum(weights * profile * shape) / np.sum(weights * shape**2)
    return np.sqrt(np.sum(weights * (profile - u * shape) ** 2) / np.sum(weights * profile**2))


@given(VELOCITIES, EXPONENTS)
def test_recovers_velocity_and_exponent(u, gamma):
    found, exponent, error = fit(u * family(gamma))
    assert_allclose([found, exponent], [u, gamma], rtol=1e-6)
    assert error < 1e-6


@given(EXPONENTS, st.sampled_from([5, 9, 17, 101]))
def test_recovers_from_any_number_of_points(gamma, points):
    y = np.linspace(0.0, 1.0, points)
    # four points of five see no difference between blunt profiles
    gamma = min(gamma, 1.0 * points)
    assert_allclose(fit(0.1 * family(gamma, y), y)[:2], [0.1, gamma], rtol=1e-9)


@given(EXPONENTS)
def test_recovers_with_weights(gamma):
    assert_allclose(fit(0.2 * family(gamma), weights=Y)[:2], [0.2, gamma], rtol=1e-9)


def test_many_profiles_at_once_are_fitted_one_by_one():
    gamma = np.geomspace(0.3, 50, 45_001)
    u = np.linspace(-0.1, 0.3, gamma.size) + 1e-5
    found = closest_profile(u[:, None] * family(gamma[:, None], Y), Y)
    assert_allclose(found.exponent, gamma, rtol=1e-6)
    assert_allclose(found.velocity, u, rtol=1e-6)


def test_no_profiles_give_no_fits():
    assert [part.shape for part in closest_profile(np.empty((0, 25)), Y)] == [(0,)] * 3


@pytest.mark.parametrize("u", [0.1, -3.0])
def test_plug_flow_has_infinite_exponent(u):
    assert fit(u * plug()) == (pytest.approx(u, rel=1e-15), np.inf, pytest.approx(0.0, abs=1e-12))


def test_flow_faster_at_the_wall_than_on_the_axis_is_closest_to_plug_flow():
    found, exponent, error = fit(plug() * (1 + 0.5 * Y**4))
    assert exponent == np.inf
    assert 1 < found < 1.5
    assert 0 < error < 0.2


def test_nearly_plug_flow_keeps_a_finite_exponent():
    assert_allclose(fit(family(200.0))[1], 200.0, rtol=1e-2)


def test_rest():
    assert fit(np.zeros(25)) == (0.0, 2.0, 0.0)


def test_rest_among_moving_profiles():
    found = closest_profile(np.stack([family(3.0), np.zeros(25), -family(5.0)]), Y)
    assert_allclose(found.exponent, [3.0, 2.0, 5.0], rtol=1e-6)
    assert_allclose(found.velocity, [1.0, 0.0, -1.0], rtol=1e-6)


@given(NOISE, EXPONENTS, st.floats(1e-6, 1e6))
def test_scale_does_not_matter(noise, gamma, scale):
    profile = (family(gamma) + 0.2 * noise) * plug()
    u, exponent, error = fit(profile)
    scaled = fit(scale * profile)
    assert_allclose(scaled, (scale * u, exponent, error), rtol=1e-6, atol=1e-12)


@given(NOISE, EXPONENTS, st.sampled_from([None, "y"]))
@settings(max_examples=60)
def test_no_other_exponent_is_closer(noise, gamma, which):
    profile = (family(gamma) + 0.3 * noise) * plug()
    weights = None if which is None else Y
    w = 1.0 if which is None else Y
    _, exponent, error = fit(profile, weights=weights)
    assert error == pytest.approx(error_of(profile, exponent, w), rel=1e-9, abs=1e-12)
    others = np.append(np.geomspace(0.05, 900.0, 400), np.inf)
    best = min(error_of(profile, other, w) for other in others)
    assert error <= best + 1e-9
    if np.isfinite(exponent) and exponent > 0.0501:
        low, high = exponent / 1.05, exponent * 1.05
        scipy = minimize_scalar(
            lambda g: error_of(profile, g, w), bounds=(low, high), method="bounded", options={"xatol": 1e-10}
        )
        assert error <= scipy.fun + 1e-9


def test_weights_shift_the_fit_towards_what_they_weigh():
    profile = np.where(Y < 0.5, family(2.0), family(6.0))
    at_axis = fit(profile, weights=(Y < 0.5).astype(float))
    at_wall = fit(profile, weights=(Y >= 0.5).astype(float))
    assert_allclose(at_axis[1], 2.0, rtol=1e-6)
    assert_allclose(at_wall[1], 6.0, rtol=1e-6)


def test_single_precision_profiles_are_read():
    found = closest_profile((0.1 * family(2.0)).astype(np.float32)[None, :], Y)
    assert_allclose(found.exponent, 2.0, rtol=1e-5)
