"""Staggered, pressure-implicit scheme with one pressure a section: numba kernels.

Unknowns are P(x), one number a section, and Q(x, φ); A(x, φ) follows from P. Rows exchange the azimuthal
flux W = 2∫₀^R v_φ dr, which their mass balance gives. One step solves, with θ the implicitness and
coefficients at the θ-weighted mean of old state and iterate (marked ¯),

    Σ_j [ (A_j(P') − A_j)/Δt + ∂_x[θQ_j' + (1−θ)Q_j] ] = 0
    (Q' − Q)/Δt + ∂_x(αQ²/A)¯ + ∂_φ(uW)¯ + (Ā/ρ) ∂_x[θP' + (1−θ)P] = S̄ [θQ' + (1−θ)Q]

with S and the closure for γ as in :mod:`solver.schemes.rows.step`, all differences central.

Iteration. With one pressure a section nothing restores a single row's Q, and αuΔt/Δx reaches 3 at systole:
advection must be implicit. Each sweep solves the linearised balances with one advection operator for all
rows of a section, the mean of theirs. Its sum over the rows, with P' eliminated by mass, is one tridiagonal
system for the sections' flow; then each row follows from one tridiagonal system with the same matrix, so
that the rows sum up to the section. What the mean operator leaves out shrinks about tenfold a sweep.
"""

import numpy as np

from cases.arrays import Floats
from solver.schemes.convergence import remaining
from solver.schemes.course import Course, Record, keep, stepping
from solver.schemes.layout import NOT_CONVERGED, NOT_FINITE, OK, PRESSURE_INLET, Stepping
from solver.schemes.sections.ends import (
    end_face_areas,
    end_walls,
    inlet_balance,
    outlet_balance,
    outlet_law,
    share_outlet,
    spread,
    update_reservoir,
)
from solver.schemes.sections.layout import Fields, Parameters, Workspace
from solver.schemes.sections.rows import (
    areas_between,
    copied,
    cross_flows,
    momentum_balance,
    momentum_fluxes,
    profiles,
    scaled_rows,
    section_sums,
    solve_rows,
    take_change,
    wall_areas,
    weighted,
)
from solver.schemes.vectorisation import inlined_kernel, kernel, part_of_kernel, summing_kernel

LOWER, MIDDLE, UPPER = 0, 1, 2


@inlined_kernel
def mass_balance(s: Stepping, p: Parameters, ws: Workspace) -> None:
    """Mass balance of every section at the iterate, summed over φ."""
    ratio = s.time_step / p.dx
    for i in range(ws.mass.size):
        divergence = ratio * (ws.flow_sum[i + 1] - ws.flow_sum[i])
        ws.mass[i] = ws.old_area_sum[i] - ws.area_sum[i] - divergence


@inlined_kernel
def advection_matrix(s: Stepping, p: Parameters, ws: Workspace, outlet_slope: float) -> None:
    """Advection and friction of all rows of a section, by their mean: tridiagonal on faces."""
    lower, middle, upper = ws.matrix[LOWER], ws.matrix[MIDDLE], ws.matrix[UPPER]
    ratio, last = s.time_step / p.dx, ws.mass.size
    slopes, damping = ws.flux_slope, ws.mean_damping
    lower[0], middle[0], upper[0] = 0.0, 1.0, 0.0
    if p.inlet_kind == PRESSURE_INLET:
        middle[0] = 1.0 - s.theta * damping[0]
    for f in range(1, last):
        lower[f] = -ratio * slopes[f - 1]
        upper[f] = ratio * slopes[f]
        middle[f] = 1.0 - s.theta * damping[f] + upper[f] + lower[f]
    lower[last] = -2.0 * ratio * slopes[last - 1]
    upper[last] = 0.0
    middle[last] = 1.0 - s.theta * damping[last] + 2.0 * ratio * outlet_slope + lower[last]


@inlined_kernel
def section_matrix(s: Stepping, p: Parameters, ws: Workspace, gap: float, answer: float) -> None:
    """Section's flow with the pressure eliminated: δP = (mass − c ∂δq)/Σ(dA/dP); into matrix and ``total``.

    ``gap`` and ``answer`` are the outlet's: δP = gap + answer δq.
    """
    copied(ws.matrix, ws.section_matrix)
    lower, middle, upper = ws.section_matrix[LOWER], ws.section_matrix[MIDDLE], ws.section_matrix[UPPER]
    c, last = s.theta * s.time_step / p.dx, ws.mass.size
    pull = s.theta * s.time_step / (p.density * p.dx)
    slopes, mass, total = ws.slope_sum, ws.mass, ws.total
    for f in range(1, last):
        k = pull * ws.area_total[f]
        left, right = k * c / slopes[f - 1], k * c / slopes[f]
        lower[f] -= left
        middle[f] += left + right
        upper[f] -= right
        total[f] -= k * (mass[f] / slopes[f] - mass[f - 1] / slopes[f - 1])
    k = 2.0 * pull * ws.area_total[last]
    left = k * c / slopes[last - 1]
    lower[last] -= left
    middle[last] += left + k * answer
    total[last] -= k * (gap - mass[last - 1] / slopes[last - 1])
    if p.inlet_kind == PRESSURE_INLET:
        k = 2.0 * pull * ws.area_total[0]
        right = k * c / slopes[0]
        middle[0] += right
        upper[0] -= right
        total[0] -= k * mass[0] / slopes[0]


@kernel
def thomas(matrix: Floats, right: Floats, solution: Floats) -> None:
    """Solve a tridiagonal system; the middle is overwritten."""
    lower, middle, upper = matrix[LOWER], matrix[MIDDLE], matrix[UPPER]
    last = right.size - 1
    solution[0] = right[0]
    for f in range(1, last + 1):
        factor = lower[f] / middle[f - 1]
        middle[f] -= factor * upper[f - 1]
        solution[f] = right[f] - factor * solution[f - 1]
    solution[last] /= middle[last]
    for f in range(last - 1, -1, -1):
        solution[f] = (solution[f] - upper[f] * solution[f + 1]) / middle[f]


@inlined_kernel
def section_change(s: Stepping, p: Parameters, ws: Workspace, gap: float, answer: float) -> float:
    """δP everywhere, taken by the iterate, and its pull on the rows, into ``total``; Σ of δP squared."""
    c, n_x = s.theta * s.time_step / p.dx, ws.mass.size
    change, squares = ws.change, 0.0
    for i in range(n_x):
        ws.mass[i] = (ws.mass[i] - c * (change[i + 1] - change[i])) / ws.slope_sum[i]
        ws.iterate_pressure[i + 1] += ws.mass[i]
        squares += ws.mass[i] * ws.mass[i]
    outlet = gap + answer * change[n_x]
    ws.iterate_pressure[n_x + 1] += outlet
    pull = s.theta * s.time_step / (p.density * p.dx)
    for f in range(1, n_x):
        ws.total[f] = pull * (ws.mass[f] - ws.mass[f - 1])
    ws.total[n_x] = 2.0 * pull * (outlet - ws.mass[n_x - 1])
    return squares


@inlined_kernel
def drive_of(s: Stepping, p: Parameters, old: Floats, new: Floats, drive: Floats) -> None:
    """Δt/(ρΔx) times the θ-weighted pressure's rise over each face; half cells at the ends."""
    scale, last = s.time_step / (p.density * p.dx), drive.size - 1
    for f in range(last + 1):
        rise = (1.0 - s.theta) * (old[f + 1] - old[f]) + s.theta * (new[f + 1] - new[f])
        drive[f] = scale * rise
    drive[0] *= 2.0
    drive[last] *= 2.0


@part_of_kernel
def _evaluate(p: Parameters, s: Stepping, ws: Workspace, fields: Fields) -> tuple[int, int, int]:
    """Everything that the balances need at the iterate; status, section and row."""
    n_x = fields.area.shape[0]
    status, i = wall_areas(
        p.table,
        p.sums,
        p.table_start,
        p.table_step,
        ws.iterate_pressure[1 : n_x + 1],
        ws.iterate_area,
        ws.area_sum,
        ws.slope_sum,
    )
    if status == OK:
        areas_between(fields.area, ws.iterate_area, s.theta, ws.mean_area, ws.face_area)
        weighted(fields.flow, ws.iterate_flow, s.theta, ws.mean_flow, ws.flow_sum)
        status, i = end_face_areas(p, ws, s.theta)
    if status != OK:
        return status, i, 0
    scale = s.time_step * p.kinematic_viscosity
    status, f, j = profiles(
        ws.mean_flow,
        ws.face_area,
        ws.velocity,
        ws.alpha,
        ws.damping,
        ws.mean_damping,
        ws.area_total,
        ws.scratch,
        p.fixed_exponent,
        scale,
        p.dphi,
    )
    if status != OK:
        return status, min(f, n_x - 1), j
    momentum_fluxes(ws.mean_flow, ws.mean_area, ws.alpha, s.theta, ws.flux, ws.flux_slope)
    cross_flows(
        fields.area,
        ws.iterate_area,
        ws.mean_flow,
        1.0 / s.time_step,
        p.dx,
        p.dphi,
        ws.scratch,
        ws.cross_flow,
    )
    return OK, 0, 0


@part_of_kernel
def _sweep(
    p: Parameters, s: Stepping, ws: Workspace, fields: Fields, value: float, offset: float
) -> tuple[int, int, int, float]:
    """From one iterate to the next; status, section, row and Σ of δP squared."""
    status, i, j = _evaluate(p, s, ws, fields)
    if status != OK:
        return status, i, j, 0.0
    n_x = fields.area.shape[0]
    drive = ws.change
    drive_of(s, p, fields.pressure, ws.iterate_pressure, drive)
    momentum_balance(
        fields.flow,
        ws.iterate_flow,
        ws.mean_flow,
        ws.damping,
        ws.flux,
        ws.cross_flow,
        ws.velocity,
        ws.face_area,
        drive,
        s.time_step / p.dx,
        s.time_step / p.dphi,
        ws.scratch[0],
        ws.residual,
        ws.total,
    )
    inlet_balance(p, s, ws, fields, value, float(drive[0]))
    outlet_slope = outlet_balance(p, s, ws, fields, float(drive[n_x]))
    a, b = outlet_law(p, s, ws, fields, offset)
    outflow = 0.0
    for flow in ws.iterate_flow[n_x]:
        outflow += flow
    gap = a + b * outflow - ws.iterate_pressure[n_x + 1]
    mass_balance(s, p, ws)
    advection_matrix(s, p, ws, outlet_slope)
    section_matrix(s, p, ws, gap, b)
    thomas(ws.section_matrix, ws.total, ws.change)
    squares = section_change(s, p, ws, gap, b)
    spread(float(ws.change[0]), ws.residual[0], ws.scratch[3])
    shared = share_outlet(ws, outflow + float(ws.change[n_x]))
    solve_rows(ws.residual, ws.face_area, ws.total, ws.matrix, shared)
    return OK, 0, 0, squares


@summing_kernel
def extrapolate(new: Floats, older: Floats, oldest: Floats, guess: Floats, order: int) -> None:
    """First iterate: the old state, or its extrapolation in time of order 1 or 2; remember the past."""
    a = (1.0, 2.0, 3.0)[order]
    b = (0.0, -1.0, -3.0)[order]
    c = (0.0, 0.0, 1.0)[order]
    flat, past, before, target = new.ravel(), older.ravel(), oldest.ravel(), guess.ravel()
    for k in range(flat.size):
        target[k] = a * flat[k] + b * past[k] + c * before[k]
        before[k] = past[k]
        past[k] = flat[k]


@part_of_kernel
def step(
    p: Parameters, s: Stepping, ws: Workspace, fields: Fields, value: float, offset: float, order: int
) -> tuple[int, int, int, int]:
    """Advance the fields in place by one Δt.

    Parameters
    ----------
    p, s, ws, fields : Parameters, Stepping, Workspace, Fields
    value : float
        v (m/s), q (m³/s) or P (Pa) at the inlet at the new time, by its kind.
    offset : float
        P_res at the new time, Pa.
    order : int
        Order of the first iterate's extrapolation in time: 0, or 1 or 2 if the workspace holds so many
        steps before, of the same Δt.

    Returns
    -------
    status, i, j, sweeps : int
        OK or what failed, the cell counted from 0, and the sweeps used.
    """
    extrapolate(fields.pressure, ws.older_pressure, ws.oldest_pressure, ws.iterate_pressure, order)
    extrapolate(fields.flow, ws.older_flow, ws.oldest_flow, ws.iterate_flow, order)
    section_sums(fields.area, ws.old_area_sum)
    section_sums(fields.flow, ws.old_flow_sum)
    status, i = end_walls(p, fields.pressure, ws.old_end_area)
    if status != OK:
        return status, i, 0, 0
    if p.inlet_kind == PRESSURE_INLET:
        ws.iterate_pressure[0] = value
    flow_before, pressure_before = 0.0, 0.0
    for sweep in range(1, s.max_sweeps + 1):
        status, i, j, squares = _sweep(p, s, ws, fields, value, offset)
        if status != OK:
            return status, i, j, sweep
        change, size = take_change(ws.residual, ws.iterate_flow, ws.new_flow_sum)
        level = 0.0
        for pressure in ws.iterate_pressure[1:-1]:
            level += pressure * pressure
        if not np.isfinite(change + size + squares + level):
            return NOT_FINITE, 0, 0, sweep
        rest_flow = p.rest_flow * np.sqrt(ws.residual.size)
        rest_pressure = 1e-9 * np.sqrt(ws.mass.size) + 1e-12 * np.sqrt(level)
        flow_change, pressure_change = np.sqrt(change), np.sqrt(squares)
        flow_error = min(flow_change, remaining(flow_change, flow_before))
        pressure_error = min(pressure_change, remaining(pressure_change, pressure_before))
        flow_before, pressure_before = flow_change, pressure_change
        flow_converged = flow_error <= s.tolerance * np.sqrt(size) + rest_flow
        if flow_converged and pressure_error <= s.tolerance * np.sqrt(level) + rest_pressure:
            accept(p, s, ws, fields)
            return OK, 0, 0, sweep
    return NOT_CONVERGED, 0, 0, s.max_sweeps


@inlined_kernel
def accept(p: Parameters, s: Stepping, ws: Workspace, fields: Fields) -> None:
    """Take the iterate as the new state; ΣA' from the fluxes, so that mass is kept to round-off.

    A of the last sweep is scaled to it: the sections' pressures changed since by less than the tolerance.
    """
    n_x = fields.area.shape[0]
    if p.inlet_kind != PRESSURE_INLET:
        ws.iterate_pressure[0] = 1.5 * ws.iterate_pressure[1] - 0.5 * ws.iterate_pressure[2]
    for f in range(n_x + 1):
        ws.flow_sum[f] = (1.0 - s.theta) * ws.old_flow_sum[f] + s.theta * ws.new_flow_sum[f]
    mass_balance(s, p, ws)
    for i in range(n_x):
        ws.mass[i] = 1.0 + ws.mass[i] / ws.area_sum[i]
    scaled_rows(ws.iterate_area, ws.mass, fields.area)
    volume = 0.5 * p.dphi * s.time_step
    ws.exchanged[0] += volume * ws.flow_sum[0]
    ws.exchanged[1] += volume * ws.flow_sum[n_x]
    copied(ws.iterate_flow, fields.flow)
    for i in range(fields.pressure.size):
        fields.pressure[i] = ws.iterate_pressure[i]
    update_reservoir(p, fields, 0.5 * p.dphi * float(ws.new_flow_sum[n_x]))


@kernel
def advance(
    p: Parameters, course: Course, ws: Workspace, fields: Fields, state: Floats, record: Record
) -> tuple[int, int, int, int]:
    """Take the steps of a course; ``state`` is the array that holds the fields.

    Returns
    -------
    status, i, j, steps : int
        As :func:`step`; steps completed.
    """
    count = course.inlet_values.shape[1]
    for k in range(course.time_step.size):
        s = stepping(course, k)
        n, known = 0, 0
        while n < count:
            values = course.inlet_values[k, n], course.outlet_offsets[k, n]
            status, i, j, sweeps = step(p, s, ws, fields, values[0], values[1], min(known, 2))
            record.sweeps[k] += sweeps
            if status == OK:
                n, known = n + 1, known + 1
            elif known > 0:  # the past may be a jump, from which no state can be extrapolated
                known = 0
            else:
                return status, i, j, k * count + n
        keep(record, k, state, ws.exchanged)
    return OK, 0, 0, course.inlet_values.size
