"""A state of the staggered scheme on the columns inlet, cells, outlet."""

import numpy as np

from cases.arrays import Floats
from solver.marching.two_modes import mean_axis_velocity
from solver.model.cross_flow import azimuthal_flux
from solver.model.diagnostics import Columns
from solver.model.parameters import Model, State, States
from solver.model.profiles import AVERAGE_EXPONENT, TwoModes
from solver.schemes.rows.balance import closed_exponents
from solver.schemes.walls import tabulated_area
from solver.wall.stiffness import area_from_pressure


def columns_of(model: Model, state: State | States) -> Columns:
    """Return A, Q, γ and P on inlet, cells and outlet, and D of two modes; γ is NaN where none is admissible.

    At the inlet A is extrapolated, and so is P unless it is prescribed; at the outlet P belongs to the state
    and A follows from the last cell's wall. Of states one after another arrays are (n, …).
    """
    pressure = model.pressure(state.area) if state.pressure is None else state.pressure
    outlet = pressure[..., -1, :] if state.outlet_pressure is None else state.outlet_pressure
    inlet = 1.5 * pressure[..., 0, :] - 0.5 * pressure[..., 1, :]
    if model.inlet.kind == "pressure" and state.inlet_pressure is not None:
        inlet = state.inlet_pressure
    shape = (*state.area.shape[:-2], model.grid.n_x + 2, model.grid.n_phi)
    area, flow, exponent, load = (np.empty(shape) for _ in range(4))
    area[..., 0, :] = 1.5 * state.area[..., 0, :] - 0.5 * state.area[..., 1, :]
    area[..., 1:-1, :] = state.area
    area[..., -1, :] = outlet_area(model, outlet)
    flow[..., 0, :], flow[..., -1, :] = state.flow[..., 0, :], state.flow[..., -1, :]
    np.multiply(state.flow[..., 1:, :] + state.flow[..., :-1, :], 0.5, out=flow[..., 1:-1, :])
    load[..., 0, :], load[..., 1:-1, :], load[..., -1, :] = inlet, pressure, outlet
    if model.two_modes is not None:
        exponent[:] = AVERAGE_EXPONENT
        return Columns(area, flow, exponent, load, _axis_velocity(model.two_modes, state, area, flow))
    if model.fixed_exponent is None:
        rows = (-1, model.grid.n_phi)
        closed_exponents(area.reshape(rows), flow.reshape(rows), exponent.reshape(rows))
    else:
        exponent[:] = model.fixed_exponent
    return Columns(area, flow, exponent, load)


def _axis_velocity(two_modes: TwoModes, state: State | States, area: Floats, flow: Floats) -> Floats:
    """D on inlet, cells and outlet, m/s."""
    on_faces = state.axis_velocity
    if on_faces is None:
        return mean_axis_velocity(two_modes, area, flow)
    inner = 0.5 * (on_faces[..., 1:] + on_faces[..., :-1])
    return np.concatenate([on_faces[..., :1], inner, on_faces[..., -1:]], axis=-1)


def azimuthal_flux_of(model: Model, state: State | States) -> Floats | None:
    """W of the cells, m²/s; None where rows keep their own blood."""
    wall, pressure = model.section_wall, state.pressure
    if wall is None or pressure is None:
        return None
    return azimuthal_flux(wall, model.grid.dx, model.grid.dphi, pressure[..., 0], state.flow)


def outlet_area(model: Model, pressure: Floats) -> Floats:
    """Return A at pressures (..., n_phi) behind the last cells, m²."""
    if model.section_wall is not None:
        return np.asarray(model.section_wall.last.area(pressure[..., :1])[..., 0, :])
    table = model.wall_table
    if table is None:
        return area_from_pressure(pressure, model.stiffness[-1], model.radius, model.reference_pressure)
    area, slope = np.empty(pressure.shape), np.empty((1, model.grid.n_phi))
    within = np.clip(pressure, table.start, table.end)
    for load, found in zip(*(each.reshape(-1, 1, model.grid.n_phi) for each in (within, area)), strict=True):
        tabulated_area(load, table.values[-1:], table.start, table.step, found, slope)
    return area
