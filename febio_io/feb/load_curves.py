"""Load curves: a ramp to the first instant of the cycle, then cycles; points with straight lines between."""

from collections.abc import Callable

import numpy as np

from cases.arrays import Floats
from febio_io.feb.model import Curve

RAMP_POINTS = 51
SPACING = 2e-3  # s, in a heartbeat: the waveform's curvature is followed to 1e-3 of its height
FEWEST_PER_CYCLE = 200

Signal = Callable[[Floats], Floats]


def ramp_curve(duration: float) -> Curve:
    """Half a cosine from 0 to 1 over a duration (s)."""
    share = np.linspace(0.0, 1.0, RAMP_POINTS)
    return Curve(duration * share, 0.5 - 0.5 * np.cos(np.pi * share))


def cycles_after_ramp(signal: Signal, period: float, cycles: int, ramp: float) -> Curve:
    """Give a periodic signal that is reached by a ramp.

    Parameters
    ----------
    signal : callable
        From times (n,) in [0, period) to values (n,).
    period : float
        Length of the cycle, s.
    cycles : int
        How many follow the ramp.
    ramp : float
        Duration of the ramp, s: half a cosine from 0 to the signal's first value.
    """
    start = ramp_curve(ramp)
    per_cycle = max(period / min(SPACING, period), FEWEST_PER_CYCLE)
    times = np.linspace(0.0, cycles * period, round(cycles * per_cycle) + 1)[1:]
    # The last instant of each cycle is the first of the next.
    phase = np.where(np.isclose(times % period, period, rtol=0, atol=1e-9 * period), 0.0, times % period)
    first = float(signal(np.zeros(1))[0])
    return Curve(
        np.concatenate([start.times, ramp + times]), np.concatenate([first * start.values, signal(phase)])
    )
