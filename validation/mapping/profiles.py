"""The closest member of the profile family to a sampled velocity profile (figures 3.26, 3.30, 3.37)."""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

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


def closest_profile(
    velocities: NDArray[np.floating], y: Floats, weights: Floats | None = None
) -> ClosestProfile:
    """Fit u s(y; γ) to each profile by least squares over its points.

    Parameters
    ----------
    velocities : ndarray (n, n_y)
        v_x at y, m/s.
    y : ndarray (n_y,)
        Normalised radius r/R from 0 to 1.
    weights : ndarray (n_y,), optional
        Weights of the points; default 1 each, as the thesis.

    Returns
    -------
    ClosestProfile
        u in m/s; γ; ‖v − u s‖/‖v‖. A profile that is zero everywhere has u = 0, γ = 2 and error 0.
    """
    w = np.ones_like(y) if weights is None else weights
    v = np.asarray(velocities, dtype=float)
    best = _best_shapes(v, w, y, EXPONENTS)
    velocity, exponent, error = np.empty(len(v)), np.empty(len(v)), np.empty(len(v))
    logarithm = np.log(np.where(y > 0, y, 1.0))
    _refine(v, w, y, logarithm, best, EXPONENTS, velocity, exponent, error)
    return ClosestProfile(velocity, exponent, error)


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


@njit(cache=True, nogil=True, error_model="numpy")
def _slope(v: Floats, w: Floats, y: Floats, logarithm: Floats, gamma: float) -> float:
    """Return d(|v·f|/‖f‖)/dγ for f = 1 − y^γ, up to a positive factor."""
    vf, vd, ff, fd = 0.0, 0.0, 0.0, 0.0
    for k in range(y.size):
        power = np.exp(gamma * logarithm[k]) if y[k] > 0.0 else 0.0
        f = 1.0 - power
        d = -power * logarithm[k]
        vf += w[k] * v[k] * f
        vd += w[k] * v[k] * d
        ff += w[k] * f * f
        fd += w[k] * f * d
    sign = 1.0 if vf >= 0.0 else -1.0
    return sign * (vd * ff - vf * fd)


@njit(cache=True, nogil=True, error_model="numpy")
def _maximise(v: Floats, w: Floats, y: Floats, logarithm: Floats, low: float, high: float) -> float:
    """γ in [low, high] where the projection is largest: bracketed secant (Illinois) on its slope."""
    a, b = np.log(low), np.log(high)
    fa, fb = _slope(v, w, y, logarithm, low), _slope(v, w, y, logarithm, high)
    if not fa * fb < 0.0:
        return low if fa < 0.0 else high
    middle, side = 0.5 * (a + b), 0
    for _ in range(60):
        middle = (fa * b - fb * a) / (fa - fb)
        fm = _slope(v, w, y, logarithm, np.exp(middle))
        if fm == 0.0 or abs(b - a) < 1e-13:
            break
        previous = side
        if fm * fb < 0.0:
            a, fa, side = b, fb, 1
        else:
            side = -1
            if previous == -1:
                fa *= 0.5
        if abs(middle - b) < 1e-12:
            break
        b, fb = middle, fm
    return float(np.exp(middle))


@njit(cache=True, nogil=True, error_model="numpy")
def _refine(
    v: Floats,
    w: Floats,
    y: Floats,
    logarithm: Floats,
    best: Integers,
    exponents: Floats,
    velocity: Floats,
    exponent: Floats,
    error: Floats,
) -> None:
    """Search γ between the grid's neighbours of the best shape; fill u, γ and the relative error."""
    last = exponents.size - 1
    for n in range(v.shape[0]):
        size = 0.0
        for k in range(y.size):
            size += w[k] * v[n, k] * v[n, k]
        if size == 0.0:
            velocity[n], exponent[n], error[n] = 0.0, 2.0, 0.0
            continue
        if best[n] > last:
            exponent[n] = np.inf
        else:
            low, high = exponents[max(best[n] - 1, 0)], exponents[min(best[n] + 1, last)]
            exponent[n] = _maximise(v[n], w, y, logarithm, low, high)
        _measure(v[n], w, y, logarithm, n, velocity, exponent, error)


@njit(cache=True, nogil=True, error_model="numpy")
def _measure(
    v: Floats,
    w: Floats,
    y: Floats,
    logarithm: Floats,
    n: int,
    velocity: Floats,
    exponent: Floats,
    error: Floats,
) -> None:
    """Set u = v·s/s·s and ‖v − u s‖/‖v‖ for the exponent found."""
    gamma = exponent[n]
    factor = 1.0 if np.isinf(gamma) else (gamma + 2.0) / gamma
    vs, ss = 0.0, 0.0
    for k in range(y.size):
        s = factor * _family(gamma, y[k], logarithm[k])
        vs += w[k] * v[k] * s
        ss += w[k] * s * s
    velocity[n] = vs / ss
    rest, size = 0.0, 0.0
    for k in range(y.size):
        s = factor * _family(gamma, y[k], logarithm[k])
        rest += w[k] * (v[k] - velocity[n] * s) ** 2
        size += w[k] * v[k] ** 2
    error[n] = np.sqrt(rest / size)


@njit(cache=True, nogil=True, error_model="numpy")
def _family(gamma: float, y: float, logarithm: float) -> float:
    if np.isinf(gamma):
        return 1.0 if y < 1.0 else 0.0
    return 1.0 - (np.exp(gamma * logarithm) if y > 0.0 else 0.0)
