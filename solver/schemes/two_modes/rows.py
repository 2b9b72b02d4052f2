"""A pressure of each row with profiles of two modes (numba kernels).

Balances and iteration are those of :mod:`solver.schemes.rows.step`, with A 2∫v²y dy for αQ²/A and friction
and exchange around as Δt S Q + excess; D on faces as in :mod:`solver.schemes.two_modes.sections`, driven by
the mean pressure of the rows.
"""

import numpy as np

from cases.arrays import Floats
from solver.schemes.convergence import remaining
from solver.schemes.course import Course, Record, keep, stepping
from solver.schemes.layout import (
    NON_REFLECTING,
    NOT_CONVERGED,
    NOT_FINITE,
    OK,
    PRESSURE_INLET,
    REST_VELOCITY,
    Stepping,
)
from solver.schemes.rows.ends import (
    INLET,
    OUTLET,
    close_outlet,
    face_areas,
    inlet_flow,
    inlet_slopes,
    outlet_law,
)
from solver.schemes.rows.mass import accept_flow, accept_pressure, eliminate, substitute
from solver.schemes.rows.momentum import predict
from solver.schemes.rows.step import accept, begin_at_state, means, start
from solver.schemes.sections.step import thomas
from solver.schemes.two_modes.axis import axis_momentum, taken
from solver.schemes.two_modes.layout import Fields, Parameters, Workspace
from solver.schemes.two_modes.profiles import (
    exchange_share,
    fluxes,
    momentum_of,
    outgoing_wave,
    section_means,
    viscous_terms,
    weighted_axis,
)
from solver.schemes.vectorisation import inlined_kernel, kernel, part_of_kernel, summing_kernel


@kernel
def _wrap(values: Floats, f: int, mirrored: bool) -> None:
    """Fill the two ghosts of a face's rows: periodic, or the mirror images of the first and the last row."""
    last = values.shape[1] - 1
    values[f, 0] = values[f, 1] if mirrored else values[f, last - 1]
    values[f, last] = values[f, last - 1] if mirrored else values[f, 1]


@kernel
def velocities(flow: Floats, area: Floats, mirrored: bool, face_area: Floats, velocity: Floats) -> None:
    """A and u of all faces, A (faces, n_phi), with ghosts (faces, n_phi + 2)."""
    for f in range(flow.shape[0]):
        for j in range(flow.shape[1]):
            face_area[f, j + 1] = area[f, j]
            velocity[f, j + 1] = flow[f, j] / area[f, j]
        _wrap(face_area, f, mirrored)
        _wrap(velocity, f, mirrored)


@kernel
def _share_exchange(flow: Floats, dphi: float, damping: Floats, excess: Floats) -> None:
    """Give Δt S a share of the exchange around, so that many rows do not call for short steps."""
    for f in range(flow.shape[0]):
        share = exchange_share(damping, dphi, f)
        for j in range(flow.shape[1]):
            damping[f, j] -= share
            excess[f, j] += share * flow[f, j]


@inlined_kernel
def _profiles(p: Parameters, s: Stepping, ws: Workspace, fields: Fields) -> None:
    """Fluxes in cells and viscous terms on faces, at the means."""
    w, b, m = ws.base, p.base, p.modes
    face_areas(w.mean_area, w.end_area, b.inlet_kind, w.face_area)
    velocities(w.mean_flow, w.face_area, b.mirrored, ws.face_area, ws.velocity)
    if m.momentum:
        weighted_axis(s.theta, fields.axis_velocity, ws.axis, ws.mean_axis)
    else:
        section_means(ws.velocity, m.share, ws.mean_axis)
    scale = s.time_step * b.kinematic_viscosity
    fluxes(
        m, w.mean_flow, w.mean_area, ws.mean_axis, s.theta, w.momentum_flux, ws.section_slope, ws.row_slope
    )
    viscous_terms(m, ws.velocity, ws.face_area, ws.mean_axis, scale, b.dphi, ws.around, w.damping, ws.excess)
    if w.mean_flow.shape[1] > 1:
        _share_exchange(w.mean_flow, b.dphi, w.damping, ws.excess)


@kernel
def _add_excess(theta: float, damping: Floats, excess: Floats, explicit_flow: Floats) -> None:
    """Add to G of inner faces what the viscous terms hold besides Δt S Q."""
    for f in range(1, damping.shape[0] - 1):
        for j in range(damping.shape[1]):
            explicit_flow[f, j] += excess[f, j] / (1.0 - theta * damping[f, j])


@inlined_kernel
def _half_cell(p: Parameters, s: Stepping, ws: Workspace, fields: Fields, end: int) -> None:
    """Momentum of the half cell at an end: G and κ of its face."""
    w, theta, dt, half = ws.base, s.theta, s.time_step, 0.5 * p.base.dx
    n_x, n_phi = w.mean_area.shape
    f, i, out = (0, 0, -1.0) if end == INLET else (n_x, n_x - 1, 1.0)  # out: from the cell to the face
    old_end = fields.base.inlet_pressure if end == INLET else fields.base.outlet_pressure
    for j in range(n_phi):
        area, damping = w.end_area[end, j], w.damping[f, j]
        leaving = area * momentum_of(p.modes, w.mean_flow[f, j] / area, ws.mean_axis[f])
        leaving -= w.momentum_flux[i, j]
        drive = dt * area / (p.base.density * half)
        end_mean = (1.0 - theta) * old_end[j] + theta * w.end_pressure[end, j]
        inverse = 1.0 / (1.0 - theta * damping)
        rest = (
            fields.flow[f, j] * (1.0 + (1.0 - theta) * damping) + ws.excess[f, j] - out * dt / half * leaving
        )
        w.explicit_flow[f, j] = (rest - drive * out * (end_mean - w.mean_pressure[i, j])) * inverse
        w.conductance[f, j] = theta * drive * inverse


@inlined_kernel
def _momentum(p: Parameters, s: Stepping, ws: Workspace, fields: Fields, inlet_value: float) -> None:
    """G and κ of every face."""
    w, carry = ws.base, s.time_step / p.base.dx
    predict(
        s.theta,
        carry,
        carry / p.base.density,
        fields.flow,
        w.mean_area,
        w.mean_pressure,
        w.momentum_flux,
        w.damping,
        w.explicit_flow,
        w.conductance,
    )
    _add_excess(s.theta, w.damping, ws.excess, w.explicit_flow)
    if p.base.inlet_kind == PRESSURE_INLET:
        _half_cell(p, s, ws, fields, INLET)
    else:
        inlet_flow(p.base, w, inlet_value, w.explicit_flow[0])
        for j in range(w.conductance.shape[1]):
            w.conductance[0, j] = 0.0
    _half_cell(p, s, ws, fields, OUTLET)


@inlined_kernel
def _non_reflecting_law(p: Parameters, ws: Workspace, fields: Fields) -> None:
    """No wave enters: Q' − Q − viscous terms = λ₊ (A' − A) (2.2.41), with A' − A = dA/dP (P' − P)."""
    w = ws.base
    f = fields.flow.shape[0] - 1
    a, b = w.law[0], w.law[1]
    for j in range(a.size):
        area, slope, q = w.end_area[OUTLET, j], w.end_slope[OUTLET, j], w.mean_flow[f, j]
        wave = outgoing_wave(p.modes, q / area, ws.mean_axis[f], area / (p.base.density * slope))
        b[j] = 1.0 / (wave * slope)
        known = fields.flow[f, j] + w.damping[f, j] * q + ws.excess[f, j]
        a[j] = fields.base.outlet_pressure[j] - b[j] * known


@part_of_kernel
def _sweep(
    p: Parameters, s: Stepping, ws: Workspace, fields: Fields, inlet_value: float, outlet_offset: float
) -> tuple[int, int, int]:
    """One Newton sweep: from one iterate to the next; status, i, j."""
    w = ws.base
    status, i, j = means(p.base, s, w, fields.base)
    if status != OK:
        return status, i, j
    _profiles(p, s, ws, fields)
    _momentum(p, s, ws, fields, inlet_value)
    c = s.theta * s.time_step / p.base.dx
    slopes = inlet_slopes(p.base, inlet_value)
    eliminate(
        c,
        slopes,
        w.held_area,
        w.iterate_area,
        w.area_slope,
        w.explicit_flow,
        w.conductance,
        w.correction,
        w.inverse_pivot,
    )
    if p.base.outlet_kind == NON_REFLECTING:
        _non_reflecting_law(p, ws, fields)
    else:
        outlet_law(p.base, s, w, fields.base, outlet_offset)
    close_outlet(p.base, s, w)
    substitute(c, slopes, w.area_slope, w.inverse_pivot, w.conductance, w.correction, w.explicit_flow)
    return OK, 0, 0


@summing_kernel
def _sum_of_rises(f: int, theta: float, old: Floats, new: Floats) -> float:
    """Sum over φ of the θ-weighted pressure's rise over an inner face."""
    total = 0.0
    for j in range(new.shape[1]):
        rise = theta * (new[f, j] - new[f - 1, j])
        total += rise + (1.0 - theta) * (old[f, j] - old[f - 1, j])
    return total


@kernel
def _mean_rises(
    theta: float, scale: float, fields: Fields, pressure: Floats, end_pressure: Floats, drive: Floats
) -> None:
    """``scale`` times the rise of the θ-weighted mean pressure over each face; half cells at the ends."""
    n_x, n = pressure.shape
    old = fields.base.pressure
    for f in range(1, n_x):
        drive[f] = _sum_of_rises(f, theta, old, pressure)
    drive[0], drive[n_x] = 0.0, 0.0
    for j in range(n):
        first = (1.0 - theta) * old[0, j] + theta * pressure[0, j]
        last = (1.0 - theta) * old[n_x - 1, j] + theta * pressure[n_x - 1, j]
        before, after = fields.base.inlet_pressure[j], fields.base.outlet_pressure[j]
        drive[0] += 2.0 * (first - (1.0 - theta) * before - theta * end_pressure[INLET, j])
        drive[n_x] += 2.0 * ((1.0 - theta) * after + theta * end_pressure[OUTLET, j] - last)
    for f in range(n_x + 1):
        drive[f] *= scale / n


@part_of_kernel
def _follow_axis(p: Parameters, s: Stepping, ws: Workspace, fields: Fields) -> tuple[float, float]:
    """D of the iterate's pressures and flows; norms of its change and of itself."""
    b, w = p.base, ws.base
    scale, total = s.time_step / (b.density * b.dx), 0.0
    _mean_rises(s.theta, scale, fields, w.iterate_pressure, w.end_pressure, ws.axis_drive)
    for j in range(w.iterate_flow.shape[1]):
        total += w.iterate_flow[0, j] / (1.5 * w.iterate_area[0, j] - 0.5 * w.iterate_area[1, j])
    axis_momentum(
        s.theta,
        s.time_step / b.dx,
        s.time_step * b.kinematic_viscosity,
        fields.axis_velocity,
        ws.mean_axis,
        ws.axis_drive,
        fields.flow,
        w.iterate_flow,
        ws.face_area,
        b.inlet_kind,
        total / w.iterate_flow.shape[1],
        ws.axis_matrix,
        ws.axis_change,
    )
    thomas(ws.axis_matrix, ws.axis_change, ws.axis_drive)
    return taken(ws.axis_drive, ws.axis)


@part_of_kernel
def step(
    p: Parameters, s: Stepping, ws: Workspace, fields: Fields, inlet_value: float, outlet_offset: float
) -> tuple[int, int, int, int]:
    """Advance the fields in place by one Δt; arguments and results of the rows' ``step``."""
    w = ws.base
    status, i, j = start(p.base, s, w, fields.base, inlet_value)
    if status != OK:
        return status, i, j, 0
    rest_flow = REST_VELOCITY * 1e-3 * p.base.radius * p.base.radius
    rest_axis = REST_VELOCITY * 1e-3 * np.sqrt(ws.axis.size)
    flow_before, pressure_before, axis_before = 0.0, 0.0, 0.0
    for sweep in range(1, s.max_sweeps + 1):
        status, i, j = _sweep(p, s, ws, fields, inlet_value, outlet_offset)
        if status != OK:
            return status, i, j, sweep
        flow_change, flow = accept_flow(w.explicit_flow, w.iterate_flow)
        pressure_change, pressure = accept_pressure(w.correction, w.iterate_pressure)
        axis_change, axis = 0.0, 0.0
        if p.modes.momentum:
            axis_change, axis = _follow_axis(p, s, ws, fields)
        if not np.isfinite(flow_change + flow + pressure_change + pressure + axis_change + axis):
            return NOT_FINITE, 0, 0, sweep
        flow_error = min(flow_change, remaining(flow_change, flow_before))
        pressure_error = min(pressure_change, remaining(pressure_change, pressure_before))
        axis_error = min(axis_change, remaining(axis_change, axis_before))
        flow_before, pressure_before, axis_before = flow_change, pressure_change, axis_change
        converged = flow_error <= s.tolerance * flow + rest_flow
        converged = converged and axis_error <= s.tolerance * axis + rest_axis
        if converged and pressure_error <= s.tolerance * pressure + 1e-9 + 1e-12 * pressure:
            accept(p.base, s, w, fields.base)
            for f in range(ws.axis.size):
                new = ws.axis[f]
                ws.axis[f] = 2.0 * new - fields.axis_velocity[f]
                fields.axis_velocity[f] = new
            return OK, 0, 0, sweep
    return NOT_CONVERGED, 0, 0, s.max_sweeps


@part_of_kernel
def _begin(ws: Workspace, fields: Fields) -> None:
    """First iterate without a past: the state."""
    begin_at_state(ws.base, fields.base)
    for f in range(ws.axis.size):
        ws.axis[f] = fields.axis_velocity[f]


@kernel
def advance(
    p: Parameters, course: Course, ws: Workspace, fields: Fields, state: Floats, record: Record
) -> tuple[int, int, int, int]:
    """Take the steps of a course, as the rows' ``advance``."""
    count = course.inlet_values.shape[1]
    for k in range(course.time_step.size):
        s = stepping(course, k)
        n, extrapolated = 0, False
        while n < count:
            if not extrapolated:
                _begin(ws, fields)
            values = course.inlet_values[k, n], course.outlet_offsets[k, n]
            status, i, j, sweeps = step(p, s, ws, fields, values[0], values[1])
            record.sweeps[k] += sweeps
            if status == OK:
                n, extrapolated = n + 1, True
            elif extrapolated:  # the past may be a jump, from which no state can be extrapolated
                extrapolated = False
            else:
                return status, i, j, k * count + n
        keep(record, k, state, ws.exchanged)
    return OK, 0, 0, course.inlet_values.size
