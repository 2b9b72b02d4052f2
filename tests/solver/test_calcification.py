"""Calcified patches on (x, φ)."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from thesis_artery import CALCIFIED, HEALTHY, LENGTH, RING, SECTOR

from solver.geometry.calcification import Patch, calcified_stiffness, scaled_distance
from solver.geometry.grid import Grid

angles = st.floats(0.0, 2 * np.pi)
XI_X, XI_PHI = 2.5e-3, 0.375 * np.pi


def nearest_in_rectangle(x, phi, patch):
    """Scaled distance by searching the rectangle's copies at φ ± 2π."""
    first, last = patch.phi
    last = last if last > first else last + 2 * np.pi
    along = (x - np.clip(x, *patch.x)) / patch.x_transition
    around = min(abs(p - np.clip(p, first, last)) for p in (phi - 2 * np.pi, phi, phi + 2 * np.pi))
    return np.hypot(along, around / patch.phi_transition)


@given(angles, angles, st.integers(4, 40), st.floats(1e-3, 8e-3), st.floats(8e-3, 14e-3))
def test_smooth_distance_is_to_the_nearest_point_across_phi_zero(phi1, phi2, rows, x1, x2):
    patch = Patch((x1, x2), (phi1, phi2), XI_X, XI_PHI)
    grid = Grid(LENGTH, 9, rows)
    expected = [[nearest_in_rectangle(x, phi, patch) for phi in grid.phi] for x in grid.x]
    np.testing.assert_allclose(scaled_distance(grid, patch), expected, atol=1e-12)


@given(st.integers(0, 31), st.integers(0, 31), st.sampled_from([None, XI_PHI]))
def test_turning_the_patch_by_whole_rows_turns_the_distance(turn, first, transition):
    """The patch's ends lie on interfaces of rows; turned ones cross φ = 0."""
    grid, width = Grid(LENGTH, 6, 32), 7

    def distance(row):
        ends = (row % 32 * grid.dphi, (row + width) % 32 * grid.dphi)
        return scaled_distance(grid, Patch(RING, ends, XI_X, transition))

    np.testing.assert_allclose(distance(first + turn), np.roll(distance(first), turn, axis=1), atol=1e-12)


def test_crossing_phi_zero():
    grid = Grid(LENGTH, 3, 16)
    calcified = scaled_distance(grid, Patch(RING, (1.75 * np.pi, 0.25 * np.pi)))[1] == 0
    assert np.flatnonzero(calcified).tolist() == [0, 1, 14, 15]


def test_sharp_and_smooth():
    grid = Grid(LENGTH, 30, 16)
    sharp = scaled_distance(grid, Patch(RING, SECTOR))
    smooth = scaled_distance(grid, Patch(RING, SECTOR, XI_X, XI_PHI))
    assert set(np.unique(sharp)) == {0.0, np.inf}
    np.testing.assert_array_equal(sharp == 0, smooth == 0)
    assert np.sum(sharp == 0) == 10 * 4
    beta = calcified_stiffness(HEALTHY, CALCIFIED, sharp)
    np.testing.assert_allclose(beta[sharp == 0], CALCIFIED)
    np.testing.assert_allclose(beta[sharp > 0], HEALTHY)


def test_smooth_along_x_sharp_around():
    distance = scaled_distance(Grid(LENGTH, 30, 16), Patch(RING, SECTOR, x_transition=XI_X))
    outside = [j for j in range(16) if j not in (6, 7, 8, 9)]
    assert np.all(np.isinf(distance[:, outside]))
    assert np.all(np.isfinite(distance[:, 6:10]))


def test_axisymmetric_patches_do_not_depend_on_phi():
    distance = scaled_distance(Grid(LENGTH, 12, 8), Patch(RING, x_transition=XI_X))
    np.testing.assert_array_equal(distance, np.repeat(distance[:, :1], 8, axis=1))
    assert np.sum(distance[:, 0] == 0) == 4


@given(st.integers(4, 80))
def test_patches_symmetric_about_pi_are_symmetric_on_the_grid(rows):
    distance = scaled_distance(Grid(LENGTH, 3, rows), Patch(RING, SECTOR, XI_X, XI_PHI))
    np.testing.assert_allclose(distance, distance[:, ::-1], atol=1e-12)


@given(st.floats(0, 3), st.floats(100, 1e3), st.floats(1e3, 1e4))
def test_stiffness_between_healthy_and_calcified(distance, healthy, calcified):
    beta = float(calcified_stiffness(healthy, calcified, np.array(distance)))
    assert healthy * (1 - 1e-12) <= beta <= calcified * (1 + 1e-12)
    further = float(calcified_stiffness(healthy, calcified, np.array(distance + 0.1)))
    assert further <= beta * (1 + 1e-12)
    if distance >= 1:
        assert beta == pytest.approx(healthy, rel=1e-12)


def test_limits_and_middle():
    values = calcified_stiffness(HEALTHY, CALCIFIED, np.array([0.0, 0.5, 1.0, np.inf]))
    np.testing.assert_allclose(values, [CALCIFIED, (HEALTHY + CALCIFIED) / 2, HEALTHY, HEALTHY], rtol=1e-12)


@pytest.mark.parametrize("n_x", [3000, 12000])
def test_slope_is_the_analytic_one_and_continuous(n_x):
    """∂_xβ = (x−x_m)/((ξ^x)² d) · π(β_H−β_C)/2 · sin(πd); zero and continuous at d = 0 and 1."""
    grid = Grid(LENGTH, n_x, 1)
    distance = scaled_distance(grid, Patch(RING, x_transition=XI_X))[:, 0]
    beta = calcified_stiffness(HEALTHY, CALCIFIED, distance)
    numeric = np.gradient(beta, grid.dx)
    side = np.sign(grid.x - 7.5e-3)
    in_transition = (distance > 0) & (distance < 1)
    slope = side / XI_X * np.pi * (HEALTHY - CALCIFIED) / 2 * np.sin(np.pi * distance)
    expected = np.where(in_transition, slope, 0.0)
    bend = (np.pi / XI_X) ** 2 * (CALCIFIED - HEALTHY) / 2
    assert np.max(np.abs(numeric - expected)) < bend * grid.dx
    assert np.max(np.abs(np.diff(expected))) < 1.01 * bend * grid.dx
