"""The closest profiles of two modes: what is of the family is found exactly, also through a mesh."""

import numpy as np
from numpy.testing import assert_allclose

from solver.model.profiles import TwoModes
from validation.mapping.nodal_shares import TwoRings
from validation.mapping.two_modes import closest_modes

Y = np.linspace(0.0, 1.0, 11)
MODES = TwoModes("mean")


def on_rings(inner, outer, weight, d, bend):
    """Profiles as linear elements with nodes on two rings show them."""
    values = [MODES.velocity(part, np.broadcast_to(d[:, None], bend.shape), bend) for part in (inner, outer)]
    return (1 - weight) * values[0] + weight * values[1]


def rings_of(shape, nodes):
    """Nodes at equidistant r/R around each point of every ray."""
    below = np.floor(Y * nodes) / nodes
    above = np.minimum(below + 1 / nodes, 1.0)
    weight = np.where(above > below, (Y - below) * nodes, 0.0)
    return TwoRings(*(np.broadcast_to(part, (*shape, Y.size)).copy() for part in (below, above, weight)))


def test_profiles_of_the_family_are_found_through_the_mesh():
    rng = np.random.default_rng(1)
    d, bend = rng.normal(size=5), rng.normal(size=(5, 6))
    for nodes in (8, 64):
        rings = rings_of((5, 6), nodes)
        velocities = on_rings(rings.inner[0, 0], rings.outer[0, 0], rings.weight[0, 0], d, bend)
        found = closest_modes(velocities, rings)
        assert_allclose(found.axis_velocity, d, rtol=1e-12)
        assert_allclose(found.bend, bend, rtol=1e-11)
        assert np.max(found.error) < 1e-13


def test_no_other_member_is_closer():
    rings = rings_of((1, 4), 8)
    velocities = 1 - Y**4 + 0.1 * np.cos(np.arange(4))[:, None] * Y * (1 - Y)
    found = closest_modes(velocities[None], rings)

    def missed(d, bend):
        own = on_rings(rings.inner[0, 0], rings.outer[0, 0], rings.weight[0, 0], d, bend)
        return np.sum((velocities[None] - own) ** 2)

    least = missed(found.axis_velocity, found.bend)
    assert least > 0
    for change in (1e-3, -1e-3):
        assert missed(found.axis_velocity + change, found.bend) > least
        for j in range(4):
            other = found.bend.copy()
            other[0, j] += change
            assert missed(found.axis_velocity, other) > least


def test_a_ray_at_rest_has_no_error():
    found = closest_modes(np.zeros((1, 4, Y.size)), rings_of((1, 4), 8))
    assert np.all(found.error == 0)
    assert np.all(found.axis_velocity == 0)
