"""The closest profiles of two modes to those of a section: D (1 − y²) + B y²(1 − y⁴), one D for all rows."""

from typing import NamedTuple

import numpy as np

from cases.arrays import Floats
from solver.model.profiles import TwoModes
from validation.mapping.nodal_shares import TwoRings

SHAPES = TwoModes("mean").shapes  # f and g with the exponent 2 of Poiseuille's profile


class ClosestModes(NamedTuple):
    """D (n_x,) and B (n_x, n_phi), m/s, and ‖v − Df − Bg‖/‖v‖ of each ray (n_x, n_phi)."""

    axis_velocity: Floats
    bend: Floats
    error: Floats


def closest_modes(velocities: Floats, rings: TwoRings) -> ClosestModes:
    """Fit a section's profiles by linear least squares over their points.

    Parameters
    ----------
    velocities : ndarray (n_x, n_phi, n_y)
        v_x, m/s.
    rings : TwoRings
        Of the nodes around each point, (n_x, n_phi, n_y): both modes are interpolated as the velocity is.

    Returns
    -------
    ClosestModes
        The error of a ray at rest is 0.
    """
    inner, outer = SHAPES(rings.inner), SHAPES(rings.outer)
    first, second = ((1 - rings.weight) * a + rings.weight * b for a, b in zip(inner, outer, strict=True))
    across = _dot(first, second) / _dot(second, second)
    rest = first - across[..., None] * second  # of f, what no B gives
    d = _dot(rest, velocities).sum(axis=-1) / _dot(rest, rest).sum(axis=-1)
    remainder = velocities - d[:, None, None] * first
    bend = _dot(second, remainder) / _dot(second, second)
    missed = np.linalg.norm(remainder - bend[..., None] * second, axis=-1)
    size = np.linalg.norm(velocities, axis=-1)
    error = np.zeros(size.shape)
    np.divide(missed, size, out=error, where=size > 0)
    return ClosestModes(d, bend, error)


def _dot(one: Floats, other: Floats) -> Floats:
    return np.asarray(np.einsum("ijk,ijk->ij", one, other))
