"""Sources and update of the Godunov scheme's x-sweep."""

import math

from solver.schemes.godunov.layout import Fields, Parameters, Workspace
from solver.schemes.vectorisation import exact_kernel, exact_part_of_kernel


@exact_kernel
def exponent_slopes(fields: Fields, work: Workspace, columns: int, width: int, dx: float) -> None:
    """∂_xγ: central in cells, (−4γ_b + 3γ_1 + γ_2)/(3Δx) beside an end, one-sided on it."""
    gamma, slope = fields.exponent, work.exponent_slope
    inner = slope[2 * width : (columns - 2) * width]
    left, right = gamma[width : (columns - 3) * width], gamma[3 * width : (columns - 1) * width]
    for k in range(inner.size):
        inner[k] = (right[k] - left[k]) * (0.5 / dx)
    end = (columns - 1) * width
    for k in range(width):
        b, c, d = gamma[k], gamma[width + k], gamma[2 * width + k]
        slope[k] = 2.0 * (c - b) / dx
        slope[width + k] = (-4.0 * b + 3.0 * c + d) / (3.0 * dx)
        b, c, d = gamma[end + k], gamma[end - width + k], gamma[end - 2 * width + k]
        slope[end + k] = 2.0 * (b - c) / dx
        slope[end - width + k] = (4.0 * b - 3.0 * c - d) / (3.0 * dx)


@exact_part_of_kernel
def momentum_source(
    A: float,
    Q: float,
    gamma: float,
    root: float,
    inverse_root: float,
    stiffness_slope: float,
    exponent_slope: float,
    parameters: Parameters,
) -> float:
    """s^x = −2(γ+2)(μ/ρ)Q/A + c_γ (Q²/A) ∂_xγ − A(√A − √A₀)/(ρA₀) ∂_xβ.

    c_γ = 1/(γ+1)², which makes ∂_x(αQ²/A) conservative; printed in the thesis, (5γ+4)/(2γ(γ+1)²).
    """
    u = Q * inverse_root * inverse_root
    if parameters.printed_gradient:
        gradient = (5.0 * gamma + 4.0) / (2.0 * gamma * (gamma + 1.0) * (gamma + 1.0))
    else:
        gradient = 1.0 / ((gamma + 1.0) * (gamma + 1.0))
    wall = A * (root - parameters.radius) / (parameters.density * parameters.radius * parameters.radius)
    friction = 2.0 * (gamma + 2.0) * parameters.kinematic_viscosity * u
    return gradient * Q * u * exponent_slope - friction - wall * stiffness_slope


@exact_kernel
def update(fields: Fields, work: Workspace, parameters: Parameters, begin: int, end: int, width: int) -> None:
    """Add fluctuations and sources of one step to the cells at flat places ``begin`` to ``end``."""
    A, Q = fields.area[begin:end], fields.flow[begin:end]
    gamma, slope = fields.exponent[begin:end], work.exponent_slope[begin:end]
    root, inverse_root = fields.root[begin:end], fields.inverse_root[begin:end]
    stiffness_slope = fields.stiffness_slope[begin:end]
    from_left_A = work.to_right_area[begin - width : end - width]
    from_left_Q = work.to_right_flow[begin - width : end - width]
    from_right_A, from_right_Q = work.to_left_area[begin:end], work.to_left_flow[begin:end]
    dt, courant = parameters.dt, parameters.dt / parameters.dx
    for k in range(A.size):
        source = momentum_source(
            A[k], Q[k], gamma[k], root[k], inverse_root[k], stiffness_slope[k], slope[k], parameters
        )
        A[k] -= courant * (from_left_A[k] + from_right_A[k])
        Q[k] += dt * source - courant * (from_left_Q[k] + from_right_Q[k])


@exact_kernel
def refresh(fields: Fields, work: Workspace) -> int:
    """Recompute √A, 1/√A and u everywhere; returns how many areas are not positive and finite."""
    A, Q, u = fields.area, fields.flow, work.velocity
    root, inverse_root = fields.root, fields.inverse_root
    collapsed = 0
    for k in range(A.size):
        collapsed += not A[k] > 0.0
        root[k] = math.sqrt(A[k])
        inverse_root[k] = 1.0 / root[k]
        u[k] = Q[k] * inverse_root[k] * inverse_root[k]
    return collapsed
