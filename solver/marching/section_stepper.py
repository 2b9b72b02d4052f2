"""A state with one pressure a section in the kernels' arrays, and what moves it."""

import numpy as np

from cases.arrays import Floats
from solver.errors import ModelError
from solver.marching import two_modes
from solver.marching.kernel import Kernel
from solver.marching.row_fields import INLETS, outlet_numbers
from solver.marching.row_fields import parts_of as parts_of_rows
from solver.marching.row_stepper import Stepper
from solver.model.parameters import Model, State, States
from solver.schemes import layout
from solver.schemes.sections import layout as section_layout
from solver.schemes.sections.step import advance
from solver.schemes.two_modes import sections as mode_sections

TOLERANCE = 1e-7  # relative error of P and Q (root mean square) at which a step's iteration ends


class SectionStepper(Stepper):
    """A model with one pressure a section (``section_wall``), its state and the workspace of the kernels."""

    def __init__(self, model: Model, state: State, tolerance: float | None = None) -> None:
        super().__init__(model, state)
        self.tolerance = TOLERANCE if tolerance is None else tolerance

    def _prepared(self) -> Kernel:
        n_x, n_phi = self.model.grid.n_x, self.model.grid.n_phi
        shapes = (n_x, n_phi), (n_x + 1, n_phi), (n_x + 2,), (1,)
        scratch = section_layout.workspace(n_x, n_phi)
        kernel = Kernel(advance, parameters(self.model), scratch, section_layout.Fields, shapes)
        return two_modes.beside(self.model, kernel, mode_sections.advance)

    def _parts_of(self, state: State) -> tuple[Floats, ...]:
        return parts_of(self.model, state)

    def _states_of(self, times: Floats, whole: Floats) -> States:
        area, flow, sections, reservoir, *axis = layout.split(whole, self._kernel.shapes)
        pressure = np.repeat(sections[..., None], self.model.grid.n_phi, axis=-1)
        parts = pressure[:, 1:-1], pressure[:, 0], pressure[:, -1], reservoir[:, 0]
        return States(times, area, flow, *parts, two_modes.own_axis(self.model, axis))


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


def parts_of(model: Model, state: State) -> section_layout.Fields:
    """What the kernels' fields hold in a state, whose pressures are averaged over φ.

    Raises
    ------
    ModelError, NotFinite
        If the state is of another grid, or not finite.
    """
    cells = parts_of_rows(model, state)
    pressure = np.concatenate(
        [[cells.inlet_pressure.mean()], cells.pressure.mean(axis=1), [cells.outlet_pressure.mean()]]
    )
    return section_layout.Fields(cells.area, cells.flow, pressure, cells.reservoir)


def stepper_of(model: Model, state: State) -> Stepper:
    """Stepper of a model's rows, or of its sections where they have one pressure each."""
    return Stepper(model, state) if model.section_wall is None else SectionStepper(model, state)
