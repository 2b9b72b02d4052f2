"""Staggered, pressure-implicit scheme on (x, φ): numba kernels.

After Casulli, Dumbser & Toro (2012), "Semi-implicit numerical modeling of axially symmetric flows in
compliant arterial systems". A and P live at cell centres, Q, u, γ and α on faces; face f lies left of
cell f, face 0 is the inlet and face n_x the outlet. All arrays are float64 in SI, φ is contiguous.

One step solves, with θ the implicitness and coefficients at the θ-weighted mean of old state and
iterate (marked ¯),

    (A' − A)/Δt + ∂_x[θQ' + (1−θ)Q] = 0                                                (2.2.33)
    (Q' − Q)/Δt + ∂_x(αQ²/A)¯ + (Ā/ρ) ∂_x[θP' + (1−θ)P] = S̄ [θQ' + (1−θ)Q]             (2.2.34)
    S = h(A, γ) − 2(γ+2)(μ/ρ)/A,   γ = 2u/(D − u),   D = 2 mean_φ(u)                   (2.2.35)

by Newton's method in P on the mass balance, which is tridiagonal in each row.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

OK = 0
NO_ADMISSIBLE_PROFILE = 1
WALL_COLLAPSE = 2
NOT_CONVERGED = 3
NOT_FINITE = 4

REST_VELOCITY = 1e-9  # m/s: a section slower than this is at rest and has γ = 2

Array = NDArray[np.float64]


class Parameters(NamedTuple):
    """Constants of a run (SI).

    ``compliance`` is dR/dP = R₀²/β, (n_x, n_phi), m/Pa; ``kinematic_viscosity`` μ/ρ, m²/s.
    """

    dx: float
    dphi: float
    radius: float
    density: float
    kinematic_viscosity: float
    reference_pressure: float
    compliance: Array
    resistance: float
    offset: float
    outlet_by_section: bool


class Stepping(NamedTuple):
    """Δt (s), implicitness θ in [½, 1], relative tolerance and most sweeps of a step's iteration."""

    time_step: float
    theta: float
    tolerance: float
    max_sweeps: int


class Workspace(NamedTuple):
    """Arrays of one run; (n_x, n_phi) at cells, (n_x + 1, n_phi) on faces, (n_phi,) per row."""

    pressure: Array  # cells: P at the old time
    iterate_pressure: Array  # cells: P of the iterate
    iterate_area: Array  # cells
    area_slope: Array  # cells: dA/dP of the iterate
    mean_area: Array  # cells: θ-weighted
    momentum_flux: Array  # cells: αQ²/A
    correction: Array  # cells: P' − P of the iterate
    diagonal: Array  # cells: pivots of the elimination
    iterate_flow: Array  # faces
    alpha: Array  # faces
    source: Array  # faces: S
    explicit_flow: Array  # faces: G at the iterate's pressure
    conductance: Array  # faces: κ
    outlet_pressure: Array  # rows: old time
    iterate_outlet_pressure: Array  # rows
    outlet_area: Array  # rows: θ-weighted
    face_area: Array  # n_phi + 2: one face, with periodic ghosts
    inverse_exponent: Array  # n_phi + 2: 1/γ of one face, with periodic ghosts
    inverse_area: Array  # rows: 1/A of one face
    face_velocity: Array  # rows: u of one face
    previous_pressure: Array  # cells: P one step earlier, for the first iterate
    previous_flow: Array  # faces
    exchanged: Array  # volumes that passed inlet and outlet since last reset, m³


def workspace(n_x: int, n_phi: int) -> Workspace:
    """Allocate the arrays of a run."""
    cells, faces, rows = (n_x, n_phi), (n_x + 1, n_phi), (n_phi,)
    shapes = [cells] * 8 + [faces] * 5 + [rows] * 3 + [(n_phi + 2,)] * 2 + [rows] * 2 + [cells, faces, (2,)]
    return Workspace(*(np.zeros(shape) for shape in shapes))


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"reassoc"})
def _mean(values: Array) -> float:
    total = 0.0
    for j in range(values.size):
        total += values[j]
    return total / values.size


@njit(cache=True, nogil=True, error_model="numpy")
def _all_admissible(velocity: Array, axis_velocity: float) -> bool:
    """Whether 0 < u/D < 1 in every row, so that γ = 2u/(D − u) is positive."""
    d = abs(axis_velocity)
    sign = 1.0 if axis_velocity > 0.0 else -1.0
    count = 0
    for j in range(velocity.size):
        u = sign * velocity[j]
        count += (u > 0.0) & (u < d)
    return count == velocity.size


@njit(cache=True, nogil=True, error_model="numpy")
def _at_rest(velocity: Array) -> bool:
    """Whether every row is slower than the rest velocity."""
    count = 0
    for j in range(velocity.size):
        count += abs(velocity[j]) < REST_VELOCITY
    return count == velocity.size


@njit(cache=True, nogil=True, error_model="numpy")
def _wrap(row: Array) -> None:
    """Fill the two ghosts of a periodic row."""
    row[0] = row[row.size - 2]
    row[row.size - 1] = row[1]


@njit(cache=True, nogil=True, error_model="numpy")
def _face_area(f: int, mean: Array, outlet_area: Array, area: Array) -> None:
    """Mean area of face f with ghosts: the inlet's extrapolated, the outlet's from its pressure."""
    n_x, n_phi = mean.shape
    inner = area[1:-1]
    if f == n_x:
        inner[:] = outlet_area
    else:
        left, right = mean[max(f - 1, 0)], mean[f]
        second = mean[1]
        for j in range(n_phi):
            inner[j] = 0.5 * (left[j] + right[j])
        if f == 0:
            for j in range(n_phi):
                inner[j] += 0.5 * (right[j] - second[j])
    _wrap(area)


@njit(cache=True, nogil=True, error_model="numpy")
def _face_velocity(
    old: Array, new: Array, theta: float, area: Array, inverse_area: Array, velocity: Array
) -> None:
    """Mean velocity u = Q/A of one face at the θ-weighted mean."""
    inner = area[1:-1]
    for j in range(velocity.size):
        inverse_area[j] = 1.0 / inner[j]
        velocity[j] = ((1.0 - theta) * old[j] + theta * new[j]) * inverse_area[j]


@njit(cache=True, nogil=True, error_model="numpy")
def _profile_source(
    alpha: Array,
    source: Array,
    area: Array,
    inverse_area: Array,
    velocity: Array,
    axis_velocity: float,
    inverse_exponent: Array,
    nu: float,
    dphi: float,
) -> None:
    """α and S of one face from u and D: γ = 2u/(D−u), h as in model.md with 1/γ differenced.

    With g = 1/γ = (D−u)/(2u) the last two terms of h are −∂²_φ g; γ + 2 = 2D/(D−u) and
    (γ+2)/γ = D/u.
    """
    d = axis_velocity
    inverse_inner = inverse_exponent[1:-1]
    for j in range(velocity.size):
        inverse_inner[j] = 0.5 * d / velocity[j] - 0.5
    _wrap(inverse_exponent)
    first = 0.5 / dphi
    second = 1.0 / (dphi * dphi)
    area_before, area_here, area_after = area[:-2], area[1:-1], area[2:]
    g_before, g_here, g_after = inverse_exponent[:-2], inverse_inner, inverse_exponent[2:]
    for j in range(velocity.size):
        u = velocity[j]
        both = d / ((d - u) * (d + u))
        alpha[j] = 2.0 * both * (d - u)
        half_gamma_plus_one = both * (d + u)
        slope = (area_after[j] - area_before[j]) * first * inverse_area[j]
        bend = (area_after[j] - 2.0 * area_here[j] + area_before[j]) * second * inverse_area[j]
        g_bend = (g_after[j] - 2.0 * g_here[j] + g_before[j]) * second
        bracket = 0.5 * bend - 0.5 * half_gamma_plus_one * slope * slope - g_bend
        source[j] = nu * inverse_area[j] * ((2.0 + 4.0 * g_here[j]) * bracket - 4.0 * half_gamma_plus_one)


@njit(cache=True, nogil=True, error_model="numpy")
def _rest_source(alpha: Array, source: Array, inverse_area: Array, nu: float) -> None:
    """α and S of a face at rest: γ = 2, friction only."""
    for j in range(alpha.size):
        alpha[j] = 4.0 / 3.0
        source[j] = -8.0 * nu * inverse_area[j]


@njit(cache=True, nogil=True, error_model="numpy")
def _inadmissible_row(velocity: Array, axis_velocity: float) -> int:
    """First row with |u| ≥ |D| or u against D."""
    for j in range(velocity.size):
        if not 0.0 < velocity[j] / axis_velocity < 1.0:
            return j
    return 0


@njit(cache=True, nogil=True, error_model="numpy")
def _coefficients(p: Parameters, ws: Workspace, flow: Array, theta: float) -> tuple[int, int, int]:
    """α and S on every face at the θ-weighted mean; the failure (status, i, j) if there is one."""
    n_x = ws.mean_area.shape[0]
    velocity = ws.face_velocity
    nu = p.kinematic_viscosity
    for f in range(n_x + 1):
        area, inverse_area = ws.face_area, ws.inverse_area
        _face_area(f, ws.mean_area, ws.outlet_area, area)
        _face_velocity(flow[f], ws.iterate_flow[f], theta, area, inverse_area, velocity)
        d = 2.0 * _mean(velocity)
        if _at_rest(velocity):
            _rest_source(ws.alpha[f], ws.source[f], inverse_area, nu)
            continue
        if not _all_admissible(velocity, d):
            return NO_ADMISSIBLE_PROFILE, min(f, n_x - 1), _inadmissible_row(velocity, d)
        _profile_source(
            ws.alpha[f], ws.source[f], area, inverse_area, velocity, d, ws.inverse_exponent, nu, p.dphi
        )
    return OK, 0, 0


@njit(cache=True, nogil=True, error_model="numpy")
def _wall(
    p: Parameters, ws: Workspace, area: Array, outlet_area: Array, theta: float
) -> tuple[int, int, int]:
    """A(P) and dA/dP of the iterate, and θ-weighted means; the failing cell if the lumen collapses."""
    n_x, n_phi = area.shape
    for i in range(n_x):
        for j in range(n_phi):
            radius = p.radius + (ws.iterate_pressure[i, j] - p.reference_pressure) * p.compliance[i, j]
            ws.area_slope[i, j] = 2.0 * radius * p.compliance[i, j]
            ws.iterate_area[i, j] = radius * radius
            ws.mean_area[i, j] = (1.0 - theta) * area[i, j] + theta * radius * radius
        for j in range(n_phi):
            if not ws.area_slope[i, j] > 0.0:
                return WALL_COLLAPSE, i, j
    for j in range(n_phi):
        pressure = ws.iterate_outlet_pressure[j] - p.reference_pressure
        radius = p.radius + pressure * p.compliance[n_x - 1, j]
        if not radius > 0.0:
            return WALL_COLLAPSE, n_x - 1, j
        ws.outlet_area[j] = (1.0 - theta) * outlet_area[j] + theta * radius * radius
    return OK, 0, 0


@njit(cache=True, nogil=True, error_model="numpy")
def _momentum_flux(ws: Workspace, flow: Array, theta: float) -> None:
    """αQ²/A at cell centres from the two faces."""
    n_x, n_phi = ws.mean_area.shape
    for i in range(n_x):
        old_left, old_right = flow[i], flow[i + 1]
        new_left, new_right = ws.iterate_flow[i], ws.iterate_flow[i + 1]
        alpha_left, alpha_right = ws.alpha[i], ws.alpha[i + 1]
        area, flux = ws.mean_area[i], ws.momentum_flux[i]
        for j in range(n_phi):
            q = 0.5 * ((1.0 - theta) * (old_left[j] + old_right[j]) + theta * (new_left[j] + new_right[j]))
            flux[j] = 0.5 * (alpha_left[j] + alpha_right[j]) * q * q / area[j]


@njit(cache=True, nogil=True, error_model="numpy")
def _predict(p: Parameters, s: Stepping, ws: Workspace, flow: Array) -> None:
    """Flow G that each inner face would have at the iterate's pressure, and its conductance κ."""
    n_x, n_phi = ws.mean_area.shape
    theta, dt = s.theta, s.time_step
    for f in range(1, n_x):
        left, right = f - 1, f
        area_left, area_right = ws.mean_area[left], ws.mean_area[right]
        old_left, old_right = ws.pressure[left], ws.pressure[right]
        new_left, new_right = ws.iterate_pressure[left], ws.iterate_pressure[right]
        flux_left, flux_right = ws.momentum_flux[left], ws.momentum_flux[right]
        source, old_flow = ws.source[f], flow[f]
        explicit_flow, conductance = ws.explicit_flow[f], ws.conductance[f]
        for j in range(n_phi):
            drive = dt / (p.density * p.dx) * 0.5 * (area_left[j] + area_right[j])
            old = old_right[j] - old_left[j]
            new = new_right[j] - new_left[j]
            advection = dt / p.dx * (flux_right[j] - flux_left[j])
            damping = dt * source[j]
            inverse = 1.0 / (1.0 - theta * damping)
            rest = old_flow[j] * (1.0 + (1.0 - theta) * damping) - advection
            explicit_flow[j] = (rest - drive * ((1.0 - theta) * old + theta * new)) * inverse
            conductance[j] = theta * drive * inverse


@njit(cache=True, nogil=True, error_model="numpy")
def _predict_ends(p: Parameters, s: Stepping, ws: Workspace, flow: Array, inlet_velocity: float) -> None:
    """Q' = vA' at the inlet; half a cell of momentum at the outlet."""
    n_x, n_phi = ws.mean_area.shape
    theta, dt, last = s.theta, s.time_step, n_x - 1
    half = 0.5 * p.dx
    for j in range(n_phi):
        inlet_area = 1.5 * ws.iterate_area[0, j] - 0.5 * ws.iterate_area[1, j]
        ws.explicit_flow[0, j] = inlet_velocity * inlet_area
        ws.conductance[0, j] = 0.0
        area = ws.outlet_area[j]
        q = (1.0 - theta) * flow[n_x, j] + theta * ws.iterate_flow[n_x, j]
        outlet_flux = ws.alpha[n_x, j] * q * q / area
        drive = dt * area / (p.density * half)
        old = ws.outlet_pressure[j] - ws.pressure[last, j]
        new = ws.iterate_outlet_pressure[j] - ws.iterate_pressure[last, j]
        advection = dt / half * (outlet_flux - ws.momentum_flux[last, j])
        damping = dt * ws.source[n_x, j]
        inverse = 1.0 / (1.0 - theta * damping)
        rest = flow[n_x, j] * (1.0 + (1.0 - theta) * damping) - advection
        ws.explicit_flow[n_x, j] = (rest - drive * ((1.0 - theta) * old + theta * new)) * inverse
        ws.conductance[n_x, j] = theta * drive * inverse


@njit(cache=True, nogil=True, error_model="numpy")
def _mass_residual(p: Parameters, s: Stepping, ws: Workspace, area: Array, flow: Array) -> None:
    """Mass balance at the iterate, into ``correction``; its own derivative, into ``diagonal``."""
    n_x, n_phi = area.shape
    c = s.theta * s.time_step / p.dx
    explicit = (1.0 - s.theta) * s.time_step / p.dx
    for i in range(n_x):
        old_left, old_right = flow[i], flow[i + 1]
        new_left, new_right = ws.explicit_flow[i], ws.explicit_flow[i + 1]
        area_row, iterate, slope = area[i], ws.iterate_area[i], ws.area_slope[i]
        left, right = ws.conductance[i], ws.conductance[i + 1]
        rhs, pivot = ws.correction[i], ws.diagonal[i]
        for j in range(n_phi):
            divergence = explicit * (old_right[j] - old_left[j]) + c * (new_right[j] - new_left[j])
            rhs[j] = area_row[j] - iterate[j] - divergence
            pivot[j] = slope[j] + c * (left[j] + right[j])


@njit(cache=True, nogil=True, error_model="numpy")
def _eliminate(p: Parameters, s: Stepping, ws: Workspace, inlet_velocity: float) -> None:
    """Forward elimination of the linearised mass balance; leaves pivots and right-hand sides.

    The matrix is symmetric but for the first row, where Q' = vA' at the inlet.
    """
    n_x, n_phi = ws.correction.shape
    c = s.theta * s.time_step / p.dx
    inflow = c * inlet_velocity
    for j in range(n_phi):
        ws.diagonal[0, j] -= 1.5 * inflow * ws.area_slope[0, j]
        coupling = c * ws.conductance[1, j]
        factor = coupling / ws.diagonal[0, j]
        ws.diagonal[1, j] -= factor * (coupling - 0.5 * inflow * ws.area_slope[1, j])
        ws.correction[1, j] += factor * ws.correction[0, j]
    for i in range(2, n_x):
        above, pivot = ws.diagonal[i - 1], ws.diagonal[i]
        rhs_above, rhs = ws.correction[i - 1], ws.correction[i]
        conductance = ws.conductance[i]
        for j in range(n_phi):
            coupling = c * conductance[j]
            factor = coupling / above[j]
            pivot[j] -= factor * coupling
            rhs[j] += factor * rhs_above[j]


@njit(cache=True, nogil=True, error_model="numpy")
def _outlet_correction(p: Parameters, s: Stepping, ws: Workspace) -> None:
    """Solve the outlet law for P_out' − P_out and close the last cell of every row.

    After elimination the last cell's correction is an affine function of the outlet's, so is Q' there:
    per row one scalar equation, per section one for all rows.
    """
    n_x, n_phi = ws.mean_area.shape
    last = n_x - 1
    c = s.theta * s.time_step / p.dx
    total_flow, total_slope = 0.0, 0.0
    for j in range(n_phi):
        k = ws.conductance[n_x, j]
        inverse = 1.0 / ws.diagonal[last, j]
        base = ws.explicit_flow[n_x, j] + k * ws.correction[last, j] * inverse
        slope = k * (1.0 - c * k * inverse)
        if p.outlet_by_section:
            total_flow += 0.5 * p.dphi * base
            total_slope += 0.5 * p.dphi * slope
        else:
            target = p.offset + p.resistance * base - ws.iterate_outlet_pressure[j]
            _close_last_cell(ws, j, c, target / (1.0 + p.resistance * slope))
    if p.outlet_by_section:
        target = p.offset + p.resistance * total_flow - ws.iterate_outlet_pressure[0]
        change = target / (1.0 + p.resistance * total_slope)
        for j in range(n_phi):
            _close_last_cell(ws, j, c, change)


@njit(cache=True, nogil=True, error_model="numpy")
def _close_last_cell(ws: Workspace, j: int, c: float, outlet_change: float) -> None:
    n_x = ws.mean_area.shape[0]
    last = n_x - 1
    k = ws.conductance[n_x, j]
    closed = (ws.correction[last, j] + c * k * outlet_change) / ws.diagonal[last, j]
    ws.correction[last, j] = closed
    ws.iterate_outlet_pressure[j] += outlet_change
    ws.explicit_flow[n_x, j] -= k * (outlet_change - closed)


@njit(cache=True, nogil=True, error_model="numpy")
def _substitute(p: Parameters, s: Stepping, ws: Workspace, inlet_velocity: float) -> None:
    """Back substitution: P' − P of the iterate in every cell."""
    n_x, n_phi = ws.mean_area.shape
    c = s.theta * s.time_step / p.dx
    for i in range(n_x - 2, 0, -1):
        conductance, below = ws.conductance[i + 1], ws.correction[i + 1]
        correction, pivot = ws.correction[i], ws.diagonal[i]
        for j in range(n_phi):
            correction[j] = (correction[j] + c * conductance[j] * below[j]) / pivot[j]
    for j in range(n_phi):
        coupling = c * (ws.conductance[1, j] - 0.5 * inlet_velocity * ws.area_slope[1, j])
        ws.correction[0, j] = (ws.correction[0, j] + coupling * ws.correction[1, j]) / ws.diagonal[0, j]


@njit(cache=True, nogil=True, error_model="numpy")
def _correct(ws: Workspace, inlet_velocity: float) -> None:
    """P' in every cell and Q' on every face but the outlet, which is already closed."""
    n_x, n_phi = ws.mean_area.shape
    for j in range(n_phi):
        first = 1.5 * ws.area_slope[0, j] * ws.correction[0, j]
        second = 0.5 * ws.area_slope[1, j] * ws.correction[1, j]
        ws.explicit_flow[0, j] += inlet_velocity * (first - second)
    for f in range(1, n_x):
        left, right = ws.correction[f - 1], ws.correction[f]
        flow, conductance = ws.explicit_flow[f], ws.conductance[f]
        for j in range(n_phi):
            flow[j] -= conductance[j] * (right[j] - left[j])
    for i in range(n_x):
        pressure, correction = ws.iterate_pressure[i], ws.correction[i]
        for j in range(n_phi):
            pressure[j] += correction[j]


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"reassoc", "contract"})
def _rms(values: Array) -> float:
    """Root of the mean square of a 2-D array."""
    total = 0.0
    for row in values:
        for j in range(row.size):
            total += row[j] * row[j]
    return float(np.sqrt(total / values.size))


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"reassoc", "contract"})
def _rms_change(new: Array, old: Array) -> float:
    """Root of the mean square of new − old, 2-D arrays."""
    total = 0.0
    for i in range(new.shape[0]):
        new_row, old_row = new[i], old[i]
        for j in range(new_row.size):
            change = new_row[j] - old_row[j]
            total += change * change
    return float(np.sqrt(total / new.size))


@njit(cache=True, nogil=True, error_model="numpy")
def pressure_of_area(area: Array, p: Parameters, pressure: Array) -> None:
    """P = P₀ + (√A − R₀)/(R₀²/β) at every cell, into ``pressure``, Pa."""
    n_x, n_phi = area.shape
    for i in range(n_x):
        for j in range(n_phi):
            strain = np.sqrt(area[i, j]) - p.radius
            pressure[i, j] = p.reference_pressure + strain / p.compliance[i, j]


@njit(cache=True, nogil=True, error_model="numpy")
def outlet_pressure_of_flow(flow: Array, p: Parameters, pressure: Array) -> None:
    """P = P_res + R_res × flow at the outlet, per row, into ``pressure`` (n_phi,), Pa."""
    n_phi = pressure.size
    outlet = flow[flow.shape[0] - 1]
    section = 0.5 * p.dphi * n_phi * _mean(outlet)
    for j in range(n_phi):
        q = section if p.outlet_by_section else outlet[j]
        pressure[j] = p.offset + p.resistance * q


@njit(cache=True, nogil=True, error_model="numpy")
def _start_iterate(
    p: Parameters, ws: Workspace, area: Array, flow: Array, outlet_area: Array, extrapolate: bool
) -> None:
    """Old pressures, and the first iterate: the old state or its linear extrapolation in time."""
    pressure_of_area(area, p, ws.pressure)
    outlet_pressure_of_flow(flow, p, ws.outlet_pressure)
    weight = 1.0 if extrapolate else 0.0
    n_x, n_phi = area.shape
    for i in range(n_x):
        for j in range(n_phi):
            old = ws.pressure[i, j]
            ws.iterate_pressure[i, j] = old + weight * (old - ws.previous_pressure[i, j])
            ws.previous_pressure[i, j] = old
    for f in range(n_x + 1):
        for j in range(n_phi):
            q = flow[f, j]
            ws.iterate_flow[f, j] = q + weight * (q - ws.previous_flow[f, j])
            ws.previous_flow[f, j] = q
    outlet_pressure_of_flow(ws.iterate_flow, p, ws.iterate_outlet_pressure)
    for j in range(n_phi):
        radius = p.radius + (ws.outlet_pressure[j] - p.reference_pressure) * p.compliance[n_x - 1, j]
        outlet_area[j] = radius * radius


@njit(cache=True, nogil=True, error_model="numpy")
def step(
    p: Parameters,
    s: Stepping,
    ws: Workspace,
    area: Array,
    flow: Array,
    inlet_velocity: float,
    outlet_area: Array,
    extrapolate: bool,
) -> tuple[int, int, int, int]:
    """Advance ``area`` and ``flow`` in place by one Δt.

    Parameters
    ----------
    p, s, ws : Parameters, Stepping, Workspace
    area : ndarray (n_x, n_phi)
        A = R², m².
    flow : ndarray (n_x + 1, n_phi)
        Q = uR² on faces, m³/s.
    inlet_velocity : float
        v at the new time, m/s.
    outlet_area : ndarray (n_phi,)
        Scratch.
    extrapolate : bool
        Whether the workspace holds the step before, of the same Δt.

    Returns
    -------
    status, i, j, sweeps : int
        OK or what failed, the cell counted from 0, and the sweeps used.
    """
    _start_iterate(p, ws, area, flow, outlet_area, extrapolate)
    rest_flow = REST_VELOCITY * 1e-3 * p.radius * p.radius
    rest_pressure = 1e-12 * p.radius / np.max(p.compliance)
    for sweep in range(1, s.max_sweeps + 1):
        status, i, j = _wall(p, ws, area, outlet_area, s.theta)
        if status != OK:
            return status, i, j, sweep
        status, i, j = _coefficients(p, ws, flow, s.theta)
        if status != OK:
            return status, i, j, sweep
        _momentum_flux(ws, flow, s.theta)
        _predict(p, s, ws, flow)
        _predict_ends(p, s, ws, flow, inlet_velocity)
        _mass_residual(p, s, ws, area, flow)
        _eliminate(p, s, ws, inlet_velocity)
        _outlet_correction(p, s, ws)
        _substitute(p, s, ws, inlet_velocity)
        _correct(ws, inlet_velocity)
        change = _rms_change(ws.explicit_flow, ws.iterate_flow)
        correction = _rms(ws.correction)
        if not np.isfinite(change + correction):
            return NOT_FINITE, 0, 0, sweep
        ws.iterate_flow[:, :] = ws.explicit_flow
        flow_converged = change <= s.tolerance * _rms(ws.iterate_flow) + rest_flow
        if flow_converged and correction <= s.tolerance * _rms(ws.iterate_pressure) + rest_pressure:
            _balance_mass(p, s, area, flow, ws.iterate_flow, ws.exchanged)
            return OK, 0, 0, sweep
    return NOT_CONVERGED, 0, 0, s.max_sweeps


@njit(cache=True, nogil=True, error_model="numpy")
def _balance_mass(
    p: Parameters, s: Stepping, area: Array, flow: Array, new_flow: Array, exchanged: Array
) -> None:
    """Take A' from the fluxes themselves, so that mass is conserved to round-off; Q' replaces Q."""
    n_x, n_phi = area.shape
    ratio = s.time_step / p.dx
    sector = 0.5 * p.dphi * s.time_step
    for j in range(n_phi):
        exchanged[0] += sector * ((1.0 - s.theta) * flow[0, j] + s.theta * new_flow[0, j])
        exchanged[1] += sector * ((1.0 - s.theta) * flow[n_x, j] + s.theta * new_flow[n_x, j])
    for i in range(n_x):
        for j in range(n_phi):
            old = flow[i + 1, j] - flow[i, j]
            new = new_flow[i + 1, j] - new_flow[i, j]
            area[i, j] -= ratio * ((1.0 - s.theta) * old + s.theta * new)
    flow[:, :] = new_flow


@njit(cache=True, nogil=True, error_model="numpy")
def advance(
    p: Parameters, s: Stepping, ws: Workspace, area: Array, flow: Array, inlet_velocities: Array
) -> tuple[int, int, int, int, int]:
    """Take one step per entry of ``inlet_velocities`` (v at the end of each step, m/s).

    Returns
    -------
    status, i, j, steps, sweeps : int
        As :func:`step`; steps completed and sweeps in all.
    """
    outlet_area = np.empty(area.shape[1])
    total = 0
    for n in range(inlet_velocities.size):
        status, i, j, sweeps = step(p, s, ws, area, flow, inlet_velocities[n], outlet_area, n > 0)
        total += sweeps
        if status != OK:
            return status, i, j, n, total
    return OK, 0, 0, inlet_velocities.size, total
