"""A model and a state in the numbers and arrays of the kernels."""

from typing import TypedDict

import numpy as np
from numpy.typing import ArrayLike

from cases.arrays import Floats
from solver.errors import ModelError, NotFinite
from solver.model.boundary import NonReflectingOutlet, PressureOutlet, ResistanceOutlet, WindkesselOutlet
from solver.model.parameters import Model, State
from solver.schemes import layout

INLETS = {
    "velocity": layout.VELOCITY_INLET,
    "flow": layout.FLOW_INLET,
    "pressure": layout.PRESSURE_INLET,
}


def offsets(model: Model, times: ArrayLike) -> Floats:
    """Return what the outlet prescribes at times: P_res, or the pressure itself, Pa; 0 where it has none."""
    times = np.asarray(times, dtype=float)
    outlet = model.outlet
    if isinstance(outlet, PressureOutlet):
        return np.ascontiguousarray(outlet.signal(times), dtype=float)
    if isinstance(outlet, ResistanceOutlet):
        offset = outlet.offset(times) if callable(outlet.offset) else np.full(times.shape, outlet.offset)
        return np.ascontiguousarray(offset, dtype=float)
    return np.zeros(times.shape)


class OutletNumbers(TypedDict):
    """What kernels must know of an outlet; see :class:`solver.schemes.layout.Parameters`."""

    outlet_kind: int
    resistance: float
    distal_resistance: float
    capacitance: float
    venous_pressure: float


def outlet_numbers(model: Model) -> OutletNumbers:
    """Outlet of a model for the kernels; a prescribed pressure is an offset without resistance."""
    outlet = model.outlet
    kind, resistance, distal, capacitance, venous = layout.SECTION_RESISTANCE, 0.0, 1.0, 1.0, 0.0
    if isinstance(outlet, ResistanceOutlet):
        by_row = outlet.flow == "row"
        kind = layout.ROW_RESISTANCE if by_row else layout.SECTION_RESISTANCE
        resistance = outlet.resistance
    elif isinstance(outlet, WindkesselOutlet):
        kind, resistance = layout.WINDKESSEL, outlet.proximal_resistance
        distal, capacitance = outlet.distal_resistance, outlet.compliance
        venous = outlet.venous_pressure
    elif isinstance(outlet, NonReflectingOutlet):
        kind = layout.NON_REFLECTING
    return OutletNumbers(
        outlet_kind=kind,
        resistance=float(resistance),
        distal_resistance=float(distal),
        capacitance=float(capacitance),
        venous_pressure=float(venous),
    )


def parameters(model: Model) -> layout.Parameters:
    """Parameters of the kernels from a model."""
    table = model.wall_table
    (compliance,) = layout.arrays([(model.grid.n_x, model.grid.n_phi)])
    compliance[...] = model.radius**2 / model.stiffness
    return layout.Parameters(
        dx=float(model.grid.dx),
        dphi=float(model.grid.dphi),
        sector=float(model.grid.sector),
        mirrored=model.grid.mirrored,
        radius=float(model.radius),
        reference_pressure=float(model.reference_pressure),
        density=float(model.density),
        kinematic_viscosity=float(model.viscosity / model.density),
        compliance=compliance,
        table=np.zeros((model.grid.n_x, model.grid.n_phi, 0, 2)) if table is None else table.values,
        table_start=0.0 if table is None else float(table.start),
        table_step=1.0 if table is None else float(table.step),
        fixed_exponent=float(model.fixed_exponent or 0.0),
        inlet_kind=INLETS[model.inlet.kind],
        **outlet_numbers(model),
    )


def parts_of(model: Model, state: State) -> layout.Fields:
    """What the kernels' fields hold in a state; pressures that it lacks follow from area and flow.

    Raises
    ------
    ModelError
        If the state is of another grid.
    NotFinite
        If it is not finite.
    """
    grid = model.grid
    shapes = {"area": (grid.n_x, grid.n_phi), "flow": (grid.n_x + 1, grid.n_phi)}
    for name, shape in shapes.items():
        found = getattr(state, name)
        if found.shape != shape:
            raise ModelError(f"the state's {name} has shape {found.shape}; the model's grid needs {shape}")
        if not np.all(np.isfinite(found)):
            raise NotFinite(state.time, 0, 0, f"{name} of the initial state")
    if not np.all(state.area > 0):
        raise ModelError("the state's area must be positive in every cell")
    pressure = model.pressure(state.area) if state.pressure is None else state.pressure
    section = grid.sector * float(np.sum(state.flow[-1]))
    outlet = _outlet_pressure(model, state, pressure, section)
    inlet = pressure[0] if state.inlet_pressure is None else state.inlet_pressure
    reservoir = state.reservoir
    if reservoir is None:
        proximal = getattr(model.outlet, "proximal_resistance", 0.0)
        reservoir = float(np.mean(outlet)) - proximal * section
    return layout.Fields(state.area, state.flow, pressure, inlet, outlet, np.array([reservoir]))


def _outlet_pressure(model: Model, state: State, pressure: Floats, section: float) -> Floats:
    if state.outlet_pressure is not None:
        return state.outlet_pressure
    outlet = model.outlet
    if isinstance(outlet, ResistanceOutlet):
        offset = float(offsets(model, [state.time])[0])
        flow = state.flow[-1] if outlet.flow == "row" else np.full(model.grid.n_phi, section)
        return np.asarray(offset + outlet.resistance * flow)
    return np.asarray(pressure[-1])
