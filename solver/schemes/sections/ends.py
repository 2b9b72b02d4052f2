"""Inlet and outlet with one pressure a section: half cells and boundary laws (numba kernels).

At the inlet all rows share one mean velocity, as they do at the outlet while blood enters there: with one
pressure a section nothing else says how what enters is spread over the rows.
"""

import numpy as np

from cases.arrays import Floats
from solver.schemes.layout import (
    FLOW_INLET,
    NON_REFLECTING,
    OK,
    PRESSURE_INLET,
    ROW_RESISTANCE,
    WINDKESSEL,
    Stepping,
)
from solver.schemes.sections.layout import Fields, Parameters, Workspace
from solver.schemes.sections.rows import wall_row, wall_sum
from solver.schemes.vectorisation import inlined_kernel

INLET, OUTLET = 0, 1


@inlined_kernel
def end_walls(p: Parameters, pressure: Floats, end_area: Floats) -> tuple[int, int]:
    """Find A at the outlet, and at a pressure inlet, from end pressures; status and section."""
    n_x = p.table.shape[0]
    start, step = p.table_start, p.table_step
    status = wall_row(p.table[n_x - 1], start, step, pressure[n_x + 1], end_area[OUTLET])
    if status != OK or p.inlet_kind != PRESSURE_INLET:
        return status, n_x - 1
    return wall_row(p.table[0], start, step, pressure[0], end_area[INLET]), 0


@inlined_kernel
def end_face_areas(p: Parameters, ws: Workspace, theta: float) -> tuple[int, int]:
    """θ-weighted A of the two end faces; status and section."""
    status, i = end_walls(p, ws.iterate_pressure, ws.end_area)
    if status != OK:
        return status, i
    n_x, n = ws.mean_area.shape
    for j in range(n):
        old, new = ws.old_end_area[OUTLET, j], ws.end_area[OUTLET, j]
        ws.face_area[n_x, j + 1] = (1.0 - theta) * old + theta * new
    for j in range(n):
        if p.inlet_kind == PRESSURE_INLET:
            old, new = ws.old_end_area[INLET, j], ws.end_area[INLET, j]
            ws.face_area[0, j + 1] = (1.0 - theta) * old + theta * new
        else:
            ws.face_area[0, j + 1] = 1.5 * ws.mean_area[0, j] - 0.5 * ws.mean_area[1, j]
    return OK, 0


@inlined_kernel
def inlet_balance(
    p: Parameters, s: Stepping, ws: Workspace, fields: Fields, value: float, drive: float
) -> None:
    """Balance the inlet: δQ but for a change of the section's flow, and Σ of the balance.

    ``drive`` is Δt/(ρΔx/2) times the θ-weighted pressure's rise from the inlet to the first section.
    """
    residual, n = ws.residual[0], ws.residual.shape[1]
    shares, total = ws.scratch[3], 0.0
    for j in range(n):
        if p.inlet_kind == PRESSURE_INLET:
            shares[j] = ws.end_area[INLET, j]
        else:
            shares[j] = 1.5 * ws.iterate_area[0, j] - 0.5 * ws.iterate_area[1, j]
        total += shares[j]
    section = 0.0
    for j in range(n):
        section += ws.iterate_flow[0, j]
    velocity = value
    if p.inlet_kind == PRESSURE_INLET:
        velocity = section / total
    elif p.inlet_kind == FLOW_INLET:
        velocity = value / (0.5 * p.dphi * total)
    balance = 0.0
    for j in range(n):
        residual[j] = velocity * shares[j] - ws.iterate_flow[0, j]
        balance += residual[j]
        shares[j] /= total
    if p.inlet_kind == PRESSURE_INLET:
        balance = 0.0
        carry = s.time_step / (0.5 * p.dx)
        for j in range(n):
            q, area = ws.mean_flow[0, j], ws.face_area[0, j + 1]
            rest = fields.flow[0, j] - ws.iterate_flow[0, j] + ws.damping[0, j] * q - drive * area
            balance += rest + carry * (ws.alpha[0, j] * q * q / area - ws.flux[0, j])
    ws.total[0] = balance


@inlined_kernel
def outlet_balance(p: Parameters, s: Stepping, ws: Workspace, fields: Fields, drive: float) -> float:
    """Momentum balance of the outlet's half cell; returns θ times the mean of ∂(αQ²/A)/∂Q there."""
    n_x, n = ws.flux.shape
    carry, exchange = s.time_step / (0.5 * p.dx), s.time_step / p.dphi
    carried, residual = ws.scratch[0], ws.residual[n_x]
    for j in range(n):
        between = 0.5 * exchange * ws.cross_flow[n_x - 1, j]
        carried[j] = between * (ws.velocity[n_x, j] + ws.velocity[n_x, j + 1])
    carried[n] = carried[0]
    total, slopes = 0.0, 0.0
    for j in range(n):
        q, area = ws.mean_flow[n_x, j], ws.face_area[n_x, j + 1]
        momentum = ws.alpha[n_x, j] * q / area
        rest = fields.flow[n_x, j] - ws.iterate_flow[n_x, j] + ws.damping[n_x, j] * q - drive * area
        rest -= carry * (momentum * q - ws.flux[n_x - 1, j]) + (carried[j + 1] - carried[j])
        residual[j] = rest
        total += rest
        slopes += 2.0 * momentum
    ws.total[n_x] = total
    return float(s.theta * slopes / n)


@inlined_kernel
def outlet_law(
    p: Parameters, s: Stepping, ws: Workspace, fields: Fields, offset: float
) -> tuple[float, float]:
    """Write the outlet as P' = a + b ΣQ'; a resistance by row takes the mean of the rows' answers."""
    n_x, n = ws.flux.shape
    sector = 0.5 * p.dphi
    if p.outlet_kind == ROW_RESISTANCE:
        return offset, p.resistance / n
    if p.outlet_kind == WINDKESSEL:
        gain = s.time_step / p.capacitance
        leak = gain / p.distal_resistance
        old = 0.0
        for j in range(n):
            old += sector * fields.flow[n_x, j]
        held = fields.reservoir[0] * (1.0 - (1.0 - s.theta) * leak)
        held += gain * (1.0 - s.theta) * old + leak * p.venous_pressure
        series = p.resistance + s.theta * gain / (1.0 + s.theta * leak)
        return held / (1.0 + s.theta * leak), sector * series
    if p.outlet_kind == NON_REFLECTING:
        return _non_reflecting_law(p, ws, fields)
    return offset, sector * p.resistance


@inlined_kernel
def _non_reflecting_law(p: Parameters, ws: Workspace, fields: Fields) -> tuple[float, float]:
    """No wave enters: q' − q − Δt S q = λ₊ (S' − S) (2.2.41) of the section's sums."""
    n_x, n = ws.flux.shape
    _, slope = wall_sum(p.sums[n_x - 1], p.table_start, p.table_step, ws.iterate_pressure[n_x + 1])
    area, flow, old, damped, alpha = 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(n):
        area += ws.face_area[n_x, j + 1]
        flow += ws.mean_flow[n_x, j]
        old += fields.flow[n_x, j]
        damped += ws.damping[n_x, j] * ws.mean_flow[n_x, j]
        alpha += ws.alpha[n_x, j] / n
    u = flow / area
    wave = alpha * u + np.sqrt(area / (p.density * slope) + u * u * alpha * (alpha - 1.0))
    b = 1.0 / (wave * slope)
    return fields.pressure[n_x + 1] - b * (old + damped), b


@inlined_kernel
def spread(change: float, base: Floats, shares: Floats) -> None:
    """Spread a section's change over its rows: what they have, and the rest by their shares, in place."""
    total = 0.0
    for j in range(base.size):
        total += base[j]
    for j in range(base.size):
        base[j] += (change - total) * shares[j]


@inlined_kernel
def share_outlet(ws: Workspace, section_flow: float) -> bool:
    """Where blood enters through the outlet: δQ that gives all rows one velocity; whether it does."""
    if section_flow >= 0.0:
        return False
    n_x, n = ws.flux.shape
    total = 0.0
    for j in range(n):
        total += ws.end_area[OUTLET, j]
    for j in range(n):
        ws.residual[n_x, j] = section_flow * ws.end_area[OUTLET, j] / total - ws.iterate_flow[n_x, j]
    return True


@inlined_kernel
def update_reservoir(p: Parameters, fields: Fields, section_flow: float) -> None:
    """Pressure of the Windkessel's capacitor after the step: P_c' = P' − R₁ q'."""
    if p.outlet_kind == WINDKESSEL:
        fields.reservoir[0] = fields.pressure[fields.pressure.size - 1] - p.resistance * section_flow
