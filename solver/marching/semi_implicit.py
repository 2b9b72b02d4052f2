"""Run the semi-implicit scheme through time, from one wanted instant to the next."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import pairwise, takewhile

import numpy as np
from numpy.typing import ArrayLike

from cases.arrays import Floats
from solver.errors import ModelError, NotConverged, RunFailure
from solver.marching.columns import azimuthal_flux_of, columns_of
from solver.marching.row_stepper import Stepper, Stretch
from solver.marching.section_stepper import stepper_of
from solver.marching.steady import steady_state
from solver.model.diagnostics import Columns, Diagnostics, Limits, Monitor, by_name
from solver.model.parameters import Model, State

SHORTEST_SHARE = 1e-6  # of the largest Δt: below it error control gives up
SLOWEST_GROWTH, FASTEST_GROWTH = 0.2, 2.0  # of Δt from one step to the next
DAMPING_RATE = 20.0  # 1/s: θ = ½ + rate·Δt damps the pulse wave and stays second order in time
FINE_STEP = 1e-3  # s: an iteration of longer steps may err more, as their time error does
LOOSEST = 300.0  # times the tolerance of fine steps
MOST_STATES, MOST_CELL_STEPS = 64, 1_000_000  # of one call: 0.05 s or so

Progress = Callable[[float, float], None]


@dataclass(frozen=True)
class Snapshot:
    """A state that was asked for, and how the run came to it.

    Attributes
    ----------
    state : State
        A copy; arrays are views.
    columns : Columns
        The same on inlet, cells and outlet.
    diagnostics : Diagnostics
        What the run is watched by.
    steps, sweeps : int
        Time steps computed so far, trials of the error control among them, and sweeps of their iterations.
    longest_step : float
        Longest Δt since the state before, s.
    next_step : float
        Δt that the error control tries next, s.
    azimuthal_flux : ndarray (n_x, n_phi) or None
        W of the cells, m²/s; None where rows keep their own blood.
    """

    state: State
    columns: Columns
    diagnostics: Diagnostics
    steps: int
    sweeps: int
    longest_step: float
    next_step: float
    azimuthal_flux: Floats | None


@dataclass(frozen=True)
class Trajectory:
    """States of one run.

    Attributes
    ----------
    model : Model
        What was run.
    times : ndarray (n_times,)
        s.
    area, pressure : ndarray (n_times, n_x, n_phi)
        A = R², m², and P, Pa.
    flow : ndarray (n_times, n_x + 1, n_phi)
        Q = uR² on faces, m³/s.
    mass_defect : ndarray (n_times,)
        Inflow − outflow − change of volume since the state before, over the inflow.
    steps, sweeps : int
        Time steps taken, and sweeps of their iterations in all.
    longest_step : float
        Longest Δt used, s.
    diagnostics : dict of ndarray (n_times,)
        All diagnostics by name; see :class:`solver.model.diagnostics.Diagnostics`.
    """

    model: Model
    times: Floats
    area: Floats
    pressure: Floats
    flow: Floats
    mass_defect: Floats
    steps: int
    sweeps: int
    longest_step: float
    diagnostics: dict[str, Floats] = field(default_factory=dict)


def checked_times(output_times: ArrayLike, time_step: float) -> Floats:
    """Output times as an array.

    Raises
    ------
    ModelError
        If they are not finite or do not increase, or Δt is not positive.
    """
    times = np.asarray(output_times, dtype=float)
    if times.ndim != 1 or times.size < 1 or not np.all(np.isfinite(times)) or not np.all(np.diff(times) > 0):
        raise ModelError("output times must be one or more, finite, and increase")
    if not (np.isfinite(time_step) and time_step > 0):
        raise ModelError(f"time step = {time_step} s; allowed: positive")
    return times


def implicitness(time_step: float) -> float:
    """θ = ½ + rate·Δt, at most 1."""
    return 0.5 + min(0.5, DAMPING_RATE * time_step)


def loosened(tolerance: float, time_step: float) -> float:
    """Tolerance of the iteration of equal steps: of fine ones, or more by (Δt/1 ms)³, like a step's error."""
    return tolerance * min(max(1.0, (time_step / FINE_STEP) ** 3), LOOSEST)


def stretches(stepper: Stepper, times: Floats, time_step: float) -> Iterator[Stretch]:
    """States at ``times`` (n,), s, the first of which is there, by equal steps not longer than ``time_step``.

    As many at once as a call of the kernel, which answers to nobody, brings in a fraction of a second. The
    stepper's tolerance is loosened for such steps.
    """
    stepper.tolerance = loosened(stepper.tolerance, time_step)
    yield _here(stepper)
    counts = np.maximum(1, np.ceil(np.diff(times) / time_step * (1 - 1e-12)).astype(np.int64))
    steps = np.diff(times) / counts
    theta = np.array([implicitness(step) for step in steps.tolist()])
    cells, first = stepper.model.stiffness.size, 0
    while first < counts.size:
        count = int(counts[first])
        most = min(MOST_STATES, max(1, MOST_CELL_STEPS // (count * cells)))
        last = first + sum(1 for _ in takewhile(count.__eq__, counts[first : first + most].tolist()))
        some = slice(first, last)
        yield stepper.march(times[first : last + 1], steps[some], theta[some], count)
        first = last


def _here(stepper: Stepper, longest_step: float = 0.0, defect: float = 0.0) -> Stretch:
    """State that a stepper is in."""
    counts = np.array([[stepper.steps], [stepper.sweeps]])
    return Stretch(stepper.states(), *np.array([[longest_step], [defect]]), *counts)


def snapshots(
    model: Model,
    output_times: ArrayLike,
    time_step: float,
    initial: State | None = None,
    error_tolerance: float | None = None,
    first_step: float | None = None,
    monitor: Monitor | None = None,
) -> Iterator[Snapshot]:
    """Yield the state at each output time, the first included; a step ends on each.

    Parameters are those of :func:`simulate`, the Δt (s) that the error control tries first, and the monitor
    that watches the run (default: one without limits). A run continued from any snapshot's state, next step
    and monitor's history gives the same bits as one that was not interrupted.
    """
    times = checked_times(output_times, time_step)
    start = initial.copy() if initial else steady_state(model, float(model.inlet.signal(times[0])))
    start.time = float(times[0])
    stepper = stepper_of(model, start)
    wanted = time_step if first_step is None else first_step
    watch = monitor or Monitor(model, Limits())
    if error_tolerance is None:
        for stretch in stretches(stepper, times, time_step):
            yield from _watched(watch, stretch, wanted)
        return
    yield from _watched(watch, _here(stepper), wanted)
    for begin, end in pairwise(times.tolist()):
        defect, longest, wanted = _adaptive(stepper, begin, end, time_step, wanted, error_tolerance)
        stepper.time = end
        yield from _watched(watch, _here(stepper, longest, defect), wanted)


def _watched(watch: Monitor, stretch: Stretch, next_step: float) -> Iterator[Snapshot]:
    """Snapshots of a stretch; raises what ended it, after them."""
    if stretch.failure is not None and not stretch.steps.size:
        raise stretch.failure
    states, longest = stretch.states, stretch.longest_step
    columns, flux = columns_of(watch.model, states), azimuthal_flux_of(watch.model, states)
    followed = watch.follow(states.times, longest, stretch.mass_defect, columns)
    for k, diagnostics in enumerate(followed):
        yield Snapshot(
            states.at(k),
            columns.at(k),
            diagnostics,
            int(stretch.steps[k]),
            int(stretch.sweeps[k]),
            float(longest[k]),
            next_step,
            None if flux is None else flux[k],
        )
    if stretch.failure is not None:
        raise stretch.failure


def _adaptive(
    stepper: Stepper, begin: float, end: float, largest: float, wanted: float, tolerance: float
) -> tuple[float, float, float]:
    """Go from begin to end with the local error of each step below ``tolerance``.

    Returns
    -------
    defect, longest, wanted : float
        Mass defect, longest Δt taken and Δt to try next, s.

    Raises
    ------
    RunFailure
        What a step of a millionth of ``largest`` raises, or NotConverged where its error is too large.
    """
    time, longest, total = begin, 0.0, 0.0
    shortest = SHORTEST_SHARE * largest
    while time < end:
        remaining = end - time
        step = min(wanted, largest, remaining)
        if remaining - step < 0.01 * step:
            step = remaining
        start = stepper.state()
        try:
            defect, error = _doubled(stepper, time, step)
        except RunFailure as failure:
            if step <= shortest:
                detail = f"in steps of {step:.2g} s too"
                raise type(failure)(failure.time, failure.i, failure.j, detail) from failure
            stepper.restore(start)
            wanted = SLOWEST_GROWTH * step
            continue
        growth = 0.9 * (tolerance / error) ** (1 / 3) if error > 0 else FASTEST_GROWTH
        better = step * min(FASTEST_GROWTH, max(SLOWEST_GROWTH, growth))
        if error > tolerance:
            if step <= shortest:
                raise NotConverged(time, 0, 0, f"no step keeps the error below {tolerance:g}")
            stepper.restore(start)
            wanted = better
            continue
        time = end if step == remaining else time + step
        stepper.time = time
        longest = max(longest, 0.5 * step)
        total += defect
        wanted = max(better, wanted) if step < wanted else better
    return total, longest, min(wanted, largest)


def _doubled(stepper: Stepper, time: float, step: float) -> tuple[float, float]:
    """Take two steps of Δt/2; mass defect, and the error estimated by comparison with one of Δt.

    The scheme is of second order, so a third of their difference estimates the error of the finer one.
    """
    start = stepper.state()
    stepper.advance_through(time, step, 1, implicitness(step))
    coarse = stepper.state()
    stepper.restore(start)
    defect = stepper.advance_through(time, 0.5 * step, 2, implicitness(0.5 * step))
    return defect, _difference(coarse, stepper.state()) / 3


def _difference(one: State, other: State) -> float:
    """Root-mean-square difference of flow and area, relative."""
    parts = ((one.flow, other.flow), (one.area, other.area))
    return max(
        float(np.sqrt(np.mean((a - b) ** 2)) / max(np.sqrt(np.mean(b**2)), np.finfo(float).tiny))
        for a, b in parts
    )


def simulate(
    model: Model,
    output_times: ArrayLike,
    time_step: float,
    initial: State | None = None,
    progress: Progress | None = None,
    error_tolerance: float | None = None,
    limits: Limits | None = None,
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
        Default: the steady state of the inlet's value at the first output time.
    progress : callable, optional
        Called with (time reached, last time) after each interval.
    error_tolerance : float, optional
        Local error of a step, relative, below which Δt is chosen; default: no error control.
    limits : Limits, optional
        Diagnostics that stop the run, evaluated at the output times.

    Returns
    -------
    Trajectory

    Raises
    ------
    ModelError
        Times that do not increase, a Δt that is not positive, or an initial state of another grid.
    RunFailure
        NoAdmissibleProfile, WallCollapse, BeyondWallTable, NotConverged or NotFinite, with time and cell; or
        that of a limit that is exceeded.
    """
    times = checked_times(output_times, time_step)
    taken = []
    monitor = Monitor(model, limits or Limits())
    for snapshot in snapshots(model, times, time_step, initial, error_tolerance, monitor=monitor):
        taken.append(snapshot)
        if progress:
            progress(snapshot.state.time, float(times[-1]))
    return collect(model, taken)


def collect(model: Model, taken: list[Snapshot]) -> Trajectory:
    """Join snapshots to a trajectory."""
    diagnostics = by_name([snapshot.diagnostics for snapshot in taken])
    return Trajectory(
        model=model,
        times=np.array([snapshot.state.time for snapshot in taken]),
        area=np.array([snapshot.state.area for snapshot in taken]),
        pressure=np.array([snapshot.state.pressure for snapshot in taken]),
        flow=np.array([snapshot.state.flow for snapshot in taken]),
        mass_defect=diagnostics["mass_defect"],
        steps=taken[-1].steps,
        sweeps=taken[-1].sweeps,
        longest_step=max(snapshot.longest_step for snapshot in taken),
        diagnostics=diagnostics,
    )
