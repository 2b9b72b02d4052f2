"""The radius of a deformed wall at fixed spatial angles, from displacements of its material points."""

import numpy as np
from scipy.ndimage import spline_filter1d

from cases.arrays import Floats
from solver.errors import ModelError

MOST_SWEEPS = 60
CLOSE = 1e-13  # rad


def radius_at_angles(radius: float, radial: Floats, tangential: Floats) -> Floats:
    """R at the angles of cell centres of a wall whose points have moved.

    A point at angle φ goes to φ + atan(u_φ/(R₀ + u_r)) and radius √((R₀ + u_r)² + u_φ²); both are
    interpolated by periodic cubic splines and inverted by fixed-point iteration.

    Parameters
    ----------
    radius : float
        R₀, m.
    radial, tangential : ndarray (n_x, m)
        u_r at cell centres and u_φ on the φ-faces before them, m.

    Returns
    -------
    ndarray (n_x, m)
        m.

    Raises
    ------
    ModelError
        Where the wall folds over: an angle is met twice.
    """
    n_x, m = radial.shape
    across = 0.5 * (tangential + np.roll(tangential, -1, axis=1))
    along = radius + radial
    turn = spline_filter1d(np.arctan2(across, along), order=3, axis=1, mode="grid-wrap")
    distance = spline_filter1d(np.hypot(along, across), order=3, axis=1, mode="grid-wrap")
    wanted = np.broadcast_to(np.arange(m, dtype=float), (n_x, m))
    source, cells_per_turn = wanted.copy(), m / (2 * np.pi)
    for _ in range(MOST_SWEEPS):
        better = wanted - cells_per_turn * _spline(turn, source)
        change = float(np.max(np.abs(better - source)))
        source = better
        if change < CLOSE * cells_per_turn:
            return _spline(distance, source)
    raise ModelError("the membrane folds over itself: its rotation is beyond this model")


def _spline(coefficients: Floats, position: Floats) -> Floats:
    """Periodic cubic B-spline of every section at positions counted in cells, (n_x, m)."""
    cell = np.floor(position)
    t = position - cell
    weights = ((1 - t) ** 3, 4 - 6 * t**2 + 3 * t**3, 1 + 3 * t + 3 * t**2 - 3 * t**3, t**3)
    first = cell.astype(np.int64) - 1
    total = np.zeros(position.shape)
    for shift, weight in enumerate(weights):
        column = (first + shift) % coefficients.shape[1]
        total += weight * np.take_along_axis(coefficients, column, axis=1)
    return total / 6
