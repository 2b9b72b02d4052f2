"""Where the wall is calcified: rectangles on (x, φ) with an optional smooth transition (2.2.58–2.2.61)."""

from dataclasses import dataclass

import numpy as np

from cases.arrays import Floats
from solver.geometry.grid import Grid

ROUND_OFF = 1e-12


@dataclass(frozen=True)
class Patch:
    """A calcified rectangle.

    Attributes
    ----------
    x : tuple of float
        Its ends along the artery, m.
    phi : tuple of float or None
        Its ends around the artery, rad, from the first to the second in positive direction
        (the patch may cross φ = 0); None for all around.
    x_transition, phi_transition : float or None
        Lengths ξ^x (m) and ξ^φ (rad) of the smooth transition outside; None for a sharp edge.
    """

    x: tuple[float, float]
    phi: tuple[float, float] | None = None
    x_transition: float | None = None
    phi_transition: float | None = None


def distance_to_interval(value: Floats, first: float, last: float, period: float | None) -> Floats:
    """Distance of values to an interval, 0 inside; periodic if a period is given."""
    middle, half = 0.5 * (first + last), 0.5 * (last - first)
    offset = value - middle
    if period is not None:
        offset = (offset + 0.5 * period) % period - 0.5 * period
    distance = np.abs(offset) - half
    # a centre on the edge belongs to the patch, whatever round-off says
    on_edge = ROUND_OFF * max(abs(first), abs(last))
    return np.where(distance > on_edge, distance, 0.0)


def distance_around(phi: Floats, first: float, last: float) -> Floats:
    """Angle from φ to the arc that runs from ``first`` to ``last`` in positive direction, rad."""
    return distance_to_interval(phi, first, last if last > first else last + 2 * np.pi, 2 * np.pi)


def _scaled(distance: Floats, length: float | None) -> Floats:
    if length is None:
        return np.where(distance > 0, np.inf, 0.0)
    return distance / length


def scaled_distance(grid: Grid, patch: Patch) -> Floats:
    """Distance d of each cell centre to the patch in units of the transition lengths (2.2.59).

    Returns
    -------
    ndarray (n_x, n_phi)
        0 inside, 1 and more in the healthy wall; infinite outside a sharp edge.
    """
    along = _scaled(distance_to_interval(grid.x, *patch.x, period=None), patch.x_transition)
    if patch.phi is None:
        around = np.zeros(grid.n_phi)
    else:
        around = _scaled(distance_around(grid.phi, *patch.phi), patch.phi_transition)
    return np.hypot(along[:, None], around[None, :])


def calcified_stiffness(healthy: float, calcified: float, distance: Floats) -> Floats:
    """β = (β_H+β_C)/2 − (β_H−β_C)/2 · cos(πd) for d < 1, β_H beyond (2.2.60).

    Parameters
    ----------
    healthy, calcified : float
        β_H and β_C, Pa m; or two moduli likewise, Pa.
    distance : ndarray
        Scaled distance d to the patch.

    Returns
    -------
    ndarray
        β of the shape of ``distance``.
    """
    near = np.minimum(distance, 1.0)
    return (healthy + calcified) / 2 - (healthy - calcified) / 2 * np.cos(np.pi * near)
