"""Newton's method for P on the mass balance of the cells: one tridiagonal system in each row (numba kernels).

    A(P') + c (Q'_{f+1} − Q'_f) = held,   Q'_f = G_f − κ_f (δP_f − δP_{f−1}),   c = θ Δt/Δx

The matrix is symmetric but for its first row, where Q' = vA' at a velocity inlet.
"""

import numpy as np

from cases.arrays import Floats
from solver.schemes.vectorisation import kernel, summing_kernel


@kernel
def release_area(held: Floats, flow: Floats, c: float, area: Floats) -> None:
    """Find A' by the mass balance from the held area and Q'; ``c`` is θΔt/Δx."""
    for i in range(held.shape[0]):
        for j in range(held.shape[1]):
            area[i, j] = held[i, j] - c * (flow[i + 1, j] - flow[i, j])


@kernel
def hold_area(area: Floats, flow: Floats, explicit: float, held: Floats) -> None:
    """Take A less the old flows' share, what A' would be if Q' were 0; ``explicit`` is (1−θ)Δt/Δx."""
    for i in range(held.shape[0]):
        for j in range(held.shape[1]):
            held[i, j] = area[i, j] - explicit * (flow[i + 1, j] - flow[i, j])


@kernel
def eliminate(
    c: float,
    inlet_slopes: tuple[float, float],
    held: Floats,
    area: Floats,
    slope: Floats,
    flow: Floats,
    conductance: Floats,
    rhs: Floats,
    inverse_pivot: Floats,
) -> None:
    """Residual of the mass balance and its forward elimination: right-hand sides and 1/pivot.

    Parameters
    ----------
    c : float
        θΔt/Δx, s/m.
    inlet_slopes : tuple of float
        ∂Q'/∂A of the inlet with the first two cells' areas, m/s.
    held, area, slope : ndarray (n_x, n_phi)
        What A' would be without Q', and A (m²) and dA/dP (m²/Pa) of the iterate.
    flow, conductance : ndarray (n_x + 1, n_phi)
        G (m³/s) and κ (m³/(s Pa)).
    rhs, inverse_pivot : ndarray (n_x, n_phi)
        Results.
    """
    n_x, n_phi = rhs.shape
    for j in range(n_phi):
        rhs[0, j] = held[0, j] - area[0, j] - c * (flow[1, j] - flow[0, j])
        own = (1.0 - c * inlet_slopes[0]) * slope[0, j]
        inverse_pivot[0, j] = 1.0 / (own + c * (conductance[0, j] + conductance[1, j]))
    for i in range(1, n_x):
        skew = c * inlet_slopes[1] if i == 1 else 0.0
        for j in range(n_phi):
            coupling = c * conductance[i, j]
            factor = coupling * inverse_pivot[i - 1, j]
            residual = held[i, j] - area[i, j] - c * (flow[i + 1, j] - flow[i, j])
            rhs[i, j] = residual + factor * rhs[i - 1, j]
            own = (1.0 - factor * skew) * slope[i, j]
            inverse_pivot[i, j] = 1.0 / (own + coupling - factor * coupling + c * conductance[i + 1, j])


@kernel
def substitute(
    c: float,
    inlet_slopes: tuple[float, float],
    slope: Floats,
    inverse_pivot: Floats,
    conductance: Floats,
    correction: Floats,
    flow: Floats,
) -> None:
    """Back substitution from the closed last cell: δP = P' − P in every cell, and G becomes Q'.

    Arguments as :func:`eliminate`; ``correction`` holds the right-hand sides before. The outlet's flow
    is closed already.
    """
    n_x, n_phi = correction.shape
    for i in range(n_x - 2, -1, -1):
        skew = inlet_slopes[1] if i == 0 else 0.0
        for j in range(n_phi):
            upper = conductance[i + 1, j] + skew * slope[1, j]
            below = correction[i + 1, j]
            here = (correction[i, j] + c * upper * below) * inverse_pivot[i, j]
            flow[i + 1, j] -= conductance[i + 1, j] * (below - here)
            correction[i, j] = here
    for j in range(n_phi):
        change = inlet_slopes[0] * slope[0, j] * correction[0, j]
        change += inlet_slopes[1] * slope[1, j] * correction[1, j]
        flow[0, j] += change - conductance[0, j] * correction[0, j]


@summing_kernel
def accept_flow(new: Floats, iterate: Floats) -> tuple[float, float]:
    """Take Q' as the iterate; root mean squares of its change and of itself."""
    change, size = 0.0, 0.0
    for i in range(new.shape[0]):
        for j in range(new.shape[1]):
            difference = new[i, j] - iterate[i, j]
            change += difference * difference
            size += new[i, j] * new[i, j]
            iterate[i, j] = new[i, j]
    return float(np.sqrt(change / new.size)), float(np.sqrt(size / new.size))


@summing_kernel
def accept_pressure(correction: Floats, iterate: Floats) -> tuple[float, float]:
    """Take P' as the iterate; root mean squares of its change and of itself."""
    change, size = 0.0, 0.0
    for i in range(iterate.shape[0]):
        for j in range(iterate.shape[1]):
            new = iterate[i, j] + correction[i, j]
            change += correction[i, j] * correction[i, j]
            size += new * new
            iterate[i, j] = new
    return float(np.sqrt(change / iterate.size)), float(np.sqrt(size / iterate.size))
