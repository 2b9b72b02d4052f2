"""The closest member of the profile family as a mesh of linear elements shows it: like with like."""

import numpy as np
from numba import njit

from cases.arrays import Floats
from validation.mapping.nodal_shares import TwoRings
from validation.mapping.profiles import EXPONENTS, TIE, ClosestProfile, nearest_exponents

STRIDE = 1.1  # by which a bracket of γ grows from its start, then faster
LOGARITHM_OF_ZERO = -1e300  # stands for y = 0: any power of it vanishes


def closest_meshed_profile(velocities: Floats, y: Floats, rings: TwoRings) -> ClosestProfile:
    """Fit u s(y_a; γ), interpolated as the velocity is, to each profile by least squares over its points.

    Parameters
    ----------
    velocities : ndarray (n, n_y)
        Interpolated v_x at y, m/s.
    y : ndarray (n_y,)
        Normalised radius r/R from 0 to 1.
    rings : TwoRings
        Of the nodes around each point, (n, n_y).

    Returns
    -------
    ClosestProfile
        u in m/s; γ, infinite for plug flow at the nodes; ‖v − u I s‖/‖v‖. A profile that is zero everywhere
        has u = 0, γ = 2 and error 0.
    """
    v = np.asarray(velocities, dtype=float)
    velocity, exponent, error = np.empty(len(v)), np.empty(len(v)), np.empty(len(v))
    logarithms = TwoRings(_logarithm(rings.inner), _logarithm(rings.outer), rings.weight)
    _fit(v, logarithms, nearest_exponents(v, y), velocity, exponent, error)
    return ClosestProfile(velocity, exponent, error)


def meshed_shapes(rings: TwoRings, exponents: Floats) -> Floats:
    """1 − y^γ interpolated by the mesh, (n, m, n_y), for exponents (n, m)."""
    gamma = exponents[..., None]
    inner, outer, weight = (part[:, None, :] for part in rings)
    return np.asarray(1.0 - (1.0 - weight) * inner**gamma - weight * outer**gamma)


def _logarithm(y: Floats) -> Floats:
    found = np.full(y.shape, LOGARITHM_OF_ZERO)
    np.log(y, out=found, where=y > 0)
    return found


@njit(cache=True, nogil=True, error_model="numpy")
def _slope(v: Floats, inner: Floats, outer: Floats, weight: Floats, gamma: float) -> float:
    """d(|v·f|/‖f‖)/dγ for the interpolated f = 1 − y^γ, up to a positive factor."""
    vf, vd, ff, fd = 0.0, 0.0, 0.0, 0.0
    for k in range(v.size):
        first = (1.0 - weight[k]) * np.exp(gamma * inner[k])
        f, d = 1.0 - first, -first * inner[k] if first > 0.0 else 0.0
        if weight[k] > 0.0:
            second = weight[k] * np.exp(gamma * outer[k])
            f -= second
            d -= second * outer[k]
        vf += v[k] * f
        vd += v[k] * d
        ff += f * f
        fd += f * d
    sign = 1.0 if vf >= 0.0 else -1.0
    return sign * (vd * ff - vf * fd)


@njit(cache=True, nogil=True, error_model="numpy")
def _shape(inner: float, outer: float, weight: float, gamma: float) -> float:
    """Interpolated 1 − y^γ from logarithms of the rings' r/R."""
    if np.isinf(gamma):
        return (1.0 - weight) * (inner < 0.0) + weight * (outer < 0.0)
    return float(1.0 - (1.0 - weight) * np.exp(gamma * inner) - weight * np.exp(gamma * outer))


@njit(cache=True, nogil=True, error_model="numpy")
def _project(
    v: Floats, inner: Floats, outer: Floats, weight: Floats, gamma: float, shape: Floats
) -> tuple[float, float]:
    """Fill the interpolated ``shape`` f; return v·f and f·f."""
    vf, ff = 0.0, 0.0
    for k in range(v.size):
        shape[k] = _shape(inner[k], outer[k], weight[k], gamma)
        vf += v[k] * shape[k]
        ff += shape[k] ** 2
    return vf, ff


@njit(cache=True, nogil=True, error_model="numpy")
def _search(
    v: Floats, inner: Floats, outer: Floats, weight: Floats, start: float, least: float, largest: float
) -> float:
    """γ where the projection is largest, uphill from ``start``: a growing bracket, then Illinois secants."""
    a = np.log(start)
    fa = _slope(v, inner, outer, weight, start)
    if fa == 0.0:
        return start
    stride = np.log(STRIDE) if fa > 0.0 else -np.log(STRIDE)
    low, high = np.log(least), np.log(largest)
    while True:
        b = min(max(a + stride, low), high)
        fb = _slope(v, inner, outer, weight, np.exp(b))
        if fa * fb <= 0.0:
            break
        if b in (low, high):
            return float(np.exp(b))
        a, fa, stride = b, fb, 2.0 * stride
    side = 0
    for _ in range(60):
        if fb == 0.0 or abs(b - a) < 1e-13:
            break
        middle = (fa * b - fb * a) / (fa - fb)
        fm = _slope(v, inner, outer, weight, np.exp(middle))
        if fm * fb < 0.0:
            a, fa, side = b, fb, 0
        else:
            if side == 1:
                fa *= 0.5
            side = 1
        step = abs(middle - b)
        b, fb = middle, fm
        if step < 1e-10:
            break
    return float(np.exp(b))


@njit(cache=True, nogil=True, error_model="numpy")
def _fit(
    v: Floats, rings: TwoRings, start: Floats, velocity: Floats, exponent: Floats, error: Floats
) -> None:
    """Fill u, γ and the relative error of each profile."""
    shape, plug = np.empty(v.shape[1]), np.empty(v.shape[1])
    for n in range(v.shape[0]):
        size = 0.0
        for k in range(v.shape[1]):
            size += v[n, k] ** 2
        if size == 0.0:
            velocity[n], exponent[n], error[n] = 0.0, 2.0, 0.0
            continue
        inner, outer, weight = rings.inner[n], rings.outer[n], rings.weight[n]
        gamma = _search(v[n], inner, outer, weight, start[n], EXPONENTS[0], EXPONENTS[-1])
        vf, ff = _project(v[n], inner, outer, weight, gamma, shape)
        plug_vf, plug_ff = _project(v[n], inner, outer, weight, np.inf, plug)
        if plug_vf**2 * ff >= (1.0 - TIE) * vf**2 * plug_ff:
            gamma, vf, ff = np.inf, plug_vf, plug_ff
            shape[:] = plug
        exponent[n] = gamma
        velocity[n] = vf / ff if np.isinf(gamma) else vf / ff * gamma / (gamma + 2.0)
        rest = 0.0
        for k in range(v.shape[1]):
            rest += (v[n, k] - vf / ff * shape[k]) ** 2
        error[n] = np.sqrt(rest / size)
