"""Inlet and outlet of sections with two modes: where their balances hold the profile (numba kernels)."""

from solver.schemes.layout import NON_REFLECTING, PRESSURE_INLET, Stepping
from solver.schemes.sections.ends import inlet_balance, outlet_law
from solver.schemes.sections.rows import wall_sum
from solver.schemes.two_modes.layout import Fields, Parameters, Workspace
from solver.schemes.two_modes.profiles import momentum_of, momentum_slopes, outgoing_wave
from solver.schemes.vectorisation import inlined_kernel


@inlined_kernel
def inlet_sums(p: Parameters, s: Stepping, ws: Workspace, fields: Fields, value: float, drive: float) -> None:
    """Balance of the inlet as :func:`solver.schemes.sections.ends.inlet_balance`."""
    w, m = ws.base, p.modes
    inlet_balance(p.base, s, w, fields.base, value, drive)
    if p.base.inlet_kind != PRESSURE_INLET:
        return
    balance, carry, d = 0.0, s.time_step / (0.5 * p.base.dx), ws.mean_axis[0]
    for j in range(w.residual.shape[1]):
        q, area = w.mean_flow[0, j], w.face_area[0, j + 1]
        rest = fields.flow[0, j] - w.iterate_flow[0, j] + w.damping[0, j] * q + ws.excess[0, j] - drive * area
        balance += rest + carry * (area * momentum_of(m, q / area, d) - w.flux[0, j])
    w.total[0] = balance


@inlined_kernel
def outlet_sums(
    p: Parameters, s: Stepping, ws: Workspace, fields: Fields, drive: float
) -> tuple[float, float]:
    """Momentum balance of the outlet's half cell; θ times mean ∂flux/∂Q of the section and of rows."""
    w, m = ws.base, p.modes
    n_x, n = w.flux.shape
    carry, exchange = s.time_step / (0.5 * p.base.dx), s.time_step / p.base.dphi
    carried, residual, d = w.scratch[0], w.residual[n_x], ws.mean_axis[n_x]
    for j in range(n):
        between = 0.5 * exchange * w.cross_flow[n_x - 1, j]
        carried[j] = between * (w.velocity[n_x, j] + w.velocity[n_x, j + 1])
    carried[n] = carried[0]
    total, of_section, of_row = 0.0, 0.0, 0.0
    for j in range(n):
        q, area = w.mean_flow[n_x, j], w.face_area[n_x, j + 1]
        rest = fields.flow[n_x, j] - w.iterate_flow[n_x, j] + w.damping[n_x, j] * q + ws.excess[n_x, j]
        leaving = area * momentum_of(m, q / area, d) - w.flux[n_x - 1, j]
        residual[j] = rest - drive * area - carry * leaving - (carried[j + 1] - carried[j])
        total += residual[j]
        by_row, by_section = momentum_slopes(m, q / area, d)
        of_row += by_row
        of_section += by_section
    w.total[n_x] = total
    return s.theta * of_section / n, s.theta * of_row / n


@inlined_kernel
def law_of_outlet(
    p: Parameters, s: Stepping, ws: Workspace, fields: Fields, offset: float
) -> tuple[float, float]:
    """Write the outlet as P' = a + b ΣQ'."""
    if p.base.outlet_kind != NON_REFLECTING:
        return outlet_law(p.base, s, ws.base, fields.base, offset)
    w, b = ws.base, p.base
    n_x, n = w.flux.shape
    _, slope = wall_sum(b.sums[n_x - 1], b.table_start, b.table_step, w.iterate_pressure[n_x + 1])
    area, flow, old = 0.0, 0.0, 0.0
    for j in range(n):
        area += w.face_area[n_x, j + 1]
        flow += w.mean_flow[n_x, j]
        old += fields.flow[n_x, j] + w.damping[n_x, j] * w.mean_flow[n_x, j] + ws.excess[n_x, j]
    wave = outgoing_wave(p.modes, flow / area, ws.mean_axis[n_x], area / (b.density * slope))
    answer = 1.0 / (wave * slope)
    return fields.base.pressure[n_x + 1] - answer * old, answer


@inlined_kernel
def inlet_velocity(ws: Workspace) -> float:
    """Mean velocity of all rows at a velocity or flow inlet, of the iterate."""
    w, total, flow = ws.base, 0.0, 0.0
    for j in range(w.flux.shape[1]):
        total += 1.5 * w.iterate_area[0, j] - 0.5 * w.iterate_area[1, j]
        flow += w.iterate_flow[0, j]
    return float(flow / total)
