"""A state in the kernels' arrays, and what moves it."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple, TypedDict

import numpy as np
from numpy.typing import ArrayLike

from cases.arrays import Floats
from solver.errors import (
    BeyondWallTable,
    ModelError,
    NoAdmissibleProfile,
    NotConverged,
    NotFinite,
    RunFailure,
    WallCollapse,
)
from solver.marching import two_modes
from solver.model.boundary import NonReflectingOutlet, PressureOutlet, ResistanceOutlet, WindkesselOutlet
from solver.model.parameters import Model, State
from solver.schemes import layout
from solver.schemes.rows.step import advance
from solver.schemes.two_modes import layout as mode_layout
from solver.schemes.two_modes import rows as mode_rows

TOLERANCE = 3e-8  # relative error of P and Q (root mean square) at which a step's iteration ends
MAX_SWEEPS = 60

INLETS = {
    "velocity": layout.VELOCITY_INLET,
    "flow": layout.FLOW_INLET,
    "pressure": layout.PRESSURE_INLET,
}
FAILURES: dict[int, type[RunFailure]] = {
    layout.NO_ADMISSIBLE_PROFILE: NoAdmissibleProfile,
    layout.WALL_COLLAPSE: WallCollapse,
    layout.BEYOND_WALL_TABLE: BeyondWallTable,
    layout.NOT_CONVERGED: NotConverged,
    layout.NOT_FINITE: NotFinite,
}
CELL_FAILURES = (layout.NO_ADMISSIBLE_PROFILE, layout.WALL_COLLAPSE, layout.BEYOND_WALL_TABLE)


class Kernel(NamedTuple):
    """A scheme's kernel, and the parameters and the workspace that it is called with."""

    advance: Callable[..., tuple[int, int, int, int, int]]
    parameters: Any
    workspace: Any


class Stepper:
    """A model, its state and the workspace of the kernels.

    Attributes
    ----------
    model : Model
    time : float
        s.
    steps, sweeps : int
        Steps taken so far, and sweeps of their iterations in all.
    tolerance : float
        Relative error of P and Q at which a step's iteration ends.
    """

    def __init__(self, model: Model, state: State) -> None:
        self.model = model
        self.time = state.time
        self.steps = 0
        self.sweeps = 0
        self.tolerance = TOLERANCE
        self._kernel = self._prepared()
        self._fields = self._fields_of(state)

    def _prepared(self) -> Kernel:
        """Bind the scheme's kernel to the model's parameters and a workspace of its own."""
        grid = self.model.grid
        own, scratch = parameters(self.model), layout.workspace(grid.n_x, grid.n_phi)
        if self.model.two_modes is None:
            return Kernel(advance, own, scratch)
        both = mode_layout.workspace(scratch, grid.n_x, grid.n_phi)
        return Kernel(mode_rows.advance, two_modes.parameters(own, self.model.two_modes), both)

    def _fields_of(self, state: State) -> Any:
        """Arrays of the kernel from a state."""
        fields = fields_of(self.model, state)
        return fields if self.model.two_modes is None else two_modes.fields_of(fields, self.model, state)

    def state(self) -> State:
        """Return an independent copy of the state."""
        f = self._of_scheme()
        return State(
            self.time,
            f.area.copy(),
            f.flow.copy(),
            f.pressure.copy(),
            f.inlet_pressure.copy(),
            f.outlet_pressure.copy(),
            float(f.reservoir[0]),
            self._axis_velocity(),
        )

    def _of_scheme(self) -> Any:
        """Arrays of the scheme, without those of the profiles."""
        return self._fields if self.model.two_modes is None else self._fields.base

    def _axis_velocity(self) -> Floats | None:
        """Return D on faces where it is an unknown of its own."""
        modes = self.model.two_modes
        if modes is None or modes.closure == "mean":
            return None
        return np.array(self._fields.axis_velocity)

    def restore(self, state: State) -> None:
        """Go back to a state."""
        self._fields = self._fields_of(state)
        self.time = state.time

    def advance_through(self, begin: float, time_step: float, count: int, theta: float) -> float:
        """Take ``count`` steps from time ``begin``, with what the boundaries prescribe then.

        Returns and raises as :meth:`advance`.
        """
        values, outlet_offsets = self._prescribed(begin, time_step, count)
        return self.advance(values, time_step, theta, outlet_offsets)

    def take_through(self, begin: float, time_step: float, count: int, theta: float) -> None:
        """Take steps as :meth:`advance_through`, without the mass defect."""
        values, outlet_offsets = self._prescribed(begin, time_step, count)
        self.take(values, time_step, theta, outlet_offsets)

    def _prescribed(self, begin: float, time_step: float, count: int) -> tuple[Floats, Floats]:
        """What the inlet and the outlet prescribe at the end of each of ``count`` steps."""
        times = begin + time_step * np.arange(1, count + 1)
        return self.model.inlet.signal(times), offsets(self.model, times)

    def advance(
        self, inlet_values: Floats, time_step: float, theta: float, outlet_offsets: Floats | None = None
    ) -> float:
        """Take one step of ``time_step`` (s) per inlet value (SI, at the step's end).

        Returns
        -------
        float
            Mass defect over these steps: inflow − outflow − change of volume, over the inflow (0 at rest).

        Raises
        ------
        RunFailure
            NoAdmissibleProfile, WallCollapse, BeyondWallTable, NotConverged or NotFinite, with time and cell.
        """
        values = np.ascontiguousarray(inlet_values, dtype=float)
        if outlet_offsets is None:
            outlet_offsets = offsets(self.model, self.time + time_step * np.arange(1, values.size + 1))
        before = lumen_volume(self.model, self._fields.area)
        self.take(values, time_step, theta, outlet_offsets)
        change = lumen_volume(self.model, self._fields.area) - before
        return mass_defect(self.model, self._kernel.workspace.exchanged, change, time_step)

    def take(self, values: Floats, time_step: float, theta: float, outlet_offsets: Floats) -> None:
        """Take steps as :meth:`advance`, without the mass defect."""
        stepping = layout.Stepping(float(time_step), float(theta), self.tolerance, MAX_SWEEPS)
        kernel = self._kernel
        kernel.workspace.exchanged[:] = 0.0
        status, i, j, steps, sweeps = kernel.advance(
            kernel.parameters, stepping, kernel.workspace, self._fields, values, outlet_offsets
        )
        self.time += steps * time_step
        self.steps += steps
        self.sweeps += sweeps
        if status != layout.OK:
            raise failure(status, self.time + time_step, i, j)
        moved = self._fields.area, self._fields.flow  # NaN and ∞ stay in a sum
        if not all(math.isfinite(np.add.reduce(each, axis=None)) for each in moved):
            raise NotFinite(self.time, 0, 0)

    def save(self, area: Floats, flow: Floats, pressure: Floats) -> None:
        """Copy A and P of cells (n_x, n_phi) and Q of faces (n_x + 1, n_phi) of the state."""
        f = self._of_scheme()
        area[...], flow[...], pressure[...] = f.area, f.flow, f.pressure


def failure(status: int, time: float, i: int, j: int) -> RunFailure:
    """Error that names a kernel's status, time (s) and cell, which kernels count from 0."""
    cell = (i + 1, j + 1) if status in CELL_FAILURES else (0, 0)
    hint = "try a smaller time_step" if status == layout.NOT_CONVERGED else ""
    return FAILURES[status](time, *cell, hint)


def mass_defect(model: Model, exchanged: Floats, change: float, time_step: float) -> float:
    """Inflow − outflow − change of volume over the inflow; of volumes in m³, 0 at rest."""
    inflow, outflow = exchanged
    rest = layout.REST_VELOCITY * np.pi * model.radius**2 * time_step
    return float((inflow - outflow - change) / max(abs(inflow), abs(outflow), rest))


def lumen_volume(model: Model, area: Floats) -> float:
    """Volume of the lumen, ∫∫ ½A dφ dx, m³."""
    return float(model.grid.sector * model.grid.dx * np.add.reduce(area, axis=None))


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
    compliance = layout.aligned((model.grid.n_x, model.grid.n_phi))
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


def fields_of(model: Model, state: State) -> layout.Fields:
    """Arrays of the kernels from a state; pressures that it lacks follow from area and flow.

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
    parts = (state.area, state.flow, pressure, inlet, outlet, np.array([reservoir]))
    fields = layout.Fields(*(layout.aligned(part.shape) for part in parts))
    for target, part in zip(fields, parts, strict=True):
        target[...] = part
    return fields


def _outlet_pressure(model: Model, state: State, pressure: Floats, section: float) -> Floats:
    if state.outlet_pressure is not None:
        return state.outlet_pressure
    outlet = model.outlet
    if isinstance(outlet, ResistanceOutlet):
        offset = float(offsets(model, [state.time])[0])
        flow = state.flow[-1] if outlet.flow == "row" else np.full(model.grid.n_phi, section)
        return np.asarray(offset + outlet.resistance * flow)
    return np.asarray(pressure[-1])
