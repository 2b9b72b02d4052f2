"""Staggered, pressure-implicit scheme on (x, φ): numba kernels.

After Casulli, Dumbser & Toro (2012), "Semi-implicit numerical modeling of axially symmetric flows in
compliant arterial systems". A and P live at cell centres, Q, u, γ and α on faces; face f lies left of
cell f, face 0 is the inlet and face n_x the outlet. All arrays are float64 in SI, φ is contiguous.

One step solves, with θ the implicitness and coefficients at the θ-weighted mean of old state and
iterate (marked ¯),

    (A' − A)/Δt + ∂_x[θQ' + (1−θ)Q] = 0                                                (2.2.33)
    (Q' − Q)/Δt + ∂_x(αQ²/A)¯ + (Ā/ρ) ∂_x[θP' + (1−θ)P] = S̄ [θQ' + (1−θ)Q]             (2.2.34)
    S = h(A, γ) − 2(γ+2)(μ/ρ)/A,   γ = 2u/(D − u),   D = 2 mean_φ(u)                   (2.2.35)

by Newton's method in P on the mass balance, which is tridiagonal in each row. The ends are half cells,
see :mod:`solver.schemes.ends`.
"""

import numpy as np
from numba import njit

from solver.schemes.ends import (
    INLET,
    OUTLET,
    close_outlet,
    end_areas,
    face_area,
    half_cell,
    inlet_flow,
    inlet_slopes,
    old_end_areas,
    outlet_law,
    update_reservoir,
)
from solver.schemes.layout import (
    NO_ADMISSIBLE_PROFILE,
    NOT_CONVERGED,
    NOT_FINITE,
    OK,
    PRESSURE_INLET,
    REST_VELOCITY,
    Array,
    Fields,
    Parameters,
    Stepping,
    Workspace,
)
from solver.schemes.profile import (
    all_admissible,
    at_rest,
    closure_source,
    fixed_source,
    inadmissible_row,
    mean,
    wrap,
)
from solver.schemes.walls import wall_area


@njit(cache=True, nogil=True, error_model="numpy")
def _mean_areas(ws: Workspace, area: Array, theta: float) -> None:
    for i in range(area.shape[0]):
        old, new, weighted = area[i], ws.iterate_area[i], ws.mean_area[i]
        for j in range(old.size):
            weighted[j] = (1.0 - theta) * old[j] + theta * new[j]


@njit(cache=True, nogil=True, error_model="numpy")
def _face_velocity(old: Array, new: Array, theta: float, area: Array, row: Array) -> None:
    """1/A and u = Q/A of one face at the θ-weighted mean, into the two rows of ``row``."""
    inverse_area, velocity = row[0], row[1]
    for j in range(velocity.size):
        inverse_area[j] = 1.0 / area[j]
        velocity[j] = ((1.0 - theta) * old[j] + theta * new[j]) * inverse_area[j]


@njit(cache=True, nogil=True, error_model="numpy")
def _coefficients(p: Parameters, s: Stepping, ws: Workspace, flow: Array) -> tuple[int, int, int]:
    """α and Δt S on every face at the θ-weighted mean; the failure (status, i, j) if there is one."""
    n_x = ws.mean_area.shape[0]
    area, inverse_exponent = ws.ghosted[0], ws.ghosted[1]
    inverse_area, velocity = ws.row[0], ws.row[1]
    scale = s.time_step * p.kinematic_viscosity
    for f in range(n_x + 1):
        face_area(ws.mean_area, ws.end_area, p.inlet_kind, f, area[1:-1])
        _face_velocity(flow[f], ws.iterate_flow[f], s.theta, area[1:-1], ws.row)
        alpha, damping = ws.alpha[f], ws.damping[f]
        if p.fixed_exponent > 0.0:
            fixed_source(alpha, damping, inverse_area, p.fixed_exponent, scale)
            continue
        d = 2.0 * mean(velocity)
        if abs(d) > REST_VELOCITY and all_admissible(velocity, d):
            wrap(area)
            closure_source(alpha, damping, area, inverse_area, velocity, d, inverse_exponent, scale, p.dphi)
        elif at_rest(velocity):
            fixed_source(alpha, damping, inverse_area, 2.0, scale)
        else:
            return NO_ADMISSIBLE_PROFILE, min(f, n_x - 1), inadmissible_row(velocity, d)
    return OK, 0, 0


@njit(cache=True, nogil=True, error_model="numpy")
def _momentum_flux(s: Stepping, ws: Workspace, flow: Array) -> None:
    """αQ²/A at cell centres from the two faces."""
    theta = s.theta
    for i in range(ws.mean_area.shape[0]):
        old_left, old_right = flow[i], flow[i + 1]
        new_left, new_right = ws.iterate_flow[i], ws.iterate_flow[i + 1]
        alpha_left, alpha_right = ws.alpha[i], ws.alpha[i + 1]
        area, flux = ws.mean_area[i], ws.momentum_flux[i]
        for j in range(flux.size):
            q = (1.0 - theta) * (old_left[j] + old_right[j]) + theta * (new_left[j] + new_right[j])
            flux[j] = 0.125 * (alpha_left[j] + alpha_right[j]) * q * q / area[j]


@njit(cache=True, nogil=True, error_model="numpy")
def _predict(p: Parameters, s: Stepping, ws: Workspace, fields: Fields) -> None:
    """Flow G that inner faces would have at the iterate's pressure, and their conductance κ."""
    theta, carry = s.theta, s.time_step / p.dx
    pull = 0.5 * s.time_step / (p.density * p.dx)
    for f in range(1, ws.mean_area.shape[0]):
        area_left, area_right = ws.mean_area[f - 1], ws.mean_area[f]
        old_left, old_right = fields.pressure[f - 1], fields.pressure[f]
        new_left, new_right = ws.iterate_pressure[f - 1], ws.iterate_pressure[f]
        flux_left, flux_right = ws.momentum_flux[f - 1], ws.momentum_flux[f]
        damping, old_flow = ws.damping[f], fields.flow[f]
        explicit_flow, conductance = ws.explicit_flow[f], ws.conductance[f]
        for j in range(damping.size):
            drive = pull * (area_left[j] + area_right[j])
            old = old_right[j] - old_left[j]
            new = new_right[j] - new_left[j]
            inverse = 1.0 / (1.0 - theta * damping[j])
            rest = old_flow[j] * (1.0 + (1.0 - theta) * damping[j])
            rest -= carry * (flux_right[j] - flux_left[j])
            explicit_flow[j] = (rest - drive * ((1.0 - theta) * old + theta * new)) * inverse
            conductance[j] = theta * drive * inverse


@njit(cache=True, nogil=True, error_model="numpy")
def _predict_ends(p: Parameters, s: Stepping, ws: Workspace, fields: Fields, inlet_value: float) -> None:
    """G and κ at the inlet and at the outlet."""
    n_x = ws.mean_area.shape[0]
    if p.inlet_kind == PRESSURE_INLET:
        half_cell(p, s, ws, fields, 0, ws.momentum_flux[0], INLET)
    else:
        inlet_flow(p, ws, inlet_value, ws.explicit_flow[0])
        ws.conductance[0, :] = 0.0
    half_cell(p, s, ws, fields, n_x, ws.momentum_flux[n_x - 1], OUTLET)


@njit(cache=True, nogil=True, error_model="numpy")
def _mass_residual(p: Parameters, s: Stepping, ws: Workspace, fields: Fields) -> None:
    """Mass balance of every cell at the iterate, into ``correction``; its own derivative, into pivots."""
    c = s.theta * s.time_step / p.dx
    explicit = (1.0 - s.theta) * s.time_step / p.dx
    for i in range(fields.area.shape[0]):
        old_left, old_right = fields.flow[i], fields.flow[i + 1]
        new_left, new_right = ws.explicit_flow[i], ws.explicit_flow[i + 1]
        area, iterate, slope = fields.area[i], ws.iterate_area[i], ws.area_slope[i]
        left, right = ws.conductance[i], ws.conductance[i + 1]
        pivot, rhs = ws.inverse_pivot[i], ws.correction[i]
        for j in range(rhs.size):
            divergence = explicit * (old_right[j] - old_left[j]) + c * (new_right[j] - new_left[j])
            rhs[j] = area[j] - iterate[j] - divergence
            pivot[j] = slope[j] + c * (left[j] + right[j])


@njit(cache=True, nogil=True, error_model="numpy")
def _eliminate(p: Parameters, s: Stepping, ws: Workspace, slopes: tuple[float, float]) -> None:
    """Forward elimination of the linearised mass balance; leaves 1/pivot and right-hand sides.

    The matrix is symmetric but for the first row, where Q' = vA' at a velocity inlet.
    """
    n_x, n_phi = ws.correction.shape
    c = s.theta * s.time_step / p.dx
    first, second = ws.area_slope[0], ws.area_slope[1]
    above, pivot = ws.inverse_pivot[0], ws.inverse_pivot[1]
    for j in range(n_phi):
        above[j] = 1.0 / (above[j] - c * slopes[0] * first[j])
        coupling = c * ws.conductance[1, j]
        factor = coupling * above[j]
        ws.correction[1, j] += factor * ws.correction[0, j]
        pivot[j] = 1.0 / (pivot[j] - factor * (coupling + c * slopes[1] * second[j]))
    for i in range(2, n_x):
        conductance = ws.conductance[i]
        above, pivot = ws.inverse_pivot[i - 1], ws.inverse_pivot[i]
        rhs_above, rhs = ws.correction[i - 1], ws.correction[i]
        for j in range(n_phi):
            coupling = c * conductance[j]
            factor = coupling * above[j]
            rhs[j] += factor * rhs_above[j]
            pivot[j] = 1.0 / (pivot[j] - factor * coupling)


@njit(cache=True, nogil=True, error_model="numpy")
def _substitute(p: Parameters, s: Stepping, ws: Workspace, slopes: tuple[float, float]) -> None:
    """Back substitution: P' − P of the iterate in every cell."""
    n_x, n_phi = ws.mean_area.shape
    c = s.theta * s.time_step / p.dx
    first, second, slope = ws.correction[0], ws.correction[1], ws.area_slope[1]
    for i in range(n_x - 2, -1, -1):
        conductance, below = ws.conductance[i + 1], ws.correction[i + 1]
        correction, inverse = ws.correction[i], ws.inverse_pivot[i]
        for j in range(n_phi):
            correction[j] = (correction[j] + c * conductance[j] * below[j]) * inverse[j]
    for j in range(n_phi):
        first[j] += c * slopes[1] * slope[j] * second[j] * ws.inverse_pivot[0, j]


@njit(cache=True, nogil=True, error_model="numpy")
def _correct(ws: Workspace, slopes: tuple[float, float]) -> None:
    """P' in every cell, and Q' on every face but the outlet, which is closed already."""
    n_x, n_phi = ws.mean_area.shape
    for f in range(1, n_x):
        left, right = ws.correction[f - 1], ws.correction[f]
        flow, conductance = ws.explicit_flow[f], ws.conductance[f]
        for j in range(n_phi):
            flow[j] -= conductance[j] * (right[j] - left[j])
    for i in range(n_x):
        pressure, correction = ws.iterate_pressure[i], ws.correction[i]
        for j in range(n_phi):
            pressure[j] += correction[j]
    first, second = ws.correction[0], ws.correction[1]
    for j in range(n_phi):
        change = slopes[0] * ws.area_slope[0, j] * first[j] + slopes[1] * ws.area_slope[1, j] * second[j]
        ws.explicit_flow[0, j] += change - ws.conductance[0, j] * first[j]


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"reassoc", "contract"})
def _rms(values: Array) -> float:
    """Root of the mean square of a 2-D array."""
    total = 0.0
    for value in values.ravel():
        total += value * value
    return float(np.sqrt(total / values.size))


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"reassoc", "contract"})
def _accept_flow(ws: Workspace) -> tuple[float, float]:
    """Take Q' as the iterate; root mean squares of its change and of itself."""
    change, size = 0.0, 0.0
    for f in range(ws.iterate_flow.shape[0]):
        old, new = ws.iterate_flow[f], ws.explicit_flow[f]
        for j in range(old.size):
            difference = new[j] - old[j]
            change += difference * difference
            size += new[j] * new[j]
            old[j] = new[j]
    count = ws.iterate_flow.size
    return float(np.sqrt(change / count)), float(np.sqrt(size / count))


@njit(cache=True, nogil=True, error_model="numpy")
def _extrapolate(new: Array, older: Array, oldest: Array, guess: Array, order: int) -> None:
    """First iterate: the old state, or its extrapolation in time of order 1 or 2; remember the past."""
    a = (1.0, 2.0, 3.0)[order]
    b = (0.0, -1.0, -3.0)[order]
    c = (0.0, 0.0, 1.0)[order]
    for i in range(new.shape[0]):
        now, past, before, target = new[i], older[i], oldest[i], guess[i]
        for j in range(now.size):
            target[j] = a * now[j] + b * past[j] + c * before[j]
            before[j] = past[j]
            past[j] = now[j]


@njit(cache=True, nogil=True, error_model="numpy")
def _start(
    p: Parameters, ws: Workspace, fields: Fields, inlet_value: float, order: int
) -> tuple[int, int, int]:
    """First iterate of a step, and what stays fixed during it; status, i, j."""
    _extrapolate(fields.pressure, ws.older_pressure, ws.oldest_pressure, ws.iterate_pressure, order)
    _extrapolate(fields.flow, ws.older_flow, ws.oldest_flow, ws.iterate_flow, order)
    ws.end_pressure[OUTLET, :] = fields.outlet_pressure
    ws.end_pressure[INLET, :] = inlet_value
    return old_end_areas(p, ws, fields)


@njit(cache=True, nogil=True, error_model="numpy")
def _sweep(
    p: Parameters, s: Stepping, ws: Workspace, fields: Fields, inlet_value: float, outlet_offset: float
) -> tuple[int, int, int]:
    """One Newton sweep: from one iterate to the next; status, i, j."""
    status, i, j = wall_area(p, ws.iterate_pressure, ws.iterate_area, ws.area_slope)
    if status != OK:
        return status, i, j
    _mean_areas(ws, fields.area, s.theta)
    status, i, j = end_areas(p, ws, s.theta)
    if status != OK:
        return status, i, j
    status, i, j = _coefficients(p, s, ws, fields.flow)
    if status != OK:
        return status, i, j
    slopes = inlet_slopes(p, inlet_value)
    _momentum_flux(s, ws, fields.flow)
    _predict(p, s, ws, fields)
    _predict_ends(p, s, ws, fields, inlet_value)
    outlet_law(p, s, ws, fields, outlet_offset)
    _mass_residual(p, s, ws, fields)
    _eliminate(p, s, ws, slopes)
    close_outlet(p, s, ws)
    _substitute(p, s, ws, slopes)
    _correct(ws, slopes)
    return OK, 0, 0


@njit(cache=True, nogil=True, error_model="numpy")
def step(
    p: Parameters,
    s: Stepping,
    ws: Workspace,
    fields: Fields,
    inlet_value: float,
    outlet_offset: float,
    order: int,
) -> tuple[int, int, int, int]:
    """Advance the fields in place by one Δt.

    Parameters
    ----------
    p, s, ws, fields : Parameters, Stepping, Workspace, Fields
    inlet_value : float
        v (m/s), q (m³/s) or P (Pa) at the new time, by the inlet's kind.
    outlet_offset : float
        P_res at the new time, Pa.
    order : int
        Order of the first iterate's extrapolation in time: 0, or 1 or 2 if the workspace holds so many
        steps before, of the same Δt.

    Returns
    -------
    status, i, j, sweeps : int
        OK or what failed, the cell counted from 0, and the sweeps used.
    """
    status, i, j = _start(p, ws, fields, inlet_value, order)
    if status != OK:
        return status, i, j, 0
    rest_flow = REST_VELOCITY * 1e-3 * p.radius * p.radius
    for sweep in range(1, s.max_sweeps + 1):
        status, i, j = _sweep(p, s, ws, fields, inlet_value, outlet_offset)
        if status != OK:
            return status, i, j, sweep
        change, size = _accept_flow(ws)
        correction, level = _rms(ws.correction), _rms(ws.iterate_pressure)
        if not np.isfinite(change + size + correction + level):
            return NOT_FINITE, 0, 0, sweep
        rest_pressure = 1e-9 + 1e-12 * level
        flow_converged = change <= s.tolerance * size + rest_flow
        if flow_converged and correction <= s.tolerance * level + rest_pressure:
            _accept(p, s, ws, fields)
            return OK, 0, 0, sweep
    return NOT_CONVERGED, 0, 0, s.max_sweeps


@njit(cache=True, nogil=True, error_model="numpy")
def _accept(p: Parameters, s: Stepping, ws: Workspace, fields: Fields) -> None:
    """Take the iterate as the new state; A' from the fluxes, so that mass is kept to round-off."""
    area, flow, new_flow = fields.area, fields.flow, ws.iterate_flow
    n_x = area.shape[0]
    ratio = s.time_step / p.dx
    sector = 0.5 * p.dphi * s.time_step
    for j in range(area.shape[1]):
        ws.exchanged[0] += sector * ((1.0 - s.theta) * flow[0, j] + s.theta * new_flow[0, j])
        ws.exchanged[1] += sector * ((1.0 - s.theta) * flow[n_x, j] + s.theta * new_flow[n_x, j])
    for i in range(n_x):
        row = area[i]
        old_left, old_right, new_left, new_right = flow[i], flow[i + 1], new_flow[i], new_flow[i + 1]
        for j in range(row.size):
            old, new = old_right[j] - old_left[j], new_right[j] - new_left[j]
            row[j] -= ratio * ((1.0 - s.theta) * old + s.theta * new)
    fields.outlet_pressure[:] = ws.end_pressure[OUTLET]
    fields.inlet_pressure[:] = ws.end_pressure[INLET]
    update_reservoir(p, fields, new_flow[n_x])
    flow[:, :] = new_flow
    fields.pressure[:, :] = ws.iterate_pressure


@njit(cache=True, nogil=True, error_model="numpy")
def advance(
    p: Parameters, s: Stepping, ws: Workspace, fields: Fields, inlet_values: Array, outlet_offsets: Array
) -> tuple[int, int, int, int, int]:
    """Take one step per entry of ``inlet_values`` and ``outlet_offsets`` (at the end of each step).

    Returns
    -------
    status, i, j, steps, sweeps : int
        As :func:`step`; steps completed and sweeps in all.
    """
    total, known = 0, 0
    for n in range(inlet_values.size):
        value, offset = inlet_values[n], outlet_offsets[n]
        status, i, j, sweeps = step(p, s, ws, fields, value, offset, min(known, 2))
        total += sweeps
        if status != OK and known > 0:  # the past may be a jump, from which no state can be extrapolated
            known = 0
            status, i, j, sweeps = step(p, s, ws, fields, value, offset, 0)
            total += sweeps
        known += 1
        if status != OK:
            return status, i, j, n, total
    return OK, 0, 0, inlet_values.size, total
