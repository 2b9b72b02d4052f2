"""Run the semi-implicit scheme through time and keep the states that were asked for."""

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solver.errors import ModelError, NoAdmissibleProfile, NotConverged, NotFinite, RunFailure, WallCollapse
from solver.model import Model, State, uniform_state
from solver.schemes import semi_implicit as scheme

DAMPING_RATE = 20.0  # 1/s: θ = ½ + rate·Δt damps the pulse wave and stays second order in time
TOLERANCE = 1e-9  # relative change of P and Q at which a step's iteration ends
MAX_SWEEPS = 60

_FAILURES: dict[int, type[RunFailure]] = {
    scheme.NO_ADMISSIBLE_PROFILE: NoAdmissibleProfile,
    scheme.WALL_COLLAPSE: WallCollapse,
    scheme.NOT_CONVERGED: NotConverged,
    scheme.NOT_FINITE: NotFinite,
}
_CELL_FAILURES = (scheme.NO_ADMISSIBLE_PROFILE, scheme.WALL_COLLAPSE)

Progress = Callable[[float, float], None]


@dataclass(frozen=True)
class Trajectory:
    """States of one run.

    Attributes
    ----------
    model : Model
        What was run.
    times : ndarray (n_times,)
        s.
    area : ndarray (n_times, n_x, n_phi)
        A = R², m².
    flow : ndarray (n_times, n_x + 1, n_phi)
        Q = uR² on faces, m³/s.
    mass_defect : ndarray (n_times,)
        Inflow − outflow − change of volume since the state before, over the inflow.
    steps, sweeps : int
        Time steps taken, and sweeps of their iterations in all.
    longest_step : float
        Longest Δt used, s.
    """

    model: Model
    times: NDArray[np.float64]
    area: NDArray[np.float64]
    flow: NDArray[np.float64]
    mass_defect: NDArray[np.float64]
    steps: int
    sweeps: int
    longest_step: float


@dataclass
class Stepper:
    """A state and what the kernels need to move it."""

    model: Model
    state: State
    steps: int = 0
    sweeps: int = 0
    _parameters: scheme.Parameters = field(init=False)
    _workspace: scheme.Workspace = field(init=False)

    def __post_init__(self) -> None:
        self._parameters = parameters(self.model)
        self._workspace = scheme.workspace(self.model.grid.n_x, self.model.grid.n_phi)

    def advance(self, velocities: NDArray[np.float64], time_step: float, theta: float) -> float:
        """Take one step of ``time_step`` (s) per inlet velocity (m/s, at the step's end).

        Returns
        -------
        float
            Mass defect over these steps: inflow − outflow − change of volume, over the inflow (0 at rest).

        Raises
        ------
        RunFailure
            NoAdmissibleProfile, WallCollapse, NotConverged or NotFinite, with time and cell.
        """
        grid, state = self.model.grid, self.state
        stepping = scheme.Stepping(time_step, theta, TOLERANCE, MAX_SWEEPS)
        before = lumen_volume(self.model, state.area)
        self._workspace.exchanged[:] = 0.0
        status, i, j, steps, sweeps = scheme.advance(
            self._parameters, stepping, self._workspace, state.area, state.flow, velocities
        )
        state.time += steps * time_step
        self.steps += steps
        self.sweeps += sweeps
        if status != scheme.OK:
            cell = (i + 1, j + 1) if status in _CELL_FAILURES else (0, 0)
            raise _FAILURES[status](state.time + time_step, *cell)
        if not (np.all(np.isfinite(state.area)) and np.all(np.isfinite(state.flow))):
            raise NotFinite(state.time, 0, 0)
        inflow, outflow = self._workspace.exchanged
        change = lumen_volume(self.model, state.area) - before
        rest = scheme.REST_VELOCITY * grid.dphi * grid.n_phi * self.model.radius**2 * time_step
        return float((inflow - outflow - change) / max(abs(inflow), rest))


def parameters(model: Model) -> scheme.Parameters:
    """Parameters of the kernels from a model."""
    return scheme.Parameters(
        dx=model.grid.dx,
        dphi=model.grid.dphi,
        radius=model.radius,
        density=model.density,
        kinematic_viscosity=model.viscosity / model.density,
        reference_pressure=model.reference_pressure,
        compliance=np.ascontiguousarray(model.radius**2 / model.stiffness),
        resistance=model.outlet.resistance,
        offset=model.outlet.offset,
        outlet_by_section=model.outlet.flow == "section",
    )


def lumen_volume(model: Model, area: NDArray[np.float64]) -> float:
    """Volume of the lumen, ∫∫ ½A dφ dx, m³."""
    return float(0.5 * model.grid.dphi * model.grid.dx * np.sum(area))


def steady_state(model: Model, velocity: float, start: State | None = None) -> State:
    """March to the state that a constant inlet velocity (m/s) leads to.

    Fully implicit steps that grow from 1 ms, until nothing changes any more.

    Raises
    ------
    RunFailure
        NotConverged when 400 steps do not suffice, or what :meth:`Stepper.advance` raises.
    """
    guess = model.outlet.offset + model.outlet.resistance * velocity * np.pi * model.radius**2
    stepper = Stepper(model, start.copy() if start else uniform_state(model, guess, velocity))
    time_step = 1e-3
    for _ in range(400):
        area, flow = stepper.state.area.copy(), stepper.state.flow.copy()
        stepper.advance(np.array([velocity]), time_step, theta=1.0)
        area_change = np.max(np.abs(stepper.state.area - area)) / np.max(area)
        flow_change = np.max(np.abs(stepper.state.flow - flow))
        largest = np.max(np.abs(flow))
        if area_change < 1e-13 and flow_change <= 1e-12 * largest:
            return State(0.0, stepper.state.area, stepper.state.flow)
        time_step = min(1.5 * time_step, 0.1)
    raise NotConverged(stepper.state.time, 0, 0, "no steady state within 400 steps")


def simulate(
    model: Model,
    output_times: ArrayLike,
    time_step: float,
    initial: State | None = None,
    progress: Progress | None = None,
) -> Trajectory:
    """Run from ``initial`` through the output times, each of which a step ends on.

    Parameters
    ----------
    model : Model
        What to run.
    output_times : array_like (n_times,)
        Increasing, s; the first is the initial time.
    time_step : float
        Largest Δt, s; each interval between output times is cut into equal steps not longer than it.
    initial : State, optional
        Default: the steady state of the inlet velocity at the first output time.
    progress : callable, optional
        Called with (time reached, last time) after each interval.

    Returns
    -------
    Trajectory

    Raises
    ------
    ModelError
        Times that do not increase, or a Δt that is not positive.
    RunFailure
        As :meth:`Stepper.advance`.
    """
    times = np.asarray(output_times, dtype=float)
    if times.ndim != 1 or times.size < 1 or not np.all(np.diff(times) > 0):
        raise ModelError("output times must be one or more and increase")
    if not (np.isfinite(time_step) and time_step > 0):
        raise ModelError(f"time step = {time_step} s; allowed: positive")
    first = initial or steady_state(model, float(model.inlet_velocity(times[0])))
    stepper = Stepper(model, State(float(times[0]), first.area.copy(), first.flow.copy()))
    states = [stepper.state.copy()]
    defects, longest = [0.0], 0.0
    for begin, end in pairwise(times):
        count = max(1, int(np.ceil((end - begin) / time_step * (1 - 1e-12))))
        step = (end - begin) / count
        velocities = model.inlet_velocity(begin + step * np.arange(1, count + 1))
        defects.append(stepper.advance(velocities, step, 0.5 + min(0.5, DAMPING_RATE * step)))
        stepper.state.time = float(end)
        longest = max(longest, step)
        states.append(stepper.state.copy())
        if progress:
            progress(float(end), float(times[-1]))
    return Trajectory(
        model=model,
        times=times,
        area=np.array([state.area for state in states]),
        flow=np.array([state.flow for state in states]),
        mass_defect=np.array(defects),
        steps=stepper.steps,
        sweeps=stepper.sweeps,
        longest_step=longest,
    )
