"""Confidence of a mean error over the cycle, by resampling blocks of it.

Errors at neighbouring instants are alike, so whole blocks are drawn, of the cycle closed to a ring (circular
block bootstrap, Politis & Romano 1992, "A circular block-resampling procedure for stationary data").
"""

import numpy as np

from cases.arrays import Floats

SEED = 0  # of the random numbers: the same comparison gives the same interval
RESAMPLES = 2000
CONFIDENCE = 0.95
ALIKE = 0.2  # correlation from which instants no longer count as alike


def block_length(series: Floats) -> int:
    """Instants that are alike: up to the first lag at which the circular autocorrelation is below ALIKE.

    Between 1 and a third of the series.
    """
    longest = max(1, series.size // 3)
    deviation = series - series.mean()
    variance = float(deviation @ deviation)
    if variance <= np.finfo(float).eps * float(series @ series):
        return 1
    for lag in range(1, longest):
        if float(deviation @ np.roll(deviation, lag)) < ALIKE * variance:
            return lag
    return longest


def mean_interval(series: Floats) -> tuple[float, float]:
    """Interval that holds the mean of a series with 95 % confidence.

    Parameters
    ----------
    series : ndarray (n,)
        One value per instant of the cycle, each instant once.
    """
    n, length = series.size, block_length(series)
    count = -(-n // length)
    begins = np.random.default_rng(SEED).integers(0, n, size=(RESAMPLES, count))
    drawn = (begins[:, :, None] + np.arange(length)) % n
    means = series[drawn.reshape(RESAMPLES, -1)[:, :n]].mean(axis=1)
    tail = 50.0 * (1.0 - CONFIDENCE)
    low, high = np.percentile(means, [tail, 100.0 - tail])
    return float(low), float(high)
