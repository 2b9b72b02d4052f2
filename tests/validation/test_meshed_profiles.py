"""The closest profile as a mesh of linear elements shows it, and the nodes around a point as two rings."""

import numpy as np
import pytest
from closest import closest_profile
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from tubes import Tube

from validation.mapping.meshed_profiles import closest_meshed_profile, meshed_shapes
from validation.mapping.nodal_shares import TwoRings, nodal_shares, two_rings
from validation.mapping.profiles import errors_of

Y = np.linspace(0.0, 1.0, 25)
NODES = np.linspace(0.0, 1.0, 9)
EXPONENTS = st.floats(0.3, 50.0)
SHARES = st.lists(st.floats(0.0, 1.0), min_size=4, max_size=8)


def rings_of_a_line(nodes=NODES, y=Y):
    """Points between the rings of nodes that hold them."""
    k = np.clip(np.searchsorted(nodes, y, side="right") - 1, 0, nodes.size - 2)
    return TwoRings(nodes[k], nodes[k + 1], (y - nodes[k]) / (nodes[k + 1] - nodes[k]))


def fit(profile, rings):
    one = TwoRings(*(part[None, :] for part in rings))
    return tuple(float(part[0]) for part in closest_meshed_profile(profile[None, :], Y, one))


def meshed(gamma, rings):
    return meshed_shapes(TwoRings(*(part[None, :] for part in rings)), np.array([[gamma]]))[0, 0]


@given(SHARES, st.integers(0, 2**32 - 1))
def test_two_rings_have_the_nodes_first_four_moments(shares, seed):
    y, weights = np.array(shares), np.random.default_rng(seed).dirichlet(np.ones(len(shares)))
    found = two_rings(np.array([weights @ y, weights @ y**2, weights @ y**3])[None])
    inner, outer, weight = (float(part[0]) for part in found)
    assert 0 <= inner <= outer <= 1
    for power in range(4):
        assert_allclose((1 - weight) * inner**power + weight * outer**power, weights @ y**power, atol=1e-6)


@given(st.floats(0.1, 0.9), st.floats(0.01, 0.1), st.floats(0.05, 0.95), EXPONENTS)
def test_nodes_on_two_rings_are_found_exactly(inner, gap, weight, gamma):
    y, weights = np.array([inner, inner + gap]), np.array([1 - weight, weight])
    found = two_rings(np.array([weights @ y, weights @ y**2, weights @ y**3])[None])
    assert_allclose(
        1 - meshed_shapes(TwoRings(*(p[None] for p in found)), np.array([[gamma]]))[0, 0],
        [weights @ y**gamma],
        rtol=1e-6,
        atol=1e-10,
    )


@given(st.sampled_from([0.1, -2.0]), EXPONENTS)
def test_recovers_a_profile_known_at_nodes_only(u, gamma):
    rings = rings_of_a_line()
    profile = u * (gamma + 2) / gamma * np.interp(Y, NODES, 1 - NODES**gamma)
    found, exponent, error = fit(profile, rings)
    assert_allclose([found, exponent], [u, gamma], rtol=1e-6)
    assert error < 1e-8


@given(st.lists(st.floats(0.05, 1.0), min_size=24, max_size=24))
def test_without_a_mesh_it_is_the_closest_profile(values):
    profile = np.append(values, 0.0)
    exact = TwoRings(Y, Y, np.zeros(25))
    plain = closest_profile(profile[None], Y)
    found = fit(profile, exact)
    assert found[2] == pytest.approx(plain.error[0], abs=1e-9)
    assert found[0] == pytest.approx(plain.velocity[0], rel=1e-5)


@given(st.lists(st.floats(-0.2, 0.2), min_size=24, max_size=24), st.floats(0.5, 20.0))
@settings(max_examples=60)
def test_no_exponent_nearby_is_closer(noise, gamma):
    rings = rings_of_a_line()
    profile = np.append(noise, 0.0) + meshed(gamma, rings)
    _, exponent, error = fit(profile, rings)
    if np.isfinite(exponent):
        others = np.geomspace(max(exponent / 1.2, 0.05), min(exponent * 1.2, 1e3), 101)
        shapes = meshed_shapes(TwoRings(*(part[None] for part in rings)), others[None])
        assert error <= errors_of(profile[None], shapes).min() + 1e-9


@pytest.mark.parametrize("u", [0.1, -3.0])
def test_plug_flow_at_the_nodes_has_infinite_exponent(u):
    profile = u * np.interp(Y, NODES, (NODES < 1).astype(float))
    assert fit(profile, rings_of_a_line()) == (
        pytest.approx(u, rel=1e-12),
        np.inf,
        pytest.approx(0.0, abs=1e-12),
    )


def test_rest():
    assert fit(np.zeros(25), rings_of_a_line()) == (0.0, 2.0, 0.0)


def test_interpolated_shapes_are_those_of_the_mesh():
    gamma = np.array([[0.7, 2.0, 9.0]])
    shapes = meshed_shapes(TwoRings(*(part[None] for part in rings_of_a_line())), gamma)
    expected = [np.interp(Y, NODES, 1 - NODES**g) for g in gamma[0]]
    assert_allclose(shapes[0], expected, atol=1e-14)


@pytest.mark.parametrize("tetrahedra", [False, True])
def test_shares_of_nodes_are_those_they_were_displaced_by(tetrahedra):
    tube = Tube(sectors=12, rings=4, stacks=6, layers=1, tetrahedra=tetrahedra)
    cells = tube.cells(5, 8)
    points = tube.coordinates + tube.displacement
    faces = np.zeros(tube.mesh.lumen_nodes.size, dtype=np.int64)
    radius = tube.wall(cells.x[:, None], cells.phi[None, :])
    shares = nodal_shares(points, tube.mesh, radius, cells, faces)
    wet = tube.mesh.lumen_nodes
    exact = np.hypot(*tube.coordinates[wet, 1:].T) / tube.radius
    assert_allclose(shares[wet], exact, atol=1e-12)
    assert np.all(np.isnan(np.delete(shares, wet)))


def test_a_node_beyond_the_interface_takes_the_nearest_rays_radius():
    tube = Tube(sectors=12, rings=4, stacks=6, layers=1)
    cells = tube.cells(5, 24)
    points = tube.coordinates + tube.displacement
    wet = tube.mesh.lumen_nodes
    out = wet[(points[wet, 0] == 0) & ~np.isin(wet, tube.mesh.interface_nodes)]
    points[out, 0] -= 1e-5
    faces = np.zeros(wet.size, dtype=np.int64)
    radius = np.full((5, 24), 3e-3)
    shares = nodal_shares(points, tube.mesh, radius, cells, faces)
    assert_allclose(shares[out], np.hypot(*points[out, 1:].T) / 3e-3, rtol=1e-12)
