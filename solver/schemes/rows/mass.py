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
    n, kept, flat, result = held.shape[1], held.flat, flow.flat, area.flat
    for k in range(held.size):
        result[k] = kept[k] - c * (flat[k + n] - flat[k])


@kernel
def hold_area(area: Floats, flow: Floats, explicit: float, held: Floats) -> None:
    """Take A less the old flows' share, what A' would be if Q' were 0; ``explicit`` is (1−θ)Δt/Δx."""
    n, old, flat, result = held.shape[1], area.flat, flow.flat, held.flat
    for k in range(area.size):
        result[k] = old[k] - explicit * (flat[k + n] - flat[k])


@kernel
def _eliminate_one_row(
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
    """Do as :func:`eliminate` for one row, whose pivots wait for each other: all else comes before."""
    for i in range(rhs.size):
        rhs[i, 0] = held[i, 0] - area[i, 0] - c * (flow[i + 1, 0] - flow[i, 0])
        inverse_pivot[i, 0] = slope[i, 0] + c * (conductance[i, 0] + conductance[i + 1, 0])
    coupling = c * conductance[1, 0]
    inverse = 1.0 / (inverse_pivot[0, 0] - c * inlet_slopes[0] * slope[0, 0])
    inverse_pivot[0, 0], known = inverse, rhs[0, 0]
    inverse_pivot[1, 0] -= coupling * inverse * c * inlet_slopes[1] * slope[1, 0]
    for i in range(1, rhs.size):
        coupling = c * conductance[i, 0]
        known = rhs[i, 0] + coupling * inverse * known
        inverse = 1.0 / (inverse_pivot[i, 0] - coupling * coupling * inverse)
        rhs[i, 0], inverse_pivot[i, 0] = known, inverse


@kernel
def _substitute_one_row(
    c: float,
    inlet_slope: float,
    slope: Floats,
    inverse_pivot: Floats,
    conductance: Floats,
    correction: Floats,
    flow: Floats,
) -> None:
    """Do as :func:`substitute` for one row but for the inlet's flow; ``inverse_pivot`` is overwritten."""
    last = correction.size - 1
    first = c * (conductance[1, 0] + inlet_slope * slope[1, 0]) * inverse_pivot[0, 0]
    for i in range(last):
        correction[i, 0] *= inverse_pivot[i, 0]
        inverse_pivot[i, 0] *= c * conductance[i + 1, 0]
    inverse_pivot[0, 0] = first
    below = correction[last, 0]
    for i in range(last - 1, -1, -1):
        below = correction[i, 0] + inverse_pivot[i, 0] * below
        correction[i, 0] = below
    for i in range(last):
        flow[i + 1, 0] -= conductance[i + 1, 0] * (correction[i + 1, 0] - correction[i, 0])


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
    if n_phi == 1:
        _eliminate_one_row(c, inlet_slopes, held, area, slope, flow, conductance, rhs, inverse_pivot)
        return
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
    if n_phi == 1:
        _substitute_one_row(c, inlet_slopes[1], slope, inverse_pivot, conductance, correction, flow)
    else:
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
    change, size, found, taken = 0.0, 0.0, new.flat, iterate.flat
    for k in range(new.size):
        difference = found[k] - taken[k]
        change += difference * difference
        size += found[k] * found[k]
        taken[k] = found[k]
    return float(np.sqrt(change / new.size)), float(np.sqrt(size / new.size))


@summing_kernel
def accept_pressure(correction: Floats, iterate: Floats) -> tuple[float, float]:
    """Take P' as the iterate; root mean squares of its change and of itself."""
    change, size, found, taken = 0.0, 0.0, correction.flat, iterate.flat
    for k in range(correction.size):
        new = taken[k] + found[k]
        change += found[k] * found[k]
        size += new * new
        taken[k] = new
    return float(np.sqrt(change / iterate.size)), float(np.sqrt(size / iterate.size))
