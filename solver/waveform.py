"""A quantity prescribed over one cardiac cycle and repeated."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import PchipInterpolator

from solver.errors import ModelError


@dataclass(frozen=True)
class Waveform:
    """Monotone cubic (PCHIP, Fritsch & Butland 1984) through the points of one cycle, repeated.

    Attributes
    ----------
    times : ndarray (n,)
        From 0 to the period, increasing, s.
    values : ndarray (n,)
        Values in SI; the last equals the first.
    """

    times: NDArray[np.float64]
    values: NDArray[np.float64]
    _interpolant: PchipInterpolator = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        if len(self.times) < 2 or self.times[0] != 0 or not np.all(np.diff(self.times) > 0):
            raise ModelError("a waveform needs two or more times that start at 0 and increase")
        if not np.all(np.isfinite(self.values)):
            raise ModelError("a waveform needs finite values")
        object.__setattr__(self, "_interpolant", PchipInterpolator(self.times, self.values))

    @property
    def period(self) -> float:
        """Length of the cycle, s."""
        return float(self.times[-1])

    def __call__(self, time: ArrayLike) -> NDArray[np.float64]:
        """Value at ``time`` (s), SI, of the shape of ``time``."""
        return np.asarray(self._interpolant(np.mod(time, self.period)))


def constant(value: float, period: float) -> Waveform:
    """Waveform that keeps one value over cycles of ``period`` s."""
    return Waveform(np.array([0.0, period]), np.array([value, value]))


def local_minima(waveform: Waveform, samples: int = 4000) -> NDArray[np.float64]:
    """Find the times of the local minima that follow the maximum of one cycle, in order, s.

    A flat minimum counts once, at its first instant.
    """
    times = np.linspace(0, waveform.period, samples + 1)
    values = waveform(times[:-1])
    values = np.append(values, values[0])
    start = int(np.argmax(values))
    falling = np.diff(values) < 0
    rising_or_flat = ~falling
    turns = [k for k in range(start + 1, samples) if falling[k - 1] and rising_or_flat[k]]
    return times[turns]
