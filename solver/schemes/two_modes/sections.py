"""One pressure a section with profiles of two modes (numba kernels).

Balances and iteration are those of :mod:`solver.schemes.sections.step`, with

    (Q' − Q)/Δt + ∂_x(A 2∫v²y dy)¯ + ∂_φ(uW)¯ + (Ā/ρ) ∂_x[θP' + (1−θ)P] = friction¯ + exchange around¯

and D on faces: the section's mean, or after each sweep the answer of the axis to the new pressures. A sweep's
advection operator is that of a section, with which D changes; rows deviate from it by one of their own, which
also holds a share of the exchange around, so that many rows do not call for short steps.
"""

import numpy as np

from cases.arrays import Floats
from solver.schemes.convergence import remaining
from solver.schemes.course import Course, Record, keep, stepping
from solver.schemes.layout import NOT_CONVERGED, NOT_FINITE, OK, PRESSURE_INLET, REST_VELOCITY, Stepping
from solver.schemes.sections.ends import end_face_areas, end_walls, share_outlet, spread
from solver.schemes.sections.rows import (
    areas_between,
    cross_flows,
    momentum_balance,
    section_sums,
    solve_rows,
    take_change,
    wall_areas,
    weighted,
)
from solver.schemes.sections.step import (
    accept,
    advection_matrix,
    drive_of,
    extrapolate,
    mass_balance,
    section_change,
    section_matrix,
    thomas,
)
from solver.schemes.two_modes.axis import axis_momentum, taken
from solver.schemes.two_modes.ends import inlet_sums, inlet_velocity, law_of_outlet, outlet_sums
from solver.schemes.two_modes.layout import Fields, Parameters, Workspace
from solver.schemes.two_modes.profiles import (
    exchange_share,
    fluxes,
    section_means,
    viscous_terms,
    weighted_axis,
)
from solver.schemes.vectorisation import inlined_kernel, kernel, part_of_kernel


@part_of_kernel
def _evaluate(p: Parameters, s: Stepping, ws: Workspace, fields: Fields) -> tuple[int, int, int]:
    """Everything that the balances need at the iterate; status, section and row."""
    b, w = p.base, ws.base
    n_x = fields.area.shape[0]
    status, i = wall_areas(
        b.table,
        b.sums,
        b.table_start,
        b.table_step,
        w.iterate_pressure[1 : n_x + 1],
        w.iterate_area,
        w.area_sum,
        w.slope_sum,
    )
    if status == OK:
        areas_between(fields.area, w.iterate_area, s.theta, w.mean_area, w.face_area)
        weighted(fields.flow, w.iterate_flow, s.theta, w.mean_flow, w.flow_sum)
        status, i = end_face_areas(b, w, s.theta)
    if status != OK:
        return status, i, 0
    velocities(w.mean_flow, w.face_area, w.velocity, w.area_total)
    if p.modes.momentum:
        weighted_axis(s.theta, fields.axis_velocity, ws.axis, ws.mean_axis)
    else:
        section_means(w.velocity, p.modes.share, ws.mean_axis)
    _profiles(p, s, ws)
    cross_flows(
        fields.area,
        w.iterate_area,
        w.mean_flow,
        1.0 / s.time_step,
        b.dx,
        b.dphi,
        w.scratch,
        w.cross_flow,
    )
    return OK, 0, 0


@inlined_kernel
def velocities(flow: Floats, face_area: Floats, velocity: Floats, area_total: Floats) -> None:
    """Find u of all faces from θ-weighted Q and A, with ghosts of both, and ΣA."""
    n = flow.shape[1]
    for f in range(flow.shape[0]):
        total = 0.0
        for j in range(n):
            velocity[f, j + 1] = flow[f, j] / face_area[f, j + 1]
            total += face_area[f, j + 1]
        area_total[f] = total
        velocity[f, 0], velocity[f, n + 1] = velocity[f, n], velocity[f, 1]
        face_area[f, 0], face_area[f, n + 1] = face_area[f, n], face_area[f, 1]


@inlined_kernel
def _profiles(p: Parameters, s: Stepping, ws: Workspace) -> None:
    """Fluxes in cells, viscous terms on faces, and their derivatives by Q."""
    w, m = ws.base, p.modes
    scale, n = s.time_step * p.base.kinematic_viscosity, w.flux.shape[1]
    fluxes(m, w.mean_flow, w.mean_area, ws.mean_axis, s.theta, w.flux, w.flux_slope, ws.row_slope)
    viscous_terms(
        m, w.velocity, w.face_area, ws.mean_axis, scale, p.base.dphi, ws.around, w.damping, ws.excess
    )
    for f in range(w.mean_damping.size):
        total = 0.0
        for j in range(n):
            total += w.damping[f, j]
        w.mean_damping[f] = total / n
        share = exchange_share(w.damping, p.base.dphi, f) if n > 1 else 0.0
        ws.row_damping[f] = w.mean_damping[f] - share


@kernel
def _add_excess(excess: Floats, residual: Floats, total: Floats) -> None:
    """Add to the momentum balance of inner faces what the viscous terms hold besides a share of Q."""
    for f in range(1, residual.shape[0] - 1):
        added = 0.0
        for j in range(residual.shape[1]):
            residual[f, j] += excess[f, j]
            added += excess[f, j]
        total[f] += added


@kernel
def _to_sections(change: Floats, sums: Floats) -> None:
    """Shift the rows' δQ of inner faces and the outlet so that they sum up to their sections'."""
    n = change.shape[1]
    for f in range(1, change.shape[0]):
        total = 0.0
        for j in range(n):
            total += change[f, j]
        gap = (sums[f] - total) / n
        for j in range(n):
            change[f, j] += gap


@part_of_kernel
def _sweep(
    p: Parameters, s: Stepping, ws: Workspace, fields: Fields, value: float, offset: float
) -> tuple[int, int, int, float]:
    """From one iterate to the next; status, section, row and Σ of δP squared."""
    status, i, j = _evaluate(p, s, ws, fields)
    if status != OK:
        return status, i, j, 0.0
    b, w = p.base, ws.base
    n_x = fields.area.shape[0]
    drive = w.change
    drive_of(s, b, fields.base.pressure, w.iterate_pressure, drive)
    momentum_balance(
        fields.flow,
        w.iterate_flow,
        w.mean_flow,
        w.damping,
        w.flux,
        w.cross_flow,
        w.velocity,
        w.face_area,
        drive,
        s.time_step / b.dx,
        s.time_step / b.dphi,
        w.scratch[0],
        w.residual,
        w.total,
    )
    _add_excess(ws.excess, w.residual, w.total)
    inlet_sums(p, s, ws, fields, value, float(drive[0]))
    of_section, of_row = outlet_sums(p, s, ws, fields, float(drive[n_x]))
    at_rest, answer = law_of_outlet(p, s, ws, fields, offset)
    outflow = 0.0
    for flow in w.iterate_flow[n_x]:
        outflow += flow
    gap = at_rest + answer * outflow - w.iterate_pressure[n_x + 1]
    mass_balance(s, b, w)
    advection_matrix(s, b, w, of_section)
    section_matrix(s, b, w, gap, answer)
    thomas(w.section_matrix, w.total, w.change)
    squares = section_change(s, b, w, gap, answer)
    spread(float(w.change[0]), w.residual[0], w.scratch[3])
    shared = share_outlet(w, outflow + float(w.change[n_x]))
    for i in range(w.flux_slope.size):
        w.flux_slope[i] = ws.row_slope[i]
    for f in range(w.mean_damping.size):
        w.mean_damping[f] = ws.row_damping[f]
    advection_matrix(s, b, w, of_row)
    solve_rows(w.residual, w.face_area, w.total, w.matrix, shared)
    _to_sections(w.residual, w.change)
    return OK, 0, 0, squares


@part_of_kernel
def _follow_axis(p: Parameters, s: Stepping, ws: Workspace, fields: Fields) -> tuple[float, float]:
    """D of the iterate's pressures and flows; norms of its change and of itself."""
    b, w = p.base, ws.base
    drive_of(s, b, fields.base.pressure, w.iterate_pressure, ws.axis_drive)
    axis_momentum(
        s.theta,
        s.time_step / b.dx,
        s.time_step * b.kinematic_viscosity,
        fields.axis_velocity,
        ws.mean_axis,
        ws.axis_drive,
        fields.flow,
        w.iterate_flow,
        w.face_area,
        b.inlet_kind,
        inlet_velocity(ws),
        ws.axis_matrix,
        ws.axis_change,
    )
    thomas(ws.axis_matrix, ws.axis_change, ws.axis_drive)
    return taken(ws.axis_drive, ws.axis)


@part_of_kernel
def _begin(p: Parameters, ws: Workspace, fields: Fields, value: float, order: int) -> tuple[int, int]:
    """First iterate and what stays fixed during a step; status and section."""
    w, base = ws.base, fields.base
    extrapolate(base.pressure, w.older_pressure, w.oldest_pressure, w.iterate_pressure, order)
    extrapolate(fields.flow, w.older_flow, w.oldest_flow, w.iterate_flow, order)
    extrapolate(fields.axis_velocity, ws.older_axis, ws.oldest_axis, ws.axis, order)
    section_sums(fields.area, w.old_area_sum)
    section_sums(fields.flow, w.old_flow_sum)
    if p.base.inlet_kind == PRESSURE_INLET:
        w.iterate_pressure[0] = value
    return end_walls(p.base, base.pressure, w.old_end_area)


@part_of_kernel
def step(
    p: Parameters, s: Stepping, ws: Workspace, fields: Fields, value: float, offset: float, order: int
) -> tuple[int, int, int, int]:
    """Advance the fields in place by one Δt; arguments and results of the sections' ``step``."""
    w = ws.base
    status, i = _begin(p, ws, fields, value, order)
    if status != OK:
        return status, i, 0, 0
    flow_before, pressure_before, axis_before = 0.0, 0.0, 0.0
    for sweep in range(1, s.max_sweeps + 1):
        status, i, j, squares = _sweep(p, s, ws, fields, value, offset)
        if status != OK:
            return status, i, j, sweep
        change, size = take_change(w.residual, w.iterate_flow, w.new_flow_sum)
        level = 0.0
        for pressure in w.iterate_pressure[1:-1]:
            level += pressure * pressure
        axis_change, axis = 0.0, 0.0
        if p.modes.momentum:
            axis_change, axis = _follow_axis(p, s, ws, fields)
        if not np.isfinite(change + size + squares + level + axis_change + axis):
            return NOT_FINITE, 0, 0, sweep
        rest_flow = p.base.rest_flow * np.sqrt(w.residual.size)
        rest_pressure = 1e-9 * np.sqrt(w.mass.size) + 1e-12 * np.sqrt(level)
        rest_axis = REST_VELOCITY * 1e-3 * np.sqrt(ws.axis.size)
        flow_change, pressure_change = np.sqrt(change), np.sqrt(squares)
        flow_error = min(flow_change, remaining(flow_change, flow_before))
        pressure_error = min(pressure_change, remaining(pressure_change, pressure_before))
        axis_error = min(axis_change, remaining(axis_change, axis_before))
        flow_before, pressure_before, axis_before = flow_change, pressure_change, axis_change
        converged = flow_error <= s.tolerance * np.sqrt(size) + rest_flow
        converged = converged and axis_error <= s.tolerance * axis + rest_axis
        if converged and pressure_error <= s.tolerance * np.sqrt(level) + rest_pressure:
            accept(p.base, s, w, fields.base)
            for f in range(ws.axis.size):
                fields.axis_velocity[f] = ws.axis[f]
            return OK, 0, 0, sweep
    return NOT_CONVERGED, 0, 0, s.max_sweeps


@kernel
def advance(
    p: Parameters, course: Course, ws: Workspace, fields: Fields, state: Floats, record: Record
) -> tuple[int, int, int, int]:
    """Take the steps of a course, as the sections' ``advance``."""
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
