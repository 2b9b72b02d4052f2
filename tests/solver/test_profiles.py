"""Velocity profiles: every identity of the family by quadrature, and the continuity closure."""

import numpy as np
import pytest
from closed_forms import axis_velocity, continuity_exponent, momentum_correction
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from solver.model.profiles import axis_ratio, shape

exponents = st.floats(0.2, 40.0)
REST = 1e-9


def integral(integrand, gamma):
    """∫₀¹ of a function that may grow like y^(γ−1) at 0, by y = z^m."""
    m = max(1.0, 2.0 / gamma)
    value, _ = quad(lambda z: integrand(z**m) * m * z ** (m - 1), 0, 1, epsabs=1e-12, epsrel=1e-12, limit=200)
    return value


def slope(y, gamma):
    return -(gamma + 2) * y ** (gamma - 1)


def curvature(y, gamma):
    return -(gamma + 2) * (gamma - 1) * y ** (gamma - 2)


def log(y):
    return np.log(max(y, 1e-300))


def by_exponent(y, gamma):
    """∂_γ s."""
    return -2 / gamma**2 * (1 - y**gamma) - (gamma + 2) / gamma * y**gamma * log(y)


@given(exponents, st.floats(0.1, 0.999))
def test_the_derivatives_used_here_are_those_of_the_shape(gamma, y):
    step = 1e-5
    along = (shape(y + step, gamma) - shape(y - step, gamma)) / (2 * step)
    twice = (slope(y + step, gamma) - slope(y - step, gamma)) / (2 * step)
    across = (shape(y, gamma + step) - shape(y, gamma - step)) / (2 * step)
    assert along == pytest.approx(slope(y, gamma), rel=1e-5, abs=1e-8)
    assert twice == pytest.approx(curvature(y, gamma), rel=1e-5, abs=1e-6)
    assert across == pytest.approx(by_exponent(y, gamma), rel=1e-5, abs=1e-6)


@given(exponents)
def test_on_the_wall_and_on_the_axis(gamma):
    assert shape(1.0, gamma) == 0
    assert shape(0.0, gamma) == pytest.approx((gamma + 2) / gamma)
    assert axis_ratio(gamma) == pytest.approx((gamma + 2) / gamma)
    step = 1e-7
    assert -shape(1 - step, gamma) / step == pytest.approx(-(gamma + 2), rel=1e-5)


@settings(deadline=None)
@given(exponents)
def test_integrals_of_the_shape(gamma):
    assert integral(lambda y: y * shape(y, gamma), gamma) == pytest.approx(0.5, rel=1e-10)
    alpha = 2 * integral(lambda y: y * shape(y, gamma) ** 2, gamma)
    assert alpha == pytest.approx((gamma + 2) / (gamma + 1), rel=1e-10)
    assert momentum_correction(gamma) == pytest.approx(alpha, rel=1e-10)


@settings(deadline=None)
@given(exponents)
def test_integrals_of_the_derivatives(gamma):
    centre, wall_slope = (gamma + 2) / gamma, -(gamma + 2)
    assert integral(lambda y: slope(y, gamma), gamma) == pytest.approx(-centre, rel=1e-9)
    bending = integral(lambda y: y * curvature(y, gamma), gamma)
    assert bending == pytest.approx(wall_slope + centre, rel=1e-8, abs=1e-9)
    assert abs(bending - (wall_slope - centre)) > 1  # the sign that (2.2.11) prints


@settings(deadline=None)
@given(exponents)
def test_integrals_with_the_derivative_by_the_exponent(gamma):
    assert integral(lambda y: y * by_exponent(y, gamma), gamma) == pytest.approx(0, abs=1e-9)
    second = integral(lambda y: y * shape(y, gamma) * by_exponent(y, gamma), gamma)
    assert second == pytest.approx(-1 / (4 * (gamma + 1) ** 2), rel=1e-8, abs=1e-9)
    step = 1e-5
    alpha_slope = (momentum_correction(gamma + step) - momentum_correction(gamma - step)) / (2 * step)
    assert second == pytest.approx(alpha_slope / 4, rel=1e-5, abs=1e-9)
    printed = -(5 * gamma + 4) / (4 * gamma * (gamma + 1) ** 2)  # appendix B.2.5
    assert second > 0.5 * printed


@settings(deadline=None)
@given(exponents)
def test_integrals_with_logarithms(gamma):
    first = integral(lambda y: y**gamma * log(y), gamma)
    second = integral(lambda y: y**gamma * log(y) ** 2, gamma)
    assert first == pytest.approx(-1 / (gamma + 1) ** 2, rel=1e-8)
    assert second == pytest.approx(2 / (gamma + 1) ** 3, rel=1e-8)
    cross = integral(lambda y: y ** (gamma - 1) * (1 + gamma * log(y)), gamma)
    assert cross == pytest.approx(0, abs=1e-8)  # hence no (∂_φR)(∂_φγ) term in h


@pytest.mark.parametrize(
    ("gamma", "profile"),
    [(1.0, lambda y: 3 * (1 - y)), (2.0, lambda y: 2 * (1 - y**2)), (np.inf, lambda y: 1.0 * (y < 1))],
    ids=["cone", "Poiseuille", "plug"],
)
def test_named_profiles(gamma, profile):
    y = np.linspace(0, 1, 11)
    np.testing.assert_allclose(shape(y, gamma), profile(y), atol=1e-15)


velocities = st.lists(st.floats(0.5, 1.2), min_size=4, max_size=12).map(np.array)


@given(velocities, st.sampled_from([-1.0, 1.0]), st.floats(1e-3, 10.0))
def test_the_closure_makes_the_axis_velocity_one(relative, sign, scale):
    u = sign * scale * relative
    gamma = continuity_exponent(u, REST)
    centre = np.mean(u) * 2
    admissible = np.abs(u) < abs(centre)
    np.testing.assert_array_equal(np.isfinite(gamma), admissible)
    assert np.all(gamma[admissible] > 0)
    np.testing.assert_allclose((axis_ratio(gamma) * u)[admissible], centre, rtol=1e-12)
    np.testing.assert_allclose(axis_velocity(u), [centre], rtol=1e-14)


@given(st.integers(1, 9), st.floats(1e-6, 5.0), st.sampled_from([-1.0, 1.0]))
def test_equal_rows_are_poiseuille(rows, speed, sign):
    np.testing.assert_allclose(continuity_exponent(np.full(rows, sign * speed), REST), 2.0, rtol=1e-12)


def test_inadmissible_rows_are_nan():
    forward_and_back = np.array([1.0, 1.0, -0.1, 1.0])
    np.testing.assert_array_equal(np.isnan(continuity_exponent(forward_and_back, REST)), forward_and_back < 0)
    one_jet = np.array([2.0, 0.1, 0.1, 0.1])  # u ≥ D = 2 mean(u)
    np.testing.assert_array_equal(np.isnan(continuity_exponent(one_jet, REST)), one_jet > 1)
    assert np.isnan(continuity_exponent(np.array([1.0, 0.0, 1.0, 1.0]), REST)[1])


def test_a_section_at_rest_is_poiseuille_and_sections_are_independent():
    u = np.array([[1e-12, -1e-12, 0.0, 1e-12], [0.1, 0.12, 0.1, 0.08]])
    gamma = continuity_exponent(u, REST)
    np.testing.assert_array_equal(gamma[0], 2.0)
    np.testing.assert_array_equal(gamma[1], continuity_exponent(u[1], REST))
