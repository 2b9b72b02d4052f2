"""The closest member of the profile family to a sampled velocity profile (figures 3.26, 3.30, 3.37)."""

from typing import NamedTuple

import numpy as np
from numba import njit

from cases.arrays import Floats, Integers

EXPONENTS = np.geomspace(0.05, 1000.0, 240)  # brackets of the search for γ; beyond lies plug flow
COARSE = 4  # every so many of them suffice to start a search that brackets by itself
TIE = 1e-12  # plug flow counts as closest if no exponent projects better than by this share


class ClosestProfile(NamedTuple):
    """(u, γ) that minimise ‖v − u s(y; γ)‖ and the relative error there, each (n,).

    ``exponent`` is infinite where plug flow is closest.
    """

    velocity: Floats
    exponent: Floats
    error: Floats


def nearest_exponents(velocities: Floats, y: Floats) -> Floats:
    """Exponent of a coarse grid that is nearest to each profile's closest one, (n,): where to search."""
    grid = EXPONENTS[::COARSE]
    best = _best_shapes(velocities, np.ones_like(y), y, grid)
    return np.asarray(grid[np.minimum(best, grid.size - 1)])


def _best_shapes(v: Floats, w: Floats, y: Floats, exponents: Floats) -> Integers:
    """Index of the exponent whose shape is closest to each profile; one beyond the last is plug flow."""
    shapes = 1.0 - y[None, :] ** exponents[:, None]
    plug = (y < 1.0).astype(float)
    bases = np.vstack([shapes, plug])
    bases /= np.sqrt(np.sum(w * bases**2, axis=1))[:, None]
    best = np.empty(len(v), dtype=np.int64)
    _best_shape(v, w, np.ascontiguousarray(bases.T), best)
    return best


def errors_at(velocities: Floats, y: Floats, exponents: Floats) -> Floats:
    """Relative error of each profile from the closest one with given exponents.

    Parameters
    ----------
    velocities : ndarray (n, n_y)
        v_x at y, m/s.
    y : ndarray (n_y,)
        Normalised radius r/R from 0 to 1.
    exponents : ndarray (n, m)
        γ > 0; infinite for plug flow.

    Returns
    -------
    ndarray (n, m)
        ‖v − u s‖/‖v‖ with the best u; NaN for a profile that is zero everywhere.
    """
    return errors_of(velocities, 1.0 - y ** exponents[..., None])


def errors_of(velocities: Floats, shapes: Floats) -> Floats:
    """Relative error of each profile (n, n_y) from the best multiple of given shapes (n, m, n_y), (n, m).

    NaN for a profile that is zero everywhere.
    """
    best = np.einsum("nk,nmk->nm", velocities, shapes) / np.sum(shapes**2, axis=2)
    rest = np.linalg.norm(velocities[:, None, :] - best[..., None] * shapes, axis=2)
    size = np.broadcast_to(np.linalg.norm(velocities, axis=1)[:, None], rest.shape)
    error = np.full(rest.shape, np.nan)
    np.divide(rest, size, out=error, where=size > 0)
    return error


@njit(cache=True, nogil=True, error_model="numpy")
def _best_shape(v: Floats, w: Floats, bases: Floats, best: Integers) -> None:
    """Index of the unit shape (n_y, m) that each profile projects on best; the last, plug flow, wins ties.

    A kernel and not a matrix product: the threads of a linear algebra library wait for each other at full
    speed, and take the processor from variants that are computed beside this one.
    """
    last = bases.shape[1] - 1
    score = np.empty(last + 1)
    for n in range(v.shape[0]):
        score[:] = 0.0
        for k in range(w.size):
            weighted = w[k] * v[n, k]
            for m in range(last + 1):
                score[m] += weighted * bases[k, m]
        found, largest = 0, abs(score[0])
        for m in range(1, last + 1):
            if abs(score[m]) > largest:
                found, largest = m, abs(score[m])
        best[n] = last if abs(score[last]) >= (1.0 - TIE) * largest else found
