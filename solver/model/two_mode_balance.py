"""Energy and speeds of one state with profiles of two modes, for diagnostics.

As :mod:`solver.schemes.rows.balance`, with M = 2∫v²y dy for αu² and the viscous terms of
:mod:`solver.schemes.two_modes.profiles`: multiplied by u, the momentum equation leaves what friction and
exchange take, and what the profile's shape takes, ρu ∂_x[(M − u²)A].
"""

import numpy as np

from cases.arrays import Floats
from solver.model.profiles import TwoModes
from solver.schemes.rows.balance import Balance
from solver.schemes.two_modes.layout import Modes
from solver.schemes.two_modes.profiles import viscous_terms


def kernel_modes(two_modes: TwoModes) -> Modes:
    """Modes in the kernels' numbers."""
    slope, momentum = two_modes.wall_slope[1], two_modes.closure == "axis_momentum"
    return Modes(
        float(two_modes.base_exponent), float(two_modes.share), *two_modes.momentum, float(slope), momentum
    )


def two_mode_balance(
    two_modes: TwoModes,
    area: Floats,
    flow: Floats,
    axis_velocity: Floats,
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
    two_modes : TwoModes
    area, flow, pressure : ndarray (n_x + 2, n_phi)
        A, m²; Q, m³/s; P, Pa, on inlet, cells and outlet.
    axis_velocity : ndarray (n_x + 2,)
        D, m/s.
    area_slope : ndarray (n_x, n_phi)
        dA/dP in cells, m²/Pa.
    density, viscosity : float
        ρ, kg/m³; μ, Pa s.
    dx, dphi : float
        m, rad.
    """
    u, d = flow / area, axis_velocity[:, None]
    uu, ud, dd = two_modes.momentum
    excess = area * ((uu - 1.0) * u**2 + ud * u * d + dd * d**2)
    change = np.empty(excess[1:-1].shape)  # over each cell; the ends' columns lie on the faces
    edges = np.concatenate([excess[:1], 0.5 * (excess[1:-2] + excess[2:-1]), excess[-1:]])
    change[:] = np.diff(edges, axis=0)
    lost = _viscous_terms(two_modes, u, area, axis_velocity, viscosity / density, dphi)
    inner, slope = np.s_[1:-1], 2.0 * uu * u[1:-1] + ud * d[1:-1]
    rest_wave = area[inner] / (density * area_slope)
    root = np.sqrt(0.25 * slope**2 + dd * d[inner] ** 2 - uu * u[inner] ** 2 + rest_wave)
    ends = np.sum((pressure + 0.5 * density * u**2) * flow, axis=1)
    sector = 0.5 * dphi
    return Balance(
        kinetic=float(0.5 * density * sector * dx * np.sum(u[inner] * flow[inner])),
        end_power=float(sector * (ends[0] - ends[-1])),
        dissipated=float(-density * sector * dx * np.sum(u[inner] * lost[inner])),
        profile_power=float(density * sector * np.sum(u[inner] * change)),
        fastest_wave=float(np.max(0.5 * np.abs(slope) + root)),
        fastest_flow=float(np.max(np.abs(u[inner]))),
        axis_gap=0.0,  # one D for all rows
    )


def _viscous_terms(
    two_modes: TwoModes, u: Floats, area: Floats, axis_velocity: Floats, nu: float, dphi: float
) -> Floats:
    """Friction and exchange around, m³/s², (columns, n_phi)."""
    wide, across = (np.concatenate([part[:, -1:], part, part[:, :1]], axis=1) for part in (u, area))
    damping, excess = np.empty(u.shape), np.empty(u.shape)
    around = np.empty((4, u.shape[1] + 2))
    viscous_terms(kernel_modes(two_modes), wide, across, axis_velocity, nu, dphi, around, damping, excess)
    return np.asarray(damping * u * area + excess)
