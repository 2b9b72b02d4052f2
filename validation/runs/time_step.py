"""The time step of many runs of one kind, chosen by its error: the longest that keeps every number."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from cases.arrays import Floats
from cases.sections.case import Case
from cases.sections.solver import SemiImplicitSolver

LONGEST = 8.0  # times the case's own step
SECOND_ORDER = 4.0 / 3.0  # error of a step Δt, of the difference that half of it makes
SAFETY = 1.25  # of Roache (1998): runs that are not among those that are tried may err by more
SHORTER = 1.0 - 1e-9  # of a step: what is longer is the same one
FASTEST = 2.0  # a step over the next one that is tried
SAMPLE = 16  # runs by which a step is judged, at most

Numbers = Callable[[float], Floats]
Scales = Callable[[Floats], Floats]


@dataclass(frozen=True)
class Choice:
    """A time step and its error.

    Attributes
    ----------
    time_step : float
        s.
    error : float
        Largest error of any number over its scale, times `SAFETY`; inf where a run fails or no number is
        known.
    worst : int
        Which number has it.
    """

    time_step: float
    error: float
    worst: int


def takes_equal_steps(case: Case) -> bool:
    """Whether a case's step may be chosen: neither an explicit scheme's nor one that it adapts itself."""
    return isinstance(case.solver, SemiImplicitSolver) and case.solver.error_tolerance is None


def at_step(case: Case, time_step: float) -> Case:
    """Case with another time step, s."""
    return case.model_copy(update={"solver": case.solver.model_copy(update={"time_step": time_step})})


def chosen(
    own: float, times: Floats, cycle_begins: float, numbers: Numbers, scales: Scales, limit: float
) -> Choice:
    """Longest step whose error is at most ``limit``; the case's own where that errs by more too.

    Steps divide the longest time between two states of the last cycle, on each of which one ends: all longer
    ones are the same. Half of a step makes a difference of ¾ of its error, for the scheme is of second order
    in time; with a factor of safety the error of one step tells which shorter one is tried next.

    Parameters
    ----------
    own : float
        The case's own step, s.
    times : ndarray (n_times,)
        Instants on which a step ends, s.
    cycle_begins : float
        Where the last cycle begins, s.
    numbers : callable
        Takes a step, s, and returns what is wanted of each run (n_runs, n_numbers), NaN where it has no
        meaning.
    scales : callable
        Takes such numbers and returns what the errors of each are divided by (n_numbers,).
    limit : float
        Largest error allowed, relative.
    """
    known: dict[bytes, Floats] = {}

    def at(step: float) -> Floats:
        same = np.ceil(np.diff(times) / step * SHORTER).tobytes()  # numbers of steps between the instants
        if same not in known:
            known[same] = numbers(step)
        return known[same]

    def judged(step: float) -> Choice:
        fine = at(0.5 * step)
        errors = SAFETY * SECOND_ORDER * _differences(at(step), fine) / scales(fine)
        worst = int(np.argmax(errors))
        return Choice(step, float(errors[worst]), worst)

    interval = float(np.max(np.diff(times[times >= cycle_begins * SHORTER])))
    most = int(np.ceil(interval / own * SHORTER))  # the case's own steps between two states
    pieces = int(np.ceil(interval / min(LONGEST * own, interval) * SHORTER))
    while pieces < most:
        choice = judged(interval / pieces)
        if choice.error <= limit:
            return choice
        wanted = pieces * np.sqrt(min(choice.error / limit, FASTEST**2))
        pieces = max(pieces + 1, int(np.ceil(wanted * SHORTER)))
    return judged(own)


def _differences(one: Floats, other: Floats) -> Floats:
    """Largest difference of each number over the runs (n_numbers,); inf where one has it alone, or none."""
    alone = np.isnan(one) != np.isnan(other)
    apart = np.where(alone, np.inf, np.nan_to_num(np.abs(one - other), nan=0.0))
    return np.where(np.isnan(one).all(), np.inf, apart.max(axis=0))


def choice_told(time_step: float, own: float, error: tuple[float, str], tried: str, limit: float) -> str:
    """Say which step was chosen, and by what error; a warning where no step keeps the tolerance.

    Parameters
    ----------
    time_step, own : float
        Chosen, and the case's, s.
    error : (float, str)
        As in :class:`Choice`, and the name of the number that has it.
    tried : str
        By what it is known: "16 samples".
    limit : float
        Largest error allowed, relative.
    """
    size, name = error
    step, stated = (f"{1e3 * each:.3g} ms" for each in (time_step, own))
    found = f"error {size:.1e} of {name}" if np.isfinite(size) else "a run fails"
    known = f"{found}, by halving on {tried}; error_tolerance: {limit:g}"
    if size > limit:
        return f"warning: not even the case's own time step, {step}, keeps the tolerance ({known})"
    return f"time step {step} ({known}; the case states {stated})"
