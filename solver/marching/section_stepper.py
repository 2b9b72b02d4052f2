"""A state with one pressure a section in the kernels' arrays, and what moves it."""

from typing import Any

import numpy as np

from cases.arrays import Floats
from solver.errors import ModelError
from solver.marching import two_modes
from solver.marching.row_stepper import INLETS, Kernel, Stepper, outlet_numbers
from solver.marching.row_stepper import fields_of as row_fields
from solver.model.parameters import Model, State
from solver.schemes import layout
from solver.schemes.sections import layout as section_layout
from solver.schemes.sections.step import advance
from solver.schemes.two_modes import layout as mode_layout
from solver.schemes.two_modes import sections as mode_sections

TOLERANCE = 1e-7  # relative error of P and Q (root mean square) at which a step's iteration ends


class SectionStepper(Stepper):
    """A model with one pressure a section (``section_wall``), its state and the workspace of the kernels."""

    def __init__(self, model: Model, state: State, tolerance: float | None = None) -> None:
        super().__init__(model, state)
        self.tolerance = TOLERANCE if tolerance is None else tolerance

    def _prepared(self) -> Kernel:
        n_x, n_phi, modes = self.model.grid.n_x, self.model.grid.n_phi, self.model.two_modes
        own, scratch = parameters(self.model), section_layout.workspace(n_x, n_phi)
        if modes is None:
            return Kernel(advance, own, scratch)
        both = mode_layout.workspace(scratch, n_x, n_phi)
        return Kernel(mode_sections.advance, two_modes.parameters(own, modes), both)

    def _fields_of(self, state: State) -> Any:
        fields = fields_of(self.model, state)
        return fields if self.model.two_modes is None else two_modes.fields_of(fields, self.model, state)

    def save(self, area: Floats, flow: Floats, pressure: Floats) -> None:
        """Copy A and P of cells (n_x, n_phi) and Q of faces (n_x + 1, n_phi) of the state."""
        f = self._of_scheme()
        area[...], flow[...], pressure[...] = f.area, f.flow, f.pressure[1:-1, None]

    def state(self) -> State:
        """Return an independent copy of the state."""
        f, n_phi = self._of_scheme(), self.model.grid.n_phi
        pressure = np.repeat(f.pressure[:, None], n_phi, axis=1)
        return State(
            self.time,
            f.area.copy(),
            f.flow.copy(),
            pressure[1:-1].copy(),
            pressure[0].copy(),
            pressure[-1].copy(),
            float(f.reservoir[0]),
            self._axis_velocity(),
        )


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


def stepper_of(model: Model, state: State) -> Stepper:
    """Stepper of a model's rows, or of its sections where they have one pressure each."""
    return Stepper(model, state) if model.section_wall is None else SectionStepper(model, state)
