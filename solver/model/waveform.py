"""Quantities prescribed over time: tables, Fourier series, constants and ramps.

Each is a callable of time (s, array_like) that returns SI values and has a ``period`` (s).
"""

from dataclasses import dataclass, field
from functools import lru_cache
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from cases.arrays import Floats
from solver.errors import ModelError
from solver.model.monotone_cubic import evaluated, monotone_cubic

CLOSURE = 1e-9  # share of the largest value by which a cycle's ends may differ


@lru_cache(maxsize=64)
def _cubics_through(times: bytes, values: bytes, spline: bool) -> Floats:
    """Coefficients as those of :func:`monotone_cubic`, kept: many cases of a sweep have one waveform."""
    x, y = np.frombuffer(times), np.frombuffer(values)
    if not spline:
        return monotone_cubic(x, y)
    from scipy.interpolate import CubicSpline

    return np.asarray(CubicSpline(x, np.append(y[:-1], y[0]), bc_type="periodic").c)


class Signal(Protocol):
    """A periodic quantity."""

    @property
    def period(self) -> float:
        """Length of the cycle, s."""
        ...

    def __call__(self, time: ArrayLike) -> Floats:
        """Value at ``time`` (s), SI, of the shape of ``time``."""
        ...


@dataclass(frozen=True)
class Waveform:
    """Cubic through the points of one cycle, repeated: monotone (PCHIP, Fritsch & Butland 1984), or a spline.

    Attributes
    ----------
    times : ndarray (n,)
        From 0 to the period, increasing, s.
    values : ndarray (n,)
        Values in SI; the last equals the first.
    spline : bool
        Whether it is the periodic spline, with two continuous derivatives.
    """

    times: Floats
    values: Floats
    spline: bool = False
    _cubics: Floats = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        times, values = np.asarray(self.times, dtype=float), np.asarray(self.values, dtype=float)
        if times.ndim != 1 or times.shape != values.shape or times.size < 2:
            raise ModelError("a waveform needs two or more times and as many values")
        if not (np.all(np.isfinite(times)) and times[0] == 0 and np.all(np.diff(times) > 0)):
            raise ModelError("a waveform's times must be finite, start at 0 and increase")
        if not np.all(np.isfinite(values)):
            raise ModelError("a waveform needs finite values")
        if abs(values[-1] - values[0]) > CLOSURE * np.max(np.abs(values)):
            raise ModelError(f"a waveform must close: first value {values[0]:g}, last value {values[-1]:g}")
        cubics = _cubics_through(times.tobytes(), values.tobytes(), self.spline)
        object.__setattr__(self, "_cubics", cubics)

    @property
    def period(self) -> float:
        """Length of the cycle, s."""
        return float(self.times[-1])

    def __call__(self, time: ArrayLike) -> Floats:
        """Value at ``time`` (s), SI, of the shape of ``time``."""
        return evaluated(self._cubics, np.asarray(self.times, dtype=float), np.mod(time, self.period))


@dataclass(frozen=True)
class FourierSeries:
    """Mean + Σ_k (cosine_k cos kωt + sine_k sin kωt), ω = 2π/period.

    Attributes
    ----------
    period : float
        s.
    mean : float
        SI.
    cosines, sines : tuple of float
        Coefficients of the first, second, … harmonic, SI.
    """

    period: float
    mean: float
    cosines: tuple[float, ...]
    sines: tuple[float, ...]

    def __post_init__(self) -> None:
        if not (np.isfinite(self.period) and self.period > 0):
            raise ModelError(f"period = {self.period} s; allowed: positive")
        if len(self.cosines) != len(self.sines):
            raise ModelError("a Fourier series needs as many cosine as sine coefficients")
        if not np.all(np.isfinite([self.mean, *self.cosines, *self.sines])):
            raise ModelError("a Fourier series needs finite coefficients")

    def __call__(self, time: ArrayLike) -> Floats:
        """Value at ``time`` (s), SI, of the shape of ``time``."""
        phase = 2 * np.pi / self.period * np.asarray(time, dtype=float)[..., None]
        harmonics = np.arange(1, len(self.cosines) + 1)
        cosines = np.cos(phase * harmonics) @ np.array(self.cosines)
        return np.asarray(self.mean + cosines + np.sin(phase * harmonics) @ np.array(self.sines))


def load_curve(time: ArrayLike, begin: float, end: float, low: float, high: float) -> Floats:
    """Half-cosine from ``low`` to ``high`` between two times, constant outside (2.3.1).

    l(t) = y₀ + (y₁ − y₀)(½ − ½ cos π(t − t₀)/(t₁ − t₀)); times in s.
    """
    share = np.clip((np.asarray(time, dtype=float) - begin) / (end - begin), 0.0, 1.0)
    return np.asarray(low + (high - low) * (0.5 - 0.5 * np.cos(np.pi * share)))


@dataclass(frozen=True)
class Ramped:
    """A signal that grows from 0 by the load curve over the first ``duration`` seconds."""

    signal: Signal
    duration: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.duration) and self.duration > 0):
            raise ModelError(f"ramp = {self.duration} s; allowed: positive")

    @property
    def period(self) -> float:
        """Length of the signal's cycle, s."""
        return self.signal.period

    def __call__(self, time: ArrayLike) -> Floats:
        """Value at ``time`` (s), SI, of the shape of ``time``."""
        return np.asarray(self.signal(time) * load_curve(time, 0.0, self.duration, 0.0, 1.0))


@dataclass(frozen=True)
class Scaled:
    """A signal times a factor."""

    signal: Signal
    factor: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.factor) and self.factor > 0):
            raise ModelError(f"scale = {self.factor}; allowed: positive")

    @property
    def period(self) -> float:
        """Length of the signal's cycle, s."""
        return self.signal.period

    def __call__(self, time: ArrayLike) -> Floats:
        """Value at ``time`` (s), SI, of the shape of ``time``."""
        return np.asarray(self.factor * self.signal(time))


def constant(value: float, period: float) -> Waveform:
    """Waveform that keeps one value over cycles of ``period`` s."""
    return Waveform(np.array([0.0, period]), np.array([value, value]))


def local_minima(signal: Signal, samples: int = 4000) -> Floats:
    """Find the times of the local minima of one cycle in the order in which they follow its maximum, s.

    A flat minimum counts once, at its first instant; a flat stretch on the way down is none.
    """
    times = np.arange(samples) / samples * signal.period
    values = signal(times)
    start = int(np.argmax(values))
    circle = np.append(np.roll(values, -start), values[start])
    change = np.sign(np.diff(circle))
    turns, falling_since = [], None
    for k, direction in enumerate(change):
        if direction < 0:
            falling_since = k + 1
        elif direction > 0 and falling_since is not None:
            turns.append(falling_since)
            falling_since = None
    return times[[(start + k) % samples for k in turns]]
