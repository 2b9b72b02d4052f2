"""A state in the kernels' arrays, and what moves it."""

from typing import NamedTuple

import numpy as np

from cases.arrays import Floats, Integers
from solver.errors import (
    BeyondWallTable,
    NoAdmissibleProfile,
    NotConverged,
    NotFinite,
    RunFailure,
    WallCollapse,
)
from solver.marching import two_modes
from solver.marching.kernel import Kernel
from solver.marching.row_fields import offsets, parameters, parts_of
from solver.model.parameters import Model, State, States
from solver.schemes import layout
from solver.schemes.course import Course, Record, record
from solver.schemes.rows.step import advance
from solver.schemes.two_modes import rows as mode_rows

TOLERANCE = 3e-8  # relative error of P and Q (root mean square) at which a step's iteration ends
MAX_SWEEPS = 60

FAILURES: dict[int, type[RunFailure]] = {
    layout.NO_ADMISSIBLE_PROFILE: NoAdmissibleProfile,
    layout.WALL_COLLAPSE: WallCollapse,
    layout.BEYOND_WALL_TABLE: BeyondWallTable,
    layout.NOT_CONVERGED: NotConverged,
    layout.NOT_FINITE: NotFinite,
}
CELL_FAILURES = (layout.NO_ADMISSIBLE_PROFILE, layout.WALL_COLLAPSE, layout.BEYOND_WALL_TABLE)


class Stretch(NamedTuple):
    """States after intervals of a run, and how it came to them.

    Attributes
    ----------
    states : States
        n of them.
    longest_step : ndarray (n,)
        Δt of the interval before, s.
    mass_defect : ndarray (n,)
        Inflow − outflow − change of volume since the state before, over the inflow (0 at rest).
    steps, sweeps : ndarray (n,)
        Steps taken so far, and sweeps of their iterations in all.
    failure : RunFailure or None
        What ended the run after these states.
    """

    states: States
    longest_step: Floats
    mass_defect: Floats
    steps: Integers
    sweeps: Integers
    failure: RunFailure | None = None


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
        self.steps = 0
        self.sweeps = 0
        self.tolerance = TOLERANCE
        self._kernel = self._prepared()
        self._state = layout.joined(self._kernel.shapes)
        self._parts = layout.split(self._state, self._kernel.shapes)
        self._fields = self._kernel.fields(*self._parts)
        self.restore(state)

    def _prepared(self) -> Kernel:
        """Bind the scheme's kernel to the model's parameters and a workspace of its own."""
        n_x, n_phi = self.model.grid.n_x, self.model.grid.n_phi
        shapes = (n_x, n_phi), (n_x + 1, n_phi), (n_x, n_phi), (n_phi,), (n_phi,), (1,)
        scratch = layout.workspace(n_x, n_phi)
        kernel = Kernel(advance, parameters(self.model), scratch, layout.Fields, shapes)
        return two_modes.beside(self.model, kernel, mode_rows.advance)

    def _parts_of(self, state: State) -> tuple[Floats, ...]:
        """Parts of the scheme's own fields from a state."""
        return parts_of(self.model, state)

    def _states_of(self, times: Floats, whole: Floats) -> States:
        """States at times (n,), s, of which ``whole`` (n, size) holds the fields."""
        area, flow, pressure, inlet, outlet, reservoir, *axis = layout.split(whole, self._kernel.shapes)
        known = two_modes.own_axis(self.model, axis)
        return States(times, area, flow, pressure, inlet, outlet, reservoir[:, 0], known)

    def states(self) -> States:
        """Return an independent copy of the state, as one of several."""
        return self._states_of(np.array([self.time]), self._state[None].copy())

    def state(self) -> State:
        """Return an independent copy of the state."""
        return self.states().at(0)

    def restore(self, state: State) -> None:
        """Go back to a state."""
        parts = *self._parts_of(state), *two_modes.axis_of(self.model, state)
        for target, part in zip(self._parts, parts, strict=True):
            target[...] = part
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
        if outlet_offsets is None:
            outlet_offsets = offsets(self.model, self.time + time_step * np.arange(1, len(inlet_values) + 1))
        values, offset = np.array([inlet_values, outlet_offsets], dtype=float)
        step, theta_of = np.array([[time_step], [theta]], dtype=float)
        before = lumen_volume(self.model, self._parts[0])
        kept, _, failure = self._taken(np.array([self.time]), step, theta_of, values[None], offset[None])
        if failure is not None:
            raise failure
        change = lumen_volume(self.model, self._parts[0]) - before
        return float(mass_defect(self.model, kept.exchanged[0], change, time_step))

    def march(self, times: Floats, time_step: Floats, theta: Floats, count: int) -> Stretch:
        """Take ``count`` equal steps of Δt and θ (n,) from each of ``times`` (n + 1,), s, to the next."""
        steps, sweeps, volume = self.steps, self.sweeps, lumen_volume(self.model, self._parts[0])
        ends = times[:-1, None] + time_step[:, None] * np.arange(1, count + 1)
        values = np.ascontiguousarray(self.model.inlet.signal(ends), dtype=float)
        prescribed = values, offsets(self.model, ends)
        kept, done, failure = self._taken(times[:-1], time_step, theta, *prescribed)
        if failure is None:
            self.time = float(times[-1])
        states = self._states_of(times[1 : done + 1], kept.states[:done])
        volumes = np.append(volume, lumen_volume(self.model, states.area))
        change = volumes[1:] - volumes[:-1]
        return Stretch(
            states,
            time_step[:done],
            mass_defect(self.model, kept.exchanged[:done], change, time_step[:done]),
            steps + count * np.arange(1, done + 1),
            sweeps + np.cumsum(kept.sweeps[:done]),
            failure,
        )

    def _taken(
        self, begins: Floats, time_step: Floats, theta: Floats, values: Floats, outlet_offsets: Floats
    ) -> tuple[Record, int, RunFailure | None]:
        """Take the steps of intervals from times (n,), s: one per value at a step's end, (n, steps).

        Returns
        -------
        record, done, failure
            What was kept, of how many intervals, and what ended the run after them.
        """
        kernel, count = self._kernel, values.shape[1]
        course = Course(time_step, theta, values, outlet_offsets, self.tolerance, MAX_SWEEPS)
        kept = record(begins.size, self._state.size)
        kernel.workspace.exchanged[:] = 0.0
        status, i, j, steps = kernel.advance(
            kernel.parameters, course, kernel.workspace, self._fields, self._state, kept
        )
        self.steps += steps
        self.sweeps += int(kept.sweeps.sum())
        done = steps // count
        last, failure = min(done, begins.size - 1), None
        self.time = float(begins[last] + (steps - last * count) * time_step[last])
        if status != layout.OK:
            failure = failure_of(status, self.time + float(time_step[last]), i, j)
        finite = np.isfinite(np.add.reduce(kept.states[:done], axis=1))  # NaN and ∞ stay in a sum
        if not finite.all():
            done = int(np.argmin(finite))
            self.time = float(begins[done] + count * time_step[done])
            failure = NotFinite(self.time, 0, 0)
        return kept, done, failure


def failure_of(status: int, time: float, i: int, j: int) -> RunFailure:
    """Error that names a kernel's status, time (s) and cell, which kernels count from 0."""
    cell = (i + 1, j + 1) if status in CELL_FAILURES else (0, 0)
    hint = "try a smaller time_step" if status == layout.NOT_CONVERGED else ""
    return FAILURES[status](time, *cell, hint)


def mass_defect(model: Model, exchanged: Floats, change: Floats, time_step: Floats | float) -> Floats:
    """Inflow − outflow − change of volume over the inflow, 0 at rest; of volumes (..., 2) and (...), m³."""
    inflow, outflow = exchanged[..., 0], exchanged[..., 1]
    rest = layout.REST_VELOCITY * np.pi * model.radius**2 * time_step
    largest = np.maximum(np.maximum(np.abs(inflow), np.abs(outflow)), rest)
    return np.asarray((inflow - outflow - change) / largest)


def lumen_volume(model: Model, area: Floats) -> Floats:
    """Volume of the lumen, ∫∫ ½A dφ dx, m³, of A (..., n_x, n_phi)."""
    return np.asarray(model.grid.sector * model.grid.dx * np.add.reduce(area, axis=(-2, -1)))
