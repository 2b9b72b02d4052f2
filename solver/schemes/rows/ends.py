"""Inlet and outlet of the semi-implicit scheme: half cells and boundary laws (numba kernels)."""

import numpy as np

from cases.arrays import Floats
from solver.schemes.layout import (
    FLOW_INLET,
    NON_REFLECTING,
    OK,
    PRESSURE_INLET,
    ROW_RESISTANCE,
    VELOCITY_INLET,
    WINDKESSEL,
    Fields,
    Parameters,
    Stepping,
    Workspace,
)
from solver.schemes.vectorisation import inlined_kernel, kernel, part_of_kernel, summing_kernel
from solver.schemes.walls import wall_area

INLET, OUTLET = 0, 1


@summing_kernel
def section_flow(p: Parameters, flow: Floats) -> float:
    """Flow rate of a section ½∮Q dφ from its rows, m³/s."""
    total = 0.0
    for j in range(flow.size):
        total += flow[j]
    return p.sector * total


@part_of_kernel
def _end_wall(p: Parameters, ws: Workspace, end: int, pressure: Floats, area: Floats) -> tuple[int, int, int]:
    """Apply the wall law of the cells at an end to a row of pressures; status, i, j."""
    first = 0 if end == INLET else ws.mean_area.shape[0] - 1
    rows = (1, pressure.size)
    slope = ws.end_slope[end]
    return wall_area(p, first, pressure.reshape(rows), area.reshape(rows), slope.reshape(rows))


@part_of_kernel
def old_end_areas(p: Parameters, ws: Workspace, fields: Fields) -> tuple[int, int, int]:
    """Apply the wall law to the old end pressures; status, i, j."""
    status, i, j = _end_wall(p, ws, OUTLET, fields.outlet_pressure, ws.old_end_area[OUTLET])
    if status != OK or p.inlet_kind != PRESSURE_INLET:
        return status, i, j
    return _end_wall(p, ws, INLET, fields.inlet_pressure, ws.old_end_area[INLET])


@inlined_kernel
def end_areas(p: Parameters, ws: Workspace, theta: float) -> tuple[int, int, int]:
    """Mean A at the ends from the iterate's end pressures; status, i, j."""
    for end in (OUTLET, INLET):
        if end == INLET and p.inlet_kind != PRESSURE_INLET:
            continue
        status, i, j = _end_wall(p, ws, end, ws.end_pressure[end], ws.end_area[end])
        if status != OK:
            return status, i, j
        for k in range(ws.end_area.shape[1]):
            ws.end_area[end, k] = (1.0 - theta) * ws.old_end_area[end, k] + theta * ws.end_area[end, k]
    return OK, 0, 0


@kernel
def face_areas(mean_area: Floats, end_area: Floats, inlet_kind: int, area: Floats) -> None:
    """Mean areas of all faces: half-way between cells, at the ends from the end's pressure.

    At a velocity or flow inlet, which has no pressure of its own, half a cell beyond the first two cells.
    """
    (n_x, n), cells, faces = mean_area.shape, mean_area.flat, area.flat
    for k in range(n, mean_area.size):
        faces[k] = 0.5 * (cells[k - n] + cells[k])
    for j in range(n):
        area[n_x, j] = end_area[OUTLET, j]
        if inlet_kind == PRESSURE_INLET:
            area[0, j] = end_area[INLET, j]
        else:
            area[0, j] = 1.5 * mean_area[0, j] - 0.5 * mean_area[1, j]


@inlined_kernel
def inlet_flow(p: Parameters, ws: Workspace, value: float, flow: Floats) -> None:
    """Q' = vA' of a velocity inlet, or with v = q/½∮A' dφ of a flow inlet, at the iterate's area."""
    area = ws.iterate_area
    for j in range(flow.size):
        flow[j] = 1.5 * area[0, j] - 0.5 * area[1, j]
    velocity = value
    if p.inlet_kind == FLOW_INLET:
        velocity = value / section_flow(p, flow)
    for j in range(flow.size):
        flow[j] *= velocity


@kernel
def inlet_slopes(p: Parameters, value: float) -> tuple[float, float]:
    """∂Q'/∂A of the first two cells at a velocity inlet, m/s; 0 at others."""
    if p.inlet_kind == VELOCITY_INLET:
        return 1.5 * value, -0.5 * value
    return 0.0, 0.0


@inlined_kernel
def half_cell(p: Parameters, s: Stepping, ws: Workspace, fields: Fields, end: int) -> None:
    """Momentum of the half cell at an end: G and κ of its face."""
    theta, dt, half = s.theta, s.time_step, 0.5 * p.dx
    n_x, n_phi = ws.mean_area.shape
    f, i, out = (0, 0, -1.0) if end == INLET else (n_x, n_x - 1, 1.0)  # out: from the cell to the face
    old_end = fields.inlet_pressure if end == INLET else fields.outlet_pressure
    for j in range(n_phi):
        area, q, damping = ws.end_area[end, j], ws.mean_flow[f, j], ws.damping[f, j]
        end_flux = ws.alpha[f, j] * q * q / area
        drive = dt * area / (p.density * half)
        end_mean = (1.0 - theta) * old_end[j] + theta * ws.end_pressure[end, j]
        advection = out * dt / half * (end_flux - ws.momentum_flux[i, j])
        inverse = 1.0 / (1.0 - theta * damping)
        rest = fields.flow[f, j] * (1.0 + (1.0 - theta) * damping) - advection
        difference = out * (end_mean - ws.mean_pressure[i, j])
        ws.explicit_flow[f, j] = (rest - drive * difference) * inverse
        ws.conductance[f, j] = theta * drive * inverse


@inlined_kernel
def outlet_law(p: Parameters, s: Stepping, ws: Workspace, fields: Fields, offset: float) -> None:
    """Write the outlet as P' = a + b × flow of the section or the row, into ``law``."""
    a, b = ws.law[0], ws.law[1]
    if p.outlet_kind == NON_REFLECTING:
        _non_reflecting_law(p, ws, fields)
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


@inlined_kernel
def _non_reflecting_law(p: Parameters, ws: Workspace, fields: Fields) -> None:
    """No wave enters: Q' − Q − Δt S Q = λ₊ (A' − A) (2.2.41), with A' − A = dA/dP (P' − P)."""
    f = fields.flow.shape[0] - 1
    a, b = ws.law[0], ws.law[1]
    for j in range(a.size):
        area, slope, alpha = ws.end_area[OUTLET, j], ws.end_slope[OUTLET, j], ws.alpha[f, j]
        q = ws.mean_flow[f, j]
        u = q / area
        wave = alpha * u + np.sqrt(area / (p.density * slope) + u * u * alpha * (alpha - 1.0))
        b[j] = 1.0 / (wave * slope)
        a[j] = fields.outlet_pressure[j] - b[j] * (fields.flow[f, j] + ws.damping[f, j] * q)


@inlined_kernel
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
            total_flow += p.sector * base
            total_slope += p.sector * slope
    if not by_row:
        gap = a[0] + b[0] * total_flow - ws.end_pressure[OUTLET, 0]
        for j in range(a.size):
            _close_last_cell(ws, j, c, gap / (1.0 + b[0] * total_slope))


@inlined_kernel
def _close_last_cell(ws: Workspace, j: int, c: float, change: float) -> None:
    n_x = ws.mean_area.shape[0]
    k = ws.conductance[n_x, j]
    closed = (ws.correction[n_x - 1, j] + c * k * change) * ws.inverse_pivot[n_x - 1, j]
    ws.correction[n_x - 1, j] = closed
    ws.end_pressure[OUTLET, j] += change
    ws.explicit_flow[n_x, j] -= k * (change - closed)


@kernel
def update_reservoir(p: Parameters, fields: Fields, new_flow: Floats) -> None:
    """Pressure of the Windkessel's capacitor after the step: P_c' = P' − R₁ q'."""
    if p.outlet_kind == WINDKESSEL:
        fields.reservoir[0] = fields.outlet_pressure[0] - p.resistance * section_flow(p, new_flow)
