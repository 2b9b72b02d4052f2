"""Velocity profiles on one face: u, the closure's D, α and the viscous source S (numba kernels)."""

from numba import njit

from solver.schemes.layout import REST_VELOCITY, Array


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"reassoc"})
def mean(values: Array) -> float:
    """Mean of a row; summed in an order that vectorises."""
    total = 0.0
    for j in range(values.size):
        total += values[j]
    return total / values.size


@njit(cache=True, nogil=True, error_model="numpy")
def wrap(row: Array) -> None:
    """Fill the two ghosts of a periodic row."""
    row[0] = row[row.size - 2]
    row[row.size - 1] = row[1]


@njit(cache=True, nogil=True, error_model="numpy")
def all_admissible(velocity: Array, axis_velocity: float) -> bool:
    """Whether 0 < u/D < 1 in every row, so that γ = 2u/(D − u) is positive."""
    d = abs(axis_velocity)
    sign = 1.0 if axis_velocity > 0.0 else -1.0
    count = 0
    for j in range(velocity.size):
        u = sign * velocity[j]
        count += (u > 0.0) & (u < d)
    return count == velocity.size


@njit(cache=True, nogil=True, error_model="numpy")
def at_rest(velocity: Array) -> bool:
    """Whether every row is slower than the rest velocity."""
    count = 0
    for j in range(velocity.size):
        count += abs(velocity[j]) < REST_VELOCITY
    return count == velocity.size


@njit(cache=True, nogil=True, error_model="numpy")
def inadmissible_row(velocity: Array, axis_velocity: float) -> int:
    """First row with |u| ≥ |D| or u against D."""
    for j in range(velocity.size):
        if not 0.0 < velocity[j] / axis_velocity < 1.0:
            return j
    return 0


@njit(cache=True, nogil=True, error_model="numpy")
def closure_source(
    alpha: Array,
    damping: Array,
    area: Array,
    inverse_area: Array,
    velocity: Array,
    axis_velocity: float,
    inverse_exponent: Array,
    scale: float,
    dphi: float,
) -> None:
    """α and Δt S of one face from u and D: γ = 2u/(D−u), h as in model.md with 1/γ differenced.

    With g = 1/γ = (D−u)/(2u) the last two terms of h are −∂²_φ g; γ + 2 = 2D/(D−u) and
    (γ+2)/γ = D/u. ``area`` and ``inverse_exponent`` have ghosts; ``scale`` is Δt μ/ρ.
    """
    d = axis_velocity
    g_here = inverse_exponent[1:-1]
    for j in range(velocity.size):
        g_here[j] = 0.5 * d / velocity[j] - 0.5
    wrap(inverse_exponent)
    first = 0.5 / dphi
    second = 1.0 / (dphi * dphi)
    area_before, area_here, area_after = area[:-2], area[1:-1], area[2:]
    g_before, g_after = inverse_exponent[:-2], inverse_exponent[2:]
    for j in range(velocity.size):
        u = velocity[j]
        both = d / ((d - u) * (d + u))
        alpha[j] = 2.0 * both * (d - u)
        half_gamma_plus_one = both * (d + u)
        slope = (area_after[j] - area_before[j]) * first * inverse_area[j]
        bend = (area_after[j] - 2.0 * area_here[j] + area_before[j]) * second * inverse_area[j]
        g_bend = (g_after[j] - 2.0 * g_here[j] + g_before[j]) * second
        bracket = 0.5 * bend - 0.5 * half_gamma_plus_one * slope * slope - g_bend
        damping[j] = scale * inverse_area[j] * ((2.0 + 4.0 * g_here[j]) * bracket - 4.0 * half_gamma_plus_one)


@njit(cache=True, nogil=True, error_model="numpy")
def fixed_source(alpha: Array, damping: Array, inverse_area: Array, exponent: float, scale: float) -> None:
    """α and Δt S of one face for a given γ, friction only: at rest, and for the 1D model."""
    for j in range(alpha.size):
        alpha[j] = (exponent + 2.0) / (exponent + 1.0)
        damping[j] = -2.0 * (exponent + 2.0) * scale * inverse_area[j]
