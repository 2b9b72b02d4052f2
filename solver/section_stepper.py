"""A state with one pressure a section in the kernels' arrays, and what moves it."""

import numpy as np
from numpy.typing import NDArray

from solver.errors import ModelError, NotFinite
from solver.model import Model, State
from solver.schemes import layout, section_layout
from solver.schemes.section import advance
from solver.stepper import INLETS, failure, lumen_volume, mass_defect, offsets, outlet_numbers
from solver.stepper import fields_of as row_fields

TOLERANCE = 5e-7  # relative change of P and Q (root mean square) at which a step's iteration ends
MAX_SWEEPS = 60

Floats = NDArray[np.float64]


class SectionStepper:
    """A model with one pressure a section, its state and the workspace of the kernels.

    Attributes
    ----------
    model : Model
        With a ``section_wall``.
    time : float
        s.
    steps, sweeps : int
        Steps taken so far, and sweeps of their iterations in all.
    tolerance : float
        Relative change of P and Q at which a step's iteration ends.
    """

    def __init__(self, model: Model, state: State, tolerance: float | None = None) -> None:
        self.model = model
        self.time = state.time
        self.steps = 0
        self.sweeps = 0
        self.tolerance = TOLERANCE if tolerance is None else tolerance
        self._parameters = parameters(model)
        self._workspace = section_layout.workspace(model.grid.n_x, model.grid.n_phi)
        self._fields = fields_of(model, state)

    def state(self) -> State:
        """Return an independent copy of the state."""
        f, n_phi = self._fields, self.model.grid.n_phi
        pressure = np.repeat(f.pressure[:, None], n_phi, axis=1)
        return State(
            self.time,
            f.area.copy(),
            f.flow.copy(),
            pressure[1:-1].copy(),
            pressure[0].copy(),
            pressure[-1].copy(),
            float(f.reservoir[0]),
        )

    def restore(self, state: State) -> None:
        """Go back to a state."""
        self._fields = fields_of(self.model, state)
        self.time = state.time

    def advance_through(self, begin: float, time_step: float, count: int, theta: float) -> float:
        """Take ``count`` steps from time ``begin``, with what the boundaries prescribe then.

        Returns and raises as :meth:`advance`.
        """
        times = begin + time_step * np.arange(1, count + 1)
        return self.advance(self.model.inlet.signal(times), time_step, theta, offsets(self.model, times))

    def advance(
        self, inlet_values: Floats, time_step: float, theta: float, outlet_offsets: Floats | None = None
    ) -> float:
        """Take one step of ``time_step`` (s) per inlet value; as :meth:`solver.stepper.Stepper.advance`."""
        values = np.ascontiguousarray(inlet_values, dtype=float)
        if outlet_offsets is None:
            outlet_offsets = offsets(self.model, self.time + time_step * np.arange(1, values.size + 1))
        stepping = layout.Stepping(float(time_step), float(theta), self.tolerance, MAX_SWEEPS)
        before = lumen_volume(self.model, self._fields.area)
        self._workspace.exchanged[:] = 0.0
        status, i, j, steps, sweeps = advance(
            self._parameters, stepping, self._workspace, self._fields, values, outlet_offsets
        )
        self.time += steps * time_step
        self.steps += steps
        self.sweeps += sweeps
        if status != layout.OK:
            raise failure(status, self.time + time_step, i, j)
        if not (np.all(np.isfinite(self._fields.area)) and np.all(np.isfinite(self._fields.flow))):
            raise NotFinite(self.time, 0, 0)
        change = lumen_volume(self.model, self._fields.area) - before
        return mass_defect(self.model, self._workspace.exchanged, change, time_step)


def parameters(model: Model) -> section_layout.Parameters:
    """Parameters of the kernels from a model.

    Raises
    ------
    ModelError
        If the model has no ``section_wall``.
    """
    wall = model.section_wall
    if wall is None:
        raise ModelError("one pressure a section needs the wall's answer to it")
    outlet = outlet_numbers(model)
    return section_layout.Parameters(
        dx=float(model.grid.dx),
        dphi=float(model.grid.dphi),
        density=float(model.density),
        kinematic_viscosity=float(model.viscosity / model.density),
        table=wall.values,
        sums=wall.sums,
        table_start=float(wall.start),
        table_step=float(wall.step),
        fixed_exponent=float(model.fixed_exponent or 0.0),
        rest_flow=layout.REST_VELOCITY * 1e-3 * float(model.radius) ** 2,
        inlet_kind=INLETS[model.inlet.kind],
        **outlet,
    )


def fields_of(model: Model, state: State) -> section_layout.Fields:
    """Arrays of the kernels from a state, whose pressures are averaged over φ.

    Raises
    ------
    ModelError, NotFinite
        If the state is of another grid, or not finite.
    """
    cells = row_fields(model, state)
    pressure = np.concatenate(
        [[cells.inlet_pressure.mean()], cells.pressure.mean(axis=1), [cells.outlet_pressure.mean()]]
    )
    return section_layout.Fields(cells.area, cells.flow, pressure, cells.reservoir)
