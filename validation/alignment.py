"""Which states of a reference are compared, and with which instants of the reduced model.

Both models repeat a cycle of period T. The reference's time minus its declared offset, moved by a whole
number of cycles so that its last state falls into the reduced model's last cycle, is the reduced
model's time. Nothing else is shifted.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from validation.errors import UnusableReferenceError

SLACK = 1e-3  # share of a cycle by which a state may miss the cycle's ends


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
    """

    states: NDArray[np.int64]
    cycle_times: NDArray[np.float64]
    rom_times: NDArray[np.float64]
    cycles_later: int

    @property
    def coverage(self) -> float:
        """Seconds between the first and the last state."""
        return float(self.cycle_times[-1] - self.cycle_times[0])


def align(times: NDArray[np.float64], offset: float, period: float, cycles: int) -> Alignment:
    """Choose the states of the last cycle that the reference covers.

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
        If fewer than three distinct instants lie in the last cycle.
    """
    phase = (np.asarray(times, dtype=float) - offset) / period
    last = int(np.ceil(np.max(phase, initial=-np.inf) - SLACK)) - 1 if len(phase) else 0
    within = phase - last
    chosen = np.flatnonzero(within > -SLACK)
    order = chosen[np.argsort(within[chosen], kind="stable")]
    distinct = order[np.append(np.diff(within[order]) > SLACK / 10, True)]
    if distinct.size < 3:
        raise UnusableReferenceError(
            f"{distinct.size} states in the last cycle (period {period:g} s, offset {offset:g} s); "
            "allowed: 3 or more"
        )
    cycle_times = np.maximum(within[distinct] * period, 0.0)
    return Alignment(
        states=distinct.astype(np.int64),
        cycle_times=cycle_times,
        rom_times=cycle_times + (cycles - 1) * period,
        cycles_later=cycles - 1 - last,
    )
