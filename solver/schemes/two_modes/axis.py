"""Momentum on the axis: D as an unknown of its own (numba kernel).

    ∂_tD + D ∂_xD = −(1/ρ) ∂_xP + 4ν mean_φ[(4u − 3D)/A]

is the Navier–Stokes equation on the axis for n = 2. What is prescribed comes in at a velocity or flow inlet,
with D = 2u; an end through which blood enters at a pressure knows no D of its own, and advects none.
"""

import numpy as np

from cases.arrays import Floats
from solver.schemes.layout import PRESSURE_INLET
from solver.schemes.vectorisation import kernel, summing_kernel

LOWER, MIDDLE, UPPER = 0, 1, 2


@kernel
def _beyond_upwind(axis: Floats, f: int, speed: float) -> float:
    """Fromm's difference minus the upwind one, one-sided where D leaves; 0 beside the end where it enters.

    Taken of the last iterate, it shrinks a sweep's error by half at least, whatever D Δt/Δx is.
    """
    last = axis.size - 1
    if speed > 0.0 and f > 1:
        if f == last:
            return float(0.5 * (axis[f] - 2.0 * axis[f - 1] + axis[f - 2]))
        return float(0.25 * (axis[f + 1] - axis[f] - axis[f - 1] + axis[f - 2]))
    if speed < 0.0 and f < last - 1:
        if f == 0:
            return float(-0.5 * (axis[f] - 2.0 * axis[f + 1] + axis[f + 2]))
        return float(-0.25 * (axis[f - 1] - axis[f] - axis[f + 1] + axis[f + 2]))
    return 0.0


@summing_kernel
def _friction_sums(
    f: int, theta: float, old_flow: Floats, new_flow: Floats, face_area: Floats
) -> tuple[float, float]:
    """Σ 1/A and Σ Q/A² of one face, Q θ-weighted."""
    relax, pull = 0.0, 0.0
    for j in range(new_flow.shape[1]):
        inverse = 1.0 / face_area[f, j + 1]
        relax += inverse
        pull += ((1.0 - theta) * old_flow[f, j] + theta * new_flow[f, j]) * inverse * inverse
    return relax, pull


@kernel
def axis_momentum(
    theta: float,
    carry: float,
    scale: float,
    old: Floats,
    advecting: Floats,
    drive: Floats,
    old_flow: Floats,
    new_flow: Floats,
    face_area: Floats,
    inlet_kind: int,
    inlet_velocity: float,
    matrix: Floats,
    right: Floats,
) -> None:
    """Balance of D on all faces, tridiagonal: into ``matrix`` (3, n_x + 1) and ``right`` (n_x + 1,).

    Parameters
    ----------
    theta, carry, scale : float
        θ, Δt/Δx, s/m, and Δt μ/ρ, m².
    old, advecting : ndarray (n_x + 1,)
        D of the old state, and the θ-weighted one of the last iterate, with which it is advected: upwind, and
        the rest of Fromm's difference of the last iterate.
    drive : ndarray (n_x + 1,)
        Δt/ρ ∂_xP, mean over φ.
    old_flow, new_flow : ndarray (n_x + 1, n_phi)
        Q.
    face_area : ndarray (n_x + 1, n_phi + 2)
        θ-weighted A.
    inlet_kind, inlet_velocity
        Kind and, unless that is a pressure, u there at the new time.
    """
    last, n = old.size - 1, new_flow.shape[1]
    lower, middle, upper = matrix[LOWER], matrix[MIDDLE], matrix[UPPER]
    for f in range(last + 1):
        relax, pull = _friction_sums(f, theta, old_flow, new_flow, face_area)
        relax *= 12.0 * scale / n
        lower[f], upper[f], middle[f] = 0.0, 0.0, 1.0 + theta * relax
        right[f] = old[f] - drive[f] + 16.0 * scale * pull / n - (1.0 - theta) * relax * old[f]
        speed = carry * advecting[f]
        if speed > 0.0 and f > 0:
            lower[f] = -theta * speed
            middle[f] += theta * speed
            right[f] -= (1.0 - theta) * speed * (old[f] - old[f - 1])
        elif speed < 0.0 and f < last:
            upper[f] = theta * speed
            middle[f] -= theta * speed
            right[f] -= (1.0 - theta) * speed * (old[f + 1] - old[f])
        right[f] -= speed * _beyond_upwind(advecting, f, speed)
    if inlet_kind != PRESSURE_INLET:
        lower[0], middle[0], upper[0], right[0] = 0.0, 1.0, 0.0, 2.0 * inlet_velocity


@kernel
def taken(solution: Floats, axis: Floats) -> tuple[float, float]:
    """Make the solution the iterate; norms of its change and of itself."""
    change, size = 0.0, 0.0
    for f in range(axis.size):
        change += (solution[f] - axis[f]) ** 2
        size += solution[f] ** 2
        axis[f] = solution[f]
    return np.sqrt(change), np.sqrt(size)
