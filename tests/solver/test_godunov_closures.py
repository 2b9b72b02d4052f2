"""Closures of the continuity condition (2.2.55–57)."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import minimize_scalar

from solver.schemes.godunov.continuity import (
    average,
    close_section_profiles,
    least_squares,
    maximum,
    profile_distance,
)
from solver.schemes.godunov.layout import AVERAGE, LEAST_SQUARES, MAXIMUM

U = np.array([0.08, 0.1, 0.11, 0.09, 0.07, 0.085])
GAMMA = np.array([1.8, 2.0, 2.6, 2.1, 1.5, 2.2])
rows = st.integers(4, 13).flatmap(
    lambda n: st.tuples(
        st.lists(st.floats(0.05, 0.09), min_size=n, max_size=n),
        st.lists(st.floats(0.8, 6.0), min_size=n, max_size=n),
    )
)


def axis(u, gamma):
    return (gamma + 2) / gamma * u


def test_average_is_twice_the_mean_velocity():
    assert average(U) == pytest.approx(2 * U.mean(), rel=1e-15)


def test_maximum_is_the_fastest_axis_velocity_in_either_direction():
    assert maximum(U, GAMMA) == axis(U, GAMMA).max()
    assert maximum(-U, GAMMA) == -axis(U, GAMMA).max()


def test_distance_of_profiles_by_quadrature():
    D = 0.21

    def squared(y, u, gamma):
        corrected = D * (1 - y ** (2 * u / (D - u)))
        return (corrected - axis(u, gamma) * (1 - y**gamma)) ** 2

    expected = sum(
        np.sqrt(quad(squared, 0, 1, args=pair, epsabs=1e-14)[0]) for pair in zip(U, GAMMA, strict=True)
    )
    assert profile_distance(D, U, GAMMA) == pytest.approx(expected, rel=1e-9)


@settings(deadline=None, max_examples=60)
@example(pair=([0.0546875, 0.0546875, 0.0859375, 0.05078125], [4.0, 4.0, 1.0, 3.0]))
@given(rows)
def test_least_squares_finds_the_global_minimum(pair):
    u, gamma = map(np.array, pair)
    D = least_squares(u, gamma)
    found = profile_distance(D, u, gamma)
    low, high = max(axis(u, gamma).min(), u.max() * 1.0001), axis(u, gamma).max()
    grid = np.linspace(low, max(high, low * 1.0001), 400)
    best = grid[np.argmin([profile_distance(d, u, gamma) for d in grid])]
    # below the fastest mean velocity no exponent is admissible and the distance means nothing
    around = (max(low, best - (grid[1] - grid[0])), best + (grid[1] - grid[0]))
    scipy = minimize_scalar(
        profile_distance, bounds=around, args=(u, gamma), method="bounded", options={"xatol": 1e-12}
    )
    assert found <= scipy.fun * (1 + 1e-6) + 1e-12


def test_least_squares_of_backward_flow_is_the_mirror_image():
    assert least_squares(-U, GAMMA) == pytest.approx(-least_squares(U, GAMMA), rel=1e-12)


@pytest.mark.parametrize("closure", [AVERAGE, MAXIMUM, LEAST_SQUARES])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_corrected_profiles_meet_on_the_axis(closure, sign):
    gamma = GAMMA.copy()
    assert close_section_profiles(sign * U, gamma, closure) == 0
    on_axis = axis(sign * U, gamma)
    np.testing.assert_allclose(on_axis, on_axis[0], rtol=1e-13)
    assert np.all(gamma > 0)


@pytest.mark.parametrize("closure", [MAXIMUM, LEAST_SQUARES])
def test_continuous_profiles_are_left_alone(closure):
    gamma = 2 * U / (0.2 - U)
    before = gamma.copy()
    assert close_section_profiles(U, gamma, closure) == 0
    np.testing.assert_allclose(gamma, before, rtol=1e-7)


def test_section_at_rest_has_a_parabola():
    gamma = GAMMA.copy()
    assert close_section_profiles(np.zeros(6), gamma, AVERAGE) == 0
    assert np.all(gamma == 2.0)


@pytest.mark.parametrize("closure", [AVERAGE, MAXIMUM, LEAST_SQUARES])
def test_row_without_admissible_exponent_is_named(closure):
    u = U.copy()
    u[3] = -0.01
    assert close_section_profiles(u, GAMMA.copy(), closure) == 4


def test_row_faster_than_the_axis_is_named():
    assert close_section_profiles(np.array([0.01, 0.01, 0.2, 0.01]), np.full(4, 2.0), AVERAGE) == 3
