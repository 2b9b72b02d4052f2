"""What the semi-implicit kernels march through in one call, and what they keep on the way."""

from typing import NamedTuple

import numpy as np

from cases.arrays import Floats, Integers
from solver.schemes.layout import Stepping
from solver.schemes.vectorisation import kernel


class Course(NamedTuple):
    """Intervals of as many equal steps each, one after another; the state is kept after each.

    Attributes
    ----------
    time_step, theta : ndarray (n,)
        Δt, s, and implicitness of each interval.
    inlet_values, outlet_offsets : ndarray (n, steps)
        What the inlet and the outlet prescribe at the end of each step, SI.
    tolerance : float
        Relative error of P and Q at which a step's iteration ends.
    max_sweeps : int
    """

    time_step: Floats
    theta: Floats
    inlet_values: Floats
    outlet_offsets: Floats
    tolerance: float
    max_sweeps: int


class Record(NamedTuple):
    """State after each interval (n, size), as `layout.split` parts it, and what happened in it.

    ``exchanged`` (n, 2), the volumes that passed inlet and outlet, m³; ``sweeps`` (n,) in all.
    """

    states: Floats
    exchanged: Floats
    sweeps: Integers


def record(count: int, size: int) -> Record:
    """Room for the states after ``count`` intervals."""
    return Record(np.empty((count, size)), np.zeros((count, 2)), np.zeros(count, dtype=np.int64))


@kernel
def stepping(course: Course, k: int) -> Stepping:
    """Steps of an interval."""
    return Stepping(course.time_step[k], course.theta[k], course.tolerance, course.max_sweeps)


@kernel
def keep(record: Record, k: int, state: Floats, exchanged: Floats) -> None:
    """Keep the state (size,) after an interval and the volumes exchanged in it, which are counted anew."""
    for m in range(exchanged.size):
        record.exchanged[k, m] = exchanged[m]
        exchanged[m] = 0.0
    for m in range(state.size):
        record.states[k, m] = state[m]
