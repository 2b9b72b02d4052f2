"""Inlet and outlet of the semi-implicit scheme: half cells and boundary laws (numba kernels)."""

import numpy as np
from numba import njit

from solver.schemes.layout import (
    FLOW_INLET,
    NON_REFLECTING,
    OK,
    PRESSURE_INLET,
    ROW_RESISTANCE,
    VELOCITY_INLET,
    WINDKESSEL,
    Array,
    Fields,
    Parameters,
    Stepping,
    Workspace,
)
from solver.schemes.profile import mean
from solver.schemes.walls import wall_row

INLET, OUTLET = 0, 1


@njit(cache=True, nogil=True, error_model="numpy")
def section_flow(p: Parameters, flow: Array) -> float:
    """Flow rate of a section ½∮Q dφ from its rows, m³/s."""
    return 0.5 * p.dphi * flow.size * mean(flow)


@njit(cache=True, nogil=True, error_model="numpy")
def old_end_areas(p: Parameters, ws: Workspace, fields: Fields) -> tuple[int, int, int]:
    """Apply the wall law to the old end pressures; status, i, j."""
    last = fields.area.shape[0] - 1
    status, j = wall_row(p, last, fields.outlet_pressure, ws.old_end_area[OUTLET], ws.end_slope[OUTLET])
    if status != OK or p.inlet_kind != PRESSURE_INLET:
        return status, last, j
    status, j = wall_row(p, 0, fields.inlet_pressure, ws.old_end_area[INLET], ws.end_slope[INLET])
    return status, 0, j


@njit(cache=True, nogil=True, error_model="numpy")
def end_areas(p: Parameters, ws: Workspace, theta: float) -> tuple[int, int, int]:
    """θ-weighted A at the ends from the iterate's end pressures; status, i, j."""
    last = ws.mean_area.shape[0] - 1
    status, j = wall_row(p, last, ws.end_pressure[OUTLET], ws.end_area[OUTLET], ws.end_slope[OUTLET])
    if status != OK:
        return status, last, j
    old, new = ws.old_end_area, ws.end_area
    for j in range(new.shape[1]):
        new[OUTLET, j] = (1.0 - theta) * old[OUTLET, j] + theta * new[OUTLET, j]
    if p.inlet_kind != PRESSURE_INLET:
        return OK, 0, 0
    status, j = wall_row(p, 0, ws.end_pressure[INLET], ws.end_area[INLET], ws.end_slope[INLET])
    if status != OK:
        return status, 0, j
    for j in range(new.shape[1]):
        new[INLET, j] = (1.0 - theta) * old[INLET, j] + theta * new[INLET, j]
    return OK, 0, 0


@njit(cache=True, nogil=True, error_model="numpy")
def extrapolated(first: Array, second: Array, value: Array) -> None:
    """Value half a cell beyond the first of two rows."""
    for j in range(value.size):
        value[j] = 1.5 * first[j] - 0.5 * second[j]


@njit(cache=True, nogil=True, error_model="numpy")
def face_area(mean_area: Array, end_area: Array, inlet_kind: int, f: int, area: Array) -> None:
    """θ-weighted area of face f, without ghosts."""
    n_x = mean_area.shape[0]
    if 0 < f < n_x:
        left, right = mean_area[f - 1], mean_area[f]
        for j in range(area.size):
            area[j] = 0.5 * (left[j] + right[j])
    elif f == n_x:
        area[:] = end_area[OUTLET]
    elif inlet_kind == PRESSURE_INLET:
        area[:] = end_area[INLET]
    else:
        extrapolated(mean_area[0], mean_area[1], area)


@njit(cache=True, nogil=True, error_model="numpy")
def inlet_flow(p: Parameters, ws: Workspace, value: float, flow: Array) -> None:
    """Q' = vA' of a velocity inlet, or with v = q/½∮A' dφ of a flow inlet, at the iterate's area."""
    extrapolated(ws.iterate_area[0], ws.iterate_area[1], flow)
    velocity = value
    if p.inlet_kind == FLOW_INLET:
        velocity = value / section_flow(p, flow)
    for j in range(flow.size):
        flow[j] *= velocity


@njit(cache=True, nogil=True, error_model="numpy")
def inlet_slopes(p: Parameters, value: float) -> tuple[float, float]:
    """∂Q'/∂A of the first two cells at a velocity inlet, m/s; 0 at others."""
    if p.inlet_kind == VELOCITY_INLET:
        return 1.5 * value, -0.5 * value
    return 0.0, 0.0


@njit(cache=True, nogil=True, error_model="numpy")
def half_cell(
    p: Parameters, s: Stepping, ws: Workspace, fields: Fields, f: int, flux: Array, end: int
) -> None:
    """Momentum of the half cell at an end: G and κ of face f; ``flux`` is the end cell's αQ²/A."""
    theta, dt, half = s.theta, s.time_step, 0.5 * p.dx
    i = f if end == INLET else f - 1
    out = -1.0 if end == INLET else 1.0  # direction from the cell to the face
    old_end = fields.inlet_pressure if end == INLET else fields.outlet_pressure
    old_flow, new_flow, damping = fields.flow[f], ws.iterate_flow[f], ws.damping[f]
    for j in range(flux.size):
        area = ws.end_area[end, j]
        q = (1.0 - theta) * old_flow[j] + theta * new_flow[j]
        end_flux = ws.alpha[f, j] * q * q / area
        drive = dt * area / (p.density * half)
        old = old_end[j] - fields.pressure[i, j]
        new = ws.end_pressure[end, j] - ws.iterate_pressure[i, j]
        advection = out * dt / half * (end_flux - flux[j])
        inverse = 1.0 / (1.0 - theta * damping[j])
        rest = old_flow[j] * (1.0 + (1.0 - theta) * damping[j]) - advection
        difference = out * ((1.0 - theta) * old + theta * new)
        ws.explicit_flow[f, j] = (rest - drive * difference) * inverse
        ws.conductance[f, j] = theta * drive * inverse


@njit(cache=True, nogil=True, error_model="numpy")
def outlet_law(p: Parameters, s: Stepping, ws: Workspace, fields: Fields, offset: float) -> None:
    """Write the outlet as P' = a + b × flow of the section or the row, into ``law``."""
    a, b = ws.law[0], ws.law[1]
    if p.outlet_kind == NON_REFLECTING:
        _non_reflecting_law(p, s, ws, fields)
        return
    if p.outlet_kind == WINDKESSEL:
        gain = s.time_step / p.capacitance
        leak = gain / p.distal_resistance
        old = section_flow(p, fields.flow[fields.flow.shape[0] - 1])
        held = fields.reservoir[0] * (1.0 - (1.0 - s.theta) * leak)
        held += gain * (1.0 - s.theta) * old + leak * p.venous_pressure
        for j in range(a.size):
            a[j] = held / (1.0 + s.theta * leak)
            b[j] = p.resistance + s.theta * gain / (1.0 + s.theta * leak)
        return
    for j in range(a.size):
        a[j], b[j] = offset, p.resistance


@njit(cache=True, nogil=True, error_model="numpy")
def _non_reflecting_law(p: Parameters, s: Stepping, ws: Workspace, fields: Fields) -> None:
    """No wave enters: Q' − Q − Δt S Q = λ₊ (A' − A) (2.2.41), with A' − A = dA/dP (P' − P)."""
    f = fields.flow.shape[0] - 1
    a, b = ws.law[0], ws.law[1]
    for j in range(a.size):
        area, slope, alpha = ws.end_area[OUTLET, j], ws.end_slope[OUTLET, j], ws.alpha[f, j]
        q = (1.0 - s.theta) * fields.flow[f, j] + s.theta * ws.iterate_flow[f, j]
        u = q / area
        wave = alpha * u + np.sqrt(area / (p.density * slope) + u * u * alpha * (alpha - 1.0))
        b[j] = 1.0 / (wave * slope)
        a[j] = fields.outlet_pressure[j] - b[j] * (fields.flow[f, j] + ws.damping[f, j] * q)


@njit(cache=True, nogil=True, error_model="numpy")
def close_outlet(p: Parameters, s: Stepping, ws: Workspace) -> None:
    """Solve the outlet law for P_out' and close the last cell of every row.

    After elimination the last cell's correction is an affine function of the outlet's, and so is Q':
    per row one scalar equation, per section one for all rows.
    """
    n_x = ws.mean_area.shape[0]
    a, b = ws.law[0], ws.law[1]
    by_row = p.outlet_kind in (ROW_RESISTANCE, NON_REFLECTING)
    c = s.theta * s.time_step / p.dx
    total_flow, total_slope = 0.0, 0.0
    for j in range(a.size):
        k = ws.conductance[n_x, j]
        inverse = ws.inverse_pivot[n_x - 1, j]
        base = ws.explicit_flow[n_x, j] + k * ws.correction[n_x - 1, j] * inverse
        slope = k * (1.0 - c * k * inverse)
        if by_row:
            gap = a[j] + b[j] * base - ws.end_pressure[OUTLET, j]
            _close_last_cell(ws, j, c, gap / (1.0 + b[j] * slope))
        else:
            total_flow += 0.5 * p.dphi * base
            total_slope += 0.5 * p.dphi * slope
    if not by_row:
        gap = a[0] + b[0] * total_flow - ws.end_pressure[OUTLET, 0]
        for j in range(a.size):
            _close_last_cell(ws, j, c, gap / (1.0 + b[0] * total_slope))


@njit(cache=True, nogil=True, error_model="numpy")
def _close_last_cell(ws: Workspace, j: int, c: float, change: float) -> None:
    n_x = ws.mean_area.shape[0]
    k = ws.conductance[n_x, j]
    closed = (ws.correction[n_x - 1, j] + c * k * change) * ws.inverse_pivot[n_x - 1, j]
    ws.correction[n_x - 1, j] = closed
    ws.end_pressure[OUTLET, j] += change
    ws.explicit_flow[n_x, j] -= k * (change - closed)


@njit(cache=True, nogil=True, error_model="numpy")
def update_reservoir(p: Parameters, fields: Fields, new_flow: Array) -> None:
    """Pressure of the Windkessel's capacitor after the step: P_c' = P' − R₁ q'."""
    if p.outlet_kind == WINDKESSEL:
        fields.reservoir[0] = fields.outlet_pressure[0] - p.resistance * section_flow(p, new_flow)
