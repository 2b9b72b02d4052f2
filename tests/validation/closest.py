"""The closest member of the profile family by plain least squares over points."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from cases.arrays import Floats, Integers
from validation.mapping.profiles import EXPONENTS, ClosestProfile, _best_shapes


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
