"""How far a run is from periodic: what changes from the start to the end of its last cycle."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from cases.arrays import Floats
from cases.sections.case import Case

PERIODIC = 1e-4  # relative change over the last cycle from which a run is not periodic
SAME_INSTANT = 1e-9  # of a cycle
WATCHED = ("pressure", "section_flow_rate")


def cycle_change(case: Case, fields: Mapping[Any, Any]) -> float | None:
    """Return the largest relative change of pressure and flow rate over the last cycle.

    The largest difference between its two ends over the largest value at its start, or at its end if it
    starts from rest; 0 for a periodic run.

    Parameters
    ----------
    case : Case
    fields : mapping of str to array
        ``time`` (n,), s, from the start of the run, ``pressure`` (n, n_x, n_phi), Pa, and
        ``section_flow_rate`` (n, n_x), m³/s: a dataset, or the variables of a file.

    Returns
    -------
    float or None
        None where the state at one of the ends was not saved.
    """
    period, cycles = case.inlet.period, case.solver.cycles
    times = np.asarray(fields["time"][:])
    ends = [_state_at(times, cycle * period, SAME_INSTANT * period) for cycle in (cycles - 1, cycles)]
    if None in ends:
        return None
    changes = []
    for name in WATCHED:
        first, last = (np.asarray(fields[name][end]) for end in ends)
        changes.append(relative_change(first, last))
    return max(changes)


def relative_change(first: Floats, last: Floats) -> float:
    """Largest difference of two arrays over the largest value of the first, or of the last if it is zero."""
    size = np.max(np.abs(first)) or np.max(np.abs(last)) or 1.0
    return float(np.max(np.abs(last - first)) / size)


def _state_at(times: Floats, instant: float, apart: float) -> int | None:
    nearest = int(np.argmin(np.abs(times - instant)))
    return nearest if abs(times[nearest] - instant) <= apart else None


def periodicity_warning(change: float | None) -> str:
    """Say that a run is not periodic; empty where it is, or where that was not evaluated."""
    if change is None or change <= PERIODIC:
        return ""
    return (
        f"the reduced model is not periodic yet: it changes by {change:.1e} (relative) over its last cycle "
        "(raise solver.cycles; with scheme semi_implicit solver.start: periodic finds the state that repeats)"
    )
