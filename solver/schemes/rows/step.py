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
see :mod:`solver.schemes.rows.ends`.
"""

import numpy as np

from cases.arrays import Floats
from solver.schemes.convergence import remaining
from solver.schemes.course import Course, Record, keep, stepping
from solver.schemes.layout import (
    NOT_CONVERGED,
    NOT_FINITE,
    OK,
    PRESSURE_INLET,
    REST_VELOCITY,
    Fields,
    Parameters,
    Stepping,
    Workspace,
)
from solver.schemes.rows.ends import (
    INLET,
    OUTLET,
    close_outlet,
    end_areas,
    face_areas,
    half_cell,
    inlet_flow,
    inlet_slopes,
    old_end_areas,
    outlet_law,
    update_reservoir,
)
from solver.schemes.rows.mass import (
    accept_flow,
    accept_pressure,
    eliminate,
    hold_area,
    release_area,
    substitute,
)
from solver.schemes.rows.momentum import momentum_flux, predict
from solver.schemes.rows.profile import POISEUILLE, closure_sources, fixed_sources
from solver.schemes.vectorisation import inlined_kernel, kernel, part_of_kernel
from solver.schemes.walls import wall_area


@kernel
def _mean(theta: float, old: Floats, new: Floats, mean: Floats) -> None:
    """θ-weighted mean of the old state and the iterate."""
    before, after, result = old.flat, new.flat, mean.flat
    for k in range(mean.size):
        result[k] = (1.0 - theta) * before[k] + theta * after[k]


@part_of_kernel
def means(p: Parameters, s: Stepping, ws: Workspace, fields: Fields) -> tuple[int, int, int]:
    """Find A of the iterate, and the means of A, P and Q; the failure (status, i, j) if there is one."""
    status, i, j = wall_area(p, 0, ws.iterate_pressure, ws.iterate_area, ws.area_slope)
    if status != OK:
        return status, i, j
    _mean(s.theta, fields.area, ws.iterate_area, ws.mean_area)
    _mean(s.theta, fields.pressure, ws.iterate_pressure, ws.mean_pressure)
    _mean(s.theta, fields.flow, ws.iterate_flow, ws.mean_flow)
    return end_areas(p, ws, s.theta)


@part_of_kernel
def _coefficients(p: Parameters, s: Stepping, ws: Workspace) -> tuple[int, int, int]:
    """α and Δt S on every face at the means; the failure (status, i, j) if there is one."""
    scale = s.time_step * p.kinematic_viscosity
    if p.fixed_exponent > 0.0 or ws.mean_area.shape[1] == 1:
        exponent = p.fixed_exponent if p.fixed_exponent > 0.0 else POISEUILLE  # of a row that is its own mean
        fixed_sources(ws.mean_area, ws.end_area, p.inlet_kind, exponent, scale, ws.alpha, ws.damping)
        return OK, 0, 0
    face_areas(ws.mean_area, ws.end_area, p.inlet_kind, ws.face_area)
    status, f, j = closure_sources(
        ws.mean_flow,
        ws.face_area,
        scale,
        p.dphi,
        p.mirrored,
        ws.inverse_area,
        ws.velocity,
        ws.inverse_share,
        ws.axis_velocity,
        ws.alpha,
        ws.damping,
    )
    return status, min(f, ws.mean_area.shape[0] - 1), j


@part_of_kernel
def _momentum(p: Parameters, s: Stepping, ws: Workspace, fields: Fields, inlet_value: float) -> None:
    """G and κ of every face."""
    momentum_flux(ws.mean_flow, ws.mean_area, ws.alpha, ws.momentum_flux)
    carry = s.time_step / p.dx
    predict(
        s.theta,
        carry,
        carry / p.density,
        fields.flow,
        ws.mean_area,
        ws.mean_pressure,
        ws.momentum_flux,
        ws.damping,
        ws.explicit_flow,
        ws.conductance,
    )
    if p.inlet_kind == PRESSURE_INLET:
        half_cell(p, s, ws, fields, INLET)
    else:
        inlet_flow(p, ws, inlet_value, ws.explicit_flow[0])
        for j in range(ws.conductance.shape[1]):
            ws.conductance[0, j] = 0.0
    half_cell(p, s, ws, fields, OUTLET)


@part_of_kernel
def _mass(p: Parameters, s: Stepping, ws: Workspace, fields: Fields, values: tuple[float, float]) -> None:
    """P' − P in every cell and Q' on every face; ``values`` are what inlet and outlet prescribe."""
    inlet_value, outlet_offset = values
    c = s.theta * s.time_step / p.dx
    slopes = inlet_slopes(p, inlet_value)
    eliminate(
        c,
        slopes,
        ws.held_area,
        ws.iterate_area,
        ws.area_slope,
        ws.explicit_flow,
        ws.conductance,
        ws.correction,
        ws.inverse_pivot,
    )
    outlet_law(p, s, ws, fields, outlet_offset)
    close_outlet(p, s, ws)
    substitute(c, slopes, ws.area_slope, ws.inverse_pivot, ws.conductance, ws.correction, ws.explicit_flow)


@part_of_kernel
def _sweep(
    p: Parameters, s: Stepping, ws: Workspace, fields: Fields, values: tuple[float, float]
) -> tuple[int, int, int]:
    """One Newton sweep: from one iterate to the next; status, i, j."""
    status, i, j = means(p, s, ws, fields)
    if status != OK:
        return status, i, j
    status, i, j = _coefficients(p, s, ws)
    if status != OK:
        return status, i, j
    _momentum(p, s, ws, fields, values[0])
    _mass(p, s, ws, fields, values)
    return OK, 0, 0


@kernel
def copy(values: Floats, target: Floats) -> None:
    """Copy a 2-D array."""
    source, result = values.flat, target.flat
    for k in range(target.size):
        result[k] = source[k]


@kernel
def take(iterate: Floats, state: Floats) -> None:
    """Make the iterate the state, and its linear extrapolation in time the next step's first iterate."""
    found, kept = iterate.flat, state.flat
    for k in range(state.size):
        new = found[k]
        found[k] = 2.0 * new - kept[k]
        kept[k] = new


@part_of_kernel
def begin_at_state(ws: Workspace, fields: Fields) -> None:
    """First iterate without a past: the state."""
    copy(fields.pressure, ws.iterate_pressure)
    copy(fields.flow, ws.iterate_flow)
    for j in range(fields.outlet_pressure.size):
        ws.end_pressure[OUTLET, j] = fields.outlet_pressure[j]


@part_of_kernel
def start(
    p: Parameters, s: Stepping, ws: Workspace, fields: Fields, inlet_value: float
) -> tuple[int, int, int]:
    """Prepare what stays fixed during a step; status, i, j."""
    hold_area(fields.area, fields.flow, (1.0 - s.theta) * s.time_step / p.dx, ws.held_area)
    for j in range(ws.end_pressure.shape[1]):
        ws.end_pressure[INLET, j] = inlet_value
    return old_end_areas(p, ws, fields)


@part_of_kernel
def step(
    p: Parameters,
    s: Stepping,
    ws: Workspace,
    fields: Fields,
    inlet_value: float,
    outlet_offset: float,
) -> tuple[int, int, int, int]:
    """Advance the fields in place by one Δt from the workspace's first iterate; leave the next step's there.

    The iteration ends where P and Q changed by less than the tolerance, or where the error that is left,
    estimated from the last two changes, is below it.

    Parameters
    ----------
    p, s, ws, fields : Parameters, Stepping, Workspace, Fields
    inlet_value : float
        v (m/s), q (m³/s) or P (Pa) at the new time, by the inlet's kind.
    outlet_offset : float
        P_res at the new time, Pa.

    Returns
    -------
    status, i, j, sweeps : int
        OK or what failed, the cell counted from 0, and the sweeps used.
    """
    status, i, j = start(p, s, ws, fields, inlet_value)
    if status != OK:
        return status, i, j, 0
    rest_flow = REST_VELOCITY * 1e-3 * p.radius * p.radius
    flow_before, pressure_before = 0.0, 0.0
    for sweep in range(1, s.max_sweeps + 1):
        status, i, j = _sweep(p, s, ws, fields, (inlet_value, outlet_offset))
        if status != OK:
            return status, i, j, sweep
        flow_change, flow = accept_flow(ws.explicit_flow, ws.iterate_flow)
        pressure_change, pressure = accept_pressure(ws.correction, ws.iterate_pressure)
        if not np.isfinite(flow_change + flow + pressure_change + pressure):
            return NOT_FINITE, 0, 0, sweep
        flow_error = min(flow_change, remaining(flow_change, flow_before))
        pressure_error = min(pressure_change, remaining(pressure_change, pressure_before))
        flow_before, pressure_before = flow_change, pressure_change
        flow_converged = flow_error <= s.tolerance * flow + rest_flow
        if flow_converged and pressure_error <= s.tolerance * pressure + 1e-9 + 1e-12 * pressure:
            accept(p, s, ws, fields)
            return OK, 0, 0, sweep
    return NOT_CONVERGED, 0, 0, s.max_sweeps


@inlined_kernel
def accept(p: Parameters, s: Stepping, ws: Workspace, fields: Fields) -> None:
    """Take the iterate as the new state; A' from the fluxes, so that mass is kept to round-off."""
    flow, new_flow = fields.flow, ws.iterate_flow
    n_x = fields.area.shape[0]
    sector = p.sector * s.time_step
    for j in range(flow.shape[1]):
        ws.exchanged[0] += sector * ((1.0 - s.theta) * flow[0, j] + s.theta * new_flow[0, j])
        ws.exchanged[1] += sector * ((1.0 - s.theta) * flow[n_x, j] + s.theta * new_flow[n_x, j])
    release_area(ws.held_area, new_flow, s.theta * s.time_step / p.dx, fields.area)
    for j in range(flow.shape[1]):
        fields.inlet_pressure[j] = ws.end_pressure[INLET, j]
    take(ws.end_pressure[OUTLET:], fields.outlet_pressure.reshape((1, flow.shape[1])))
    update_reservoir(p, fields, new_flow[n_x])
    take(new_flow, flow)
    take(ws.iterate_pressure, fields.pressure)


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
        n, extrapolated = 0, False
        while n < count:
            if not extrapolated:
                begin_at_state(ws, fields)
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
