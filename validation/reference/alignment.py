"""Which states of a reference are compared, and with which instants of the reduced model.

Both models repeat a cycle of period T. The reference's time minus its declared offset, moved by a whole
number of cycles so that its last state falls into the reduced model's last cycle, is the reduced
model's time. Nothing else is shifted.
"""

from dataclasses import dataclass, replace

import numpy as np

from cases.arrays import Floats, Integers
from validation.errors import UnusableReferenceError

SLACK = 1e-3  # share of a cycle by which a state may miss the cycle's ends
WHOLE = 0.95  # share of a cycle between first and last state from which it counts as whole
LOOK_BACK = 50  # cycles searched for a whole one


@dataclass(frozen=True)
class Alignment:
    """States of the reference within its last cycle.

    Attributes
    ----------
    states : ndarray (n,)
        State numbers, increasing in time.
    cycle_times : ndarray (n,)
        Time since the start of the cycle, s.
    rom_times : ndarray (n,)
        The same instants in the reduced model's last cycle, s.
    cycles_later : int
        Whole cycles by which the reduced model's time runs ahead of the reference's.
    coverage : float
        Share of the cycle between the first and the last state.
    """

    states: Integers
    cycle_times: Floats
    rom_times: Floats
    cycles_later: int
    coverage: float

    def at(self, which: Integers) -> "Alignment":
        """Return the alignment of some of its states."""
        return replace(
            self,
            states=self.states[which],
            cycle_times=self.cycle_times[which],
            rom_times=self.rom_times[which],
        )


def align(times: Floats, offset: float, period: float, cycles: int) -> Alignment:
    """Choose the states of the last cycle that the reference covers.

    That is the last whole cycle, if there is one, else the cycle covered best.

    Parameters
    ----------
    times : ndarray (n_states,)
        The reference's times, s.
    offset : float
        The reference's time at which a cycle starts, s.
    period : float
        T, s.
    cycles : int
        Cycles of the reduced model.

    Raises
    ------
    UnusableReferenceError
        If a time is not finite, or fewer than three distinct instants lie in that cycle.
    """
    phase = (np.asarray(times, dtype=float) - offset) / period
    if not np.all(np.isfinite(phase)):
        raise UnusableReferenceError("a state's time is not finite")
    cycle, states = _best_cycle(phase)
    if states.size < 3:
        raise UnusableReferenceError(
            f"states in the last cycle: {states.size}, allowed: 3 or more "
            f"(reference.time_offset {offset:g} s, period of the inlet {period:g} s)"
        )
    cycle_times = np.maximum((phase[states] - cycle) * period, 0.0)
    return Alignment(
        states=states,
        cycle_times=cycle_times,
        rom_times=cycle_times + (cycles - 1) * period,
        cycles_later=cycles - 1 - cycle,
        coverage=min(1.0, float(cycle_times[-1] - cycle_times[0]) / period),
    )


def _best_cycle(phase: Floats) -> tuple[int, Integers]:
    """Return the number of the last whole cycle, else of the one covered best, and its states in order."""
    best, covered, chosen = 0, -1.0, np.empty(0, dtype=np.int64)
    if not phase.size:
        return best, chosen
    last = int(np.ceil(phase.max() - SLACK)) - 1
    for cycle in range(last, max(int(np.floor(phase.min())), last - LOOK_BACK) - 1, -1):
        states = _states_of(phase - cycle)
        span = float(np.ptp(phase[states])) if states.size else -1.0
        if span > covered + SLACK:
            best, covered, chosen = cycle, span, states
        if covered >= WHOLE:
            break
    return best, chosen


def _states_of(within: Floats) -> Integers:
    """States of one cycle in order of time, each instant once."""
    inside = np.flatnonzero((within > -SLACK) & (within < 1 + SLACK))
    order = inside[np.argsort(within[inside], kind="stable")]
    return order[np.diff(within[order], append=np.inf) > SLACK / 10].astype(np.int64)
