"""Run the Godunov scheme: through time, or until the thesis's criteria call the flow steady."""

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from cases.arrays import Floats, Integers
from solver.errors import ModelError, NoAdmissibleProfile, NotSteady, RunFailure, WallCollapse
from solver.marching.godunov_setup import Setup, State
from solver.marching.godunov_slabs import Slab, advance, cut, gather
from solver.schemes.godunov import layout
from solver.schemes.godunov.steady import Stopping

Progress = Callable[[float, float], None]

_NO_CRITERIA = Stopping(False, np.inf, np.inf, np.inf, np.inf, np.inf)
_CHUNK = 4000  # steps between two looks at the clock, the progress bar and Ctrl-C
_FAILURES: dict[int, type[RunFailure]] = {
    layout.NO_ADMISSIBLE_PROFILE: NoAdmissibleProfile,
    layout.WALL_COLLAPSE: WallCollapse,
}


class Stepper:
    """A state and the kernels' arrays that move it; a context manager that owns the threads.

    Parameters
    ----------
    setup : Setup
    initial : State
    threads : int
        Slabs that step side by side (narrow grids use fewer).
    done : int
        Steps from time 0 to the initial state of a run that goes on; then the state's own time is not used.

    Raises
    ------
    ModelError
        If the initial state does not fit the grid.
    """

    def __init__(self, setup: Setup, initial: State, threads: int = 1, done: int = 0) -> None:
        shape = (setup.grid.n_x + 2, setup.grid.n_phi)
        if initial.area.shape != shape or initial.flow.shape != shape or initial.exponent.shape != shape:
            raise ModelError(f"the initial state has shape {initial.area.shape}; the grid needs {shape}")
        if not np.all(initial.area > 0):
            raise ModelError("the initial area must be positive")
        self.setup, self.start, self.steps = setup, 0.0 if done else initial.time, done
        before = setup.wall_before or setup.wall
        flat = layout.flattened
        ramp = layout.Ramp(
            flat(before.stiffness), flat(setup.wall.stiffness), flat(before.slope), flat(setup.wall.slope)
        )
        area = flat(initial.area)
        fields = layout.Fields(
            area=area,
            flow=flat(initial.flow),
            exponent=flat(initial.exponent),
            root=np.sqrt(area),
            inverse_root=1.0 / np.sqrt(area),
            stiffness=ramp.last.copy(),
            stiffness_slope=ramp.last_slope.copy(),
            fastest=np.zeros_like(area),
            reservoir=np.array([initial.reservoir]),
        )
        self._slabs: list[Slab] = cut(fields, ramp, setup.parameters, threads)
        self._pool = ThreadPoolExecutor(max(1, len(self._slabs) - 1))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._pool.shutdown()

    @property
    def time(self) -> float:
        """Time reached, s."""
        return self.start + self.steps * self.setup.time_step

    @property
    def state(self) -> State:
        """A copy of the present state."""
        fields = gather(self._slabs)
        shape = (self.setup.grid.n_x + 2, self.setup.grid.n_phi)
        area, flow, exponent = (
            layout.unflattened(values, *shape) for values in (fields.area, fields.flow, fields.exponent)
        )
        return State(self.time, area, flow, exponent, float(self._slabs[-1].fields.reservoir[0]))

    @property
    def courant(self) -> float:
        """Largest Courant number max|λ|Δt/Δx met so far."""
        return float(np.max(gather(self._slabs).fastest)) * self.setup.time_step / self.setup.grid.dx

    def begin_interval(self) -> None:
        """Count Courant number and volumes from here."""
        for slab in self._slabs:
            slab.fields.fastest[:] = 0.0
            slab.work.passed[:] = 0.0

    @property
    def passed(self) -> Floats:
        """Volumes through inlet and outlet since the interval began, by the rule of right ends, m³."""
        return np.asarray(sum(slab.work.passed for slab in self._slabs) * self.setup.time_step)

    def advance(self, count: int, stopping: Stopping = _NO_CRITERIA) -> bool:
        """Take ``count`` steps, or fewer if the flow becomes steady; returns whether it did.

        Raises
        ------
        RunFailure
            NoAdmissibleProfile or WallCollapse, with time and cell (an end counts to its neighbour).
        """
        ahead = np.arange(self.steps + 1, self.steps + count + 1, dtype=np.float64)
        times = np.asarray(self.start + self.setup.time_step * ahead, dtype=np.float64)
        setup = self.setup
        status, column, row, steps = advance(
            self._slabs, self._pool, stopping, setup.inlet(times), setup.offset(times), setup.wall_load(times)
        )
        self.steps += steps
        if status in _FAILURES:
            i = min(max(column, 1), setup.grid.n_x)
            detail = f"on the {'inlet' if column == 0 else 'outlet'}" if i != column else ""
            raise _FAILURES[status](self.time + setup.time_step, i, row, detail)
        return status == layout.STEADY


@dataclass(frozen=True)
class Trajectory:
    """States of one run at the steps nearest to the times asked for, and its largest Courant number."""

    states: list[State]
    steps: int
    courant: float


def target_steps(setup: Setup, begin: float, times: ArrayLike) -> Integers:
    """Count the steps from ``begin`` (s) to the one nearest to each of ``times``, (n,).

    Raises
    ------
    ModelError
        Times that do not increase or lie before the beginning.
    """
    targets = np.rint((np.asarray(times, dtype=float) - begin) / setup.time_step).astype(np.int64)
    if targets.ndim != 1 or targets.size < 1 or targets[0] < 0 or np.any(np.diff(targets) < 0):
        raise ModelError("times must be one or more, increase, and not lie before the initial state")
    return targets


def chunks(stepper: Stepper, target: int) -> Iterator[int]:
    """Advance to a step; yields the steps taken now and then, for progress and Ctrl-C."""
    while stepper.steps < target:
        stepper.advance(min(_CHUNK, target - stepper.steps))
        yield stepper.steps


def march(
    setup: Setup,
    initial: State,
    times: ArrayLike,
    threads: int = 1,
    progress: Progress | None = None,
) -> Trajectory:
    """Run from ``initial`` through ``times`` (s, increasing) and keep the state at the nearest step of each.

    Raises
    ------
    ModelError
        Times that do not increase or lie before the initial state.
    RunFailure
        As :meth:`Stepper.advance`.
    """
    targets = target_steps(setup, initial.time, times)
    states = []
    with Stepper(setup, initial, threads) as stepper:
        for target in targets:
            for _ in chunks(stepper, int(target)):
                if progress:
                    progress(stepper.steps, int(targets[-1]))
            states.append(stepper.state)
        return Trajectory(states, stepper.steps, stepper.courant)


@dataclass(frozen=True)
class SteadyState:
    """A steady state, the steps it took and the largest Courant number on the way."""

    state: State
    steps: int
    courant: float


def march_to_steady(
    setup: Setup,
    initial: State,
    criteria: Stopping,
    not_before: float = 0.0,
    longest: float = np.inf,
    also: Callable[[State], bool] | None = None,
) -> SteadyState:
    """Run until all criteria hold.

    Parameters
    ----------
    setup : Setup
    initial : State
    criteria : Stopping
        See :func:`thesis_criteria`.
    not_before : float
        Time from which the criteria are looked at (the end of a load curve), s.
    longest : float
        Time at which to give up, s.
    also : callable, optional
        One more criterion, of the state that satisfies the others.

    Raises
    ------
    RunFailure
        NotSteady when ``longest`` has passed, or as :meth:`Stepper.advance`.
    """
    ramp_steps = int(np.ceil((not_before - initial.time) / setup.time_step * (1 - 1e-12)))
    with Stepper(setup, initial) as stepper:
        while stepper.steps < ramp_steps:
            stepper.advance(min(_CHUNK, ramp_steps - stepper.steps))
        while stepper.time < longest:
            left = np.ceil((longest - stepper.time) / setup.time_step)
            if stepper.advance(int(min(_CHUNK, left)), criteria) and (also is None or also(stepper.state)):
                return SteadyState(stepper.state, stepper.steps, stepper.courant)
        raise NotSteady(stepper.time, 0, 0, "the criteria for a steady state do not hold")


def thesis_criteria(kind: str, tolerance: float = 1e-4) -> Stopping:
    """Criteria of the thesis; it compares flow rates in cm³/s.

    Parameters
    ----------
    kind : str
        "rest" for a pressure inlet, (3.1.2)–(3.1.5); "flow" for a velocity inlet, (3.1.2)–(3.1.4);
        "ends" with local calcification, (3.1.2), (3.3.3), (3.3.4), (3.1.4).
    tolerance : float
        ε.

    Raises
    ------
    ModelError
        For another kind.
    """
    flow = tolerance * 1e-6
    if kind == "rest":
        return Stopping(True, tolerance, flow, np.inf, flow, flow)
    if kind == "flow":
        return Stopping(True, tolerance, flow, np.inf, flow, np.inf)
    if kind == "ends":
        return Stopping(True, tolerance, np.inf, tolerance, flow, np.inf)
    raise ModelError(f"criteria {kind!r}; allowed: rest, flow, ends")
