"""The φ-sweep of the Godunov scheme: viscous exchange between rows, ∂_t Q = hQ (2.2.42)."""

import math

from cases.arrays import Floats
from solver.schemes.godunov.layout import Fields, Parameters
from solver.schemes.vectorisation import exact_kernel, exact_part_of_kernel

SERIES_LIMIT = 0.05  # below it the series of e^z up to z⁸ is exact to round-off


@exact_part_of_kernel
def exchange_exponent(
    A_below: float,
    A: float,
    A_above: float,
    gamma_below: float,
    gamma: float,
    gamma_above: float,
    inverse_A: float,
    half_over_dphi: float,
    printed: bool,
) -> float:
    """Return h/(2μ/ρ) with central differences in φ (2.2.44–45).

    h = 2(μ/ρ)(γ+2)/(γA) · [−(γ+2)/4 (∂_φA/A)² + ½ ∂²_φA/A − (2/γ³)(∂_φγ)² + ∂²_φγ/γ²]; the thesis
    prints one more term in the bracket, (γ−1)/γ² ∂_φγ ∂_φA/A, whose integral is zero.
    """
    inverse_gamma = 1.0 / gamma
    slope_A = (A_above - A_below) * half_over_dphi * inverse_A
    curvature_A = (A_above - 2.0 * A + A_below) * (4.0 * half_over_dphi * half_over_dphi) * inverse_A
    slope = (gamma_above - gamma_below) * half_over_dphi * inverse_gamma
    curvature = (gamma_above - 2.0 * gamma + gamma_below) * (4.0 * half_over_dphi * half_over_dphi)
    bracket = (
        0.5 * curvature_A
        - 0.25 * (gamma + 2.0) * slope_A * slope_A
        + inverse_gamma * (inverse_gamma * curvature - 2.0 * slope * slope)
    )
    if printed:
        bracket += (gamma - 1.0) * inverse_gamma * slope * slope_A
    return (1.0 + 2.0 * inverse_gamma) * inverse_A * bracket


@exact_part_of_kernel
def growth(z: float) -> float:
    """Return e^z for |z| below the series' limit."""
    tail = 1 / 24 + z * (1 / 120 + z * (1 / 720 + z * (1 / 5040 + z * (1 / 40320))))
    return 1 + z * (1 + z * (1 / 2 + z * (1 / 6 + z * tail)))


@exact_kernel
def exchange(fields: Fields, parameters: Parameters, rate: Floats, first: int, last: int) -> None:
    """Multiply Q by e^{hΔt} at the flat places ``first`` to ``last``; ``rate`` is scratch for hΔt."""
    n = last - first
    A_below, A = fields.area[first - 1 : last - 1], fields.area[first:last]
    A_above = fields.area[first + 1 : last + 1]
    gamma_below, gamma = fields.exponent[first - 1 : last - 1], fields.exponent[first:last]
    gamma_above = fields.exponent[first + 1 : last + 1]
    inverse_root, Q, z = fields.inverse_root[first:last], fields.flow[first:last], rate[first:last]
    scale = 2.0 * parameters.kinematic_viscosity * parameters.dt
    half_over_dphi, printed = 0.5 / parameters.dphi, parameters.printed_exchange
    large = 0
    for k in range(n):
        inverse_A = inverse_root[k] * inverse_root[k]
        z[k] = scale * exchange_exponent(
            A_below[k],
            A[k],
            A_above[k],
            gamma_below[k],
            gamma[k],
            gamma_above[k],
            inverse_A,
            half_over_dphi,
            printed,
        )
        large += not abs(z[k]) < SERIES_LIMIT
    if large:
        for k in range(n):
            Q[k] *= growth(z[k]) if abs(z[k]) < SERIES_LIMIT else math.exp(z[k])
    else:
        for k in range(n):
            Q[k] *= growth(z[k])
