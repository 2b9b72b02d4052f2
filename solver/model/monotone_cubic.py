"""The monotone cubic through points (PCHIP, Fritsch & Butland 1984): a waveform needs no more of SciPy.

To the bit that of ``scipy.interpolate.PchipInterpolator``, which takes longer to load than a run to compute.
"""

import numpy as np
from numpy.typing import ArrayLike

from cases.arrays import Floats


def monotone_cubic(x: Floats, y: Floats) -> Floats:
    """Coefficients of the cubics between points, of falling powers of the distance from each one's start.

    Parameters
    ----------
    x, y : ndarray (n,)
        Two or more points, x increasing.

    Returns
    -------
    ndarray (4, n − 1)
    """
    width, rise = np.diff(x), np.diff(y) / np.diff(x)
    slope = _slopes(width, rise)
    twist = (slope[:-1] + slope[1:] - 2 * rise) / width
    return np.stack([twist / width, (rise - slope[:-1]) / width - twist, slope[:-1], y[:-1]])


def evaluated(coefficients: Floats, x: Floats, at: ArrayLike) -> Floats:
    """Values of the cubics from :func:`monotone_cubic` at places within ``x``, of the shape of ``at``."""
    at = np.asarray(at, dtype=float)
    piece = x[1:-1].searchsorted(at, side="right")
    cubic, square, slope, value = (each.take(piece) for each in coefficients)
    s = at - x.take(piece)
    second = s * s
    return np.asarray(value + slope * s + square * second + cubic * (second * s))


def _slopes(width: Floats, rise: Floats) -> Floats:
    """dy/dx at the points: 0 where y turns, else a weighted harmonic mean of the slopes on both sides."""
    if rise.size == 1:
        return np.repeat(rise, 2)
    before, after = 2 * width[1:] + width[:-1], width[1:] + 2 * width[:-1]
    turning = (np.sign(rise[1:]) != np.sign(rise[:-1])) | (rise[1:] == 0) | (rise[:-1] == 0)
    slope = np.zeros(rise.size + 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        mean = (before / rise[:-1] + after / rise[1:]) / (before + after)
    slope[1:-1][~turning] = 1.0 / mean[~turning]
    slope[0] = _end_slope(width[0], width[1], rise[0], rise[1])
    slope[-1] = _end_slope(width[-1], width[-2], rise[-1], rise[-2])
    return slope


def _end_slope(width: float, next_width: float, rise: float, next_rise: float) -> float:
    """Slope at an end by the parabola through three points, held back so that the cubic stays monotone."""
    slope = ((2 * width + next_width) * rise - width * next_rise) / (width + next_width)
    if np.sign(slope) != np.sign(rise):
        return 0.0
    if np.sign(rise) != np.sign(next_rise) and abs(slope) > 3.0 * abs(rise):
        return 3.0 * rise
    return slope
