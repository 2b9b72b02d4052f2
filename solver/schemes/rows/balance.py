"""Energy, speeds and the continuity condition of one state, for diagnostics (numba kernel).

Multiplied by u = Q/A, the momentum equation (2.2.34) gives, with (2.2.33), the balance of mechanical energy
per sector and length

    ∂_t(½ρuQ + ∫P dA) + ∂_x[(P + ½ρu²) Q] = ρSuQ − ρu ∂_x[(α−1)uQ],    S = h − 2(γ+2)(μ/ρ)/A

whose right side is what friction and viscous exchange take and what the profile's shape takes.
Columns are laid out as inlet, cells 1 … n_x, outlet.
"""

from typing import NamedTuple

import numpy as np

from cases.arrays import Floats
from solver.schemes.layout import REST_VELOCITY
from solver.schemes.vectorisation import exact_allocating_kernel, exact_kernel, summing_kernel


class Balance(NamedTuple):
    """Sums and extremes over the artery.

    ``kinetic`` ½∮∫½ρuQ dx dφ, J; ``end_power`` ½∮(P + ½ρu²)Q dφ of the inlet minus that of the outlet, W;
    ``dissipated`` −½∮∫ρSuQ dx dφ, W; ``profile_power`` ½∮∫ρu ∂_x[(α−1)uQ] dx dφ, W; ``fastest_wave``
    largest |λ±|, m/s; ``fastest_flow`` max|u|, m/s; ``axis_gap`` largest relative distance of
    (γ+2)/γ u from its section's mean.
    """

    kinetic: float
    end_power: float
    dissipated: float
    profile_power: float
    fastest_wave: float
    fastest_flow: float
    axis_gap: float


@exact_kernel
def _end_power(area: Floats, flow: Floats, pressure: Floats, density: float) -> float:
    """∑(P + ½ρu²)Q of one column."""
    total = 0.0
    for j in range(flow.size):
        u = flow[j] / area[j]
        total += (pressure[j] + 0.5 * density * u * u) * flow[j]
    return total


@exact_kernel
def _excess(area: Floats, flow: Floats, exponent: Floats, result: Floats) -> None:
    """(α−1)uQ with α − 1 = 1/(γ+1)."""
    for j in range(flow.size):
        result[j] = flow[j] * flow[j] / (area[j] * (exponent[j] + 1.0))


@summing_kernel
def _section(
    area: Floats, flow: Floats, exponent: Floats, nu: float, dphi: float, gap: Floats, wide: Floats
) -> tuple[float, float]:
    """∑ uQ and −∑ SuQ of one section; leaves (γ+2)/γ u in ``gap``; ``wide`` (2, n_phi + 2) is scratch."""
    n = flow.size
    A, g = wide[0], wide[1]
    for j in range(n):
        A[j + 1] = area[j]
        g[j + 1] = 1.0 / exponent[j]
    for row in (A, g):
        row[0] = row[n]
        row[n + 1] = row[1]
    over_two, over_square = 0.5 / dphi, 1.0 / (dphi * dphi)
    carried, lost = 0.0, 0.0
    for j in range(n):
        inverse = 1.0 / area[j]
        u = flow[j] * inverse
        slope = (A[j + 2] - A[j]) * over_two * inverse
        bend = (A[j + 2] - 2.0 * A[j + 1] + A[j]) * over_square * inverse
        g_bend = (g[j + 2] - 2.0 * g[j + 1] + g[j]) * over_square
        both = exponent[j] + 2.0
        bracket = 0.5 * bend - 0.25 * both * slope * slope - g_bend
        axis = both * g[j + 1]
        carried += u * flow[j]
        lost += 2.0 * nu * u * u * (both - axis * bracket)
        gap[j] = axis * u
    return carried, lost


@exact_kernel
def _gap_of(axis: Floats) -> float:
    """Largest distance from the mean over the mean; 0 at rest."""
    mean = float(np.mean(axis))
    if abs(mean) < REST_VELOCITY:
        return 0.0
    for j in range(axis.size):
        axis[j] = abs(axis[j] - mean)
    return _largest(axis) / abs(mean)


@exact_kernel
def _largest(values: Floats) -> float:
    largest = values[0]
    for j in range(1, values.size):
        largest = max(largest, values[j])
    return float(largest)


@exact_kernel
def _speeds(
    area: Floats, flow: Floats, exponent: Floats, slope: Floats, density: float, wave: Floats, stream: Floats
) -> None:
    """Largest |λ±| and |u| of each row."""
    for j in range(flow.size):
        u = flow[j] / area[j]
        excess = 1.0 / (exponent[j] + 1.0)
        drift = (1.0 + excess) * u
        wave[j] = abs(drift) + np.sqrt(area[j] / (density * slope[j]) + drift * u * excess)
        stream[j] = abs(u)


@summing_kernel
def _shape_power(
    area: Floats, flow: Floats, excess: tuple[Floats, Floats, Floats], before: float, after: float
) -> float:
    """∑ u × difference of (α−1)uQ over the cell, from it and its neighbours' weights."""
    left, here, right = excess
    total = 0.0
    for j in range(flow.size):
        change = after * (right[j] - here[j]) + before * (here[j] - left[j])
        total += flow[j] / area[j] * change
    return total


@exact_allocating_kernel
def closed_exponents(area: Floats, flow: Floats, exponent: Floats) -> None:
    """γ = 2u/(D − u), D = 2 mean_φ(u), of columns; 2 at rest, NaN where none is admissible."""
    u = np.empty(area.shape[1])
    for i in range(area.shape[0]):
        fastest = 0.0
        for j in range(u.size):
            u[j] = flow[i, j] / area[i, j]
        for j in range(u.size):
            fastest = max(fastest, abs(u[j]))
        d, gamma = 2.0 * np.mean(u), exponent[i]
        if fastest < REST_VELOCITY:
            gamma[:] = 2.0
            continue
        for j in range(u.size):
            gamma[j] = 2.0 * u[j] / (d - u[j])
        for j in range(u.size):
            if not u[j] * (d - u[j]) > 0.0:
                gamma[j] = np.nan


@summing_kernel
def linear_wall(
    area: Floats, stiffness: Floats, radius: float, reference_pressure: float, slope: Floats
) -> float:
    """∑ ∫P dA of P = P₀ + β(R − R₀)/R₀² from R₀² to A, J/m per ½dφ; leaves dA/dP in ``slope``."""
    rest, total = radius * radius, 0.0
    for i in range(area.shape[0]):
        A, beta, dA_dP = area[i], stiffness[i], slope[i]
        for j in range(A.size):
            R = np.sqrt(A[j])
            stretch = R - radius
            dA_dP[j] = 2.0 * rest * R / beta[j]
            total += reference_pressure * (A[j] - rest)
            total += beta[j] / rest * stretch * stretch * (2.0 / 3.0 * stretch + radius)
    return total


@exact_allocating_kernel
def balance(
    area: Floats,
    flow: Floats,
    exponent: Floats,
    pressure: Floats,
    area_slope: Floats,
    density: float,
    viscosity: float,
    dx: float,
    dphi: float,
) -> Balance:
    """Return the balance of one state.

    Parameters
    ----------
    area, flow, exponent, pressure : ndarray (n_x + 2, n_phi)
        A, m²; Q, m³/s; γ; P, Pa.
    area_slope : ndarray (n_x, n_phi)
        dA/dP in cells, m²/Pa.
    density, viscosity : float
        ρ, kg/m³; μ, Pa s.
    dx, dphi : float
        m, rad.
    """
    columns, n = area.shape
    wide, axis, stream = np.empty((2, n + 2)), np.empty(n), np.empty(n)
    left, here, right = np.empty(n), np.empty(n), np.empty(n)
    carried, lost, shaped, wave, flowing, gap = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    _excess(area[0], flow[0], exponent[0], left)
    _excess(area[1], flow[1], exponent[1], here)
    for i in range(1, columns - 1):
        one, two = _section(area[i], flow[i], exponent[i], viscosity / density, dphi, axis, wide)
        carried += one
        lost += two
        gap = max(gap, _gap_of(axis))
        _excess(area[i + 1], flow[i + 1], exponent[i + 1], right)
        before = 1.0 if i == 1 else 0.5  # the ends' columns lie on the faces
        after = 1.0 if i == columns - 2 else 0.5
        shaped += _shape_power(area[i], flow[i], (left, here, right), before, after)
        _speeds(area[i], flow[i], exponent[i], area_slope[i - 1], density, axis, stream)
        wave, flowing = max(wave, _largest(axis)), max(flowing, _largest(stream))
        left, here, right = here, right, left
    ends = _end_power(area[0], flow[0], pressure[0], density)
    ends -= _end_power(area[-1], flow[-1], pressure[-1], density)
    sector = 0.5 * dphi
    return Balance(
        0.5 * density * sector * dx * carried,
        sector * ends,
        density * sector * dx * lost,
        density * sector * shaped,
        wave,
        flowing,
        gap,
    )
