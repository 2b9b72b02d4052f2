"""Limits of the bias by bootstrap, and the worst cell: rows that stand beside bias and scatter."""

from collections.abc import Iterator

import numpy as np

from cases.arrays import Floats
from cases.quantities import tabulated
from cases.results.metric_row import MetricRow
from validation.metrics.rows import Models

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


SAME_INSTANT = 1e-3  # share of a cycle by which its two ends may miss each other


def confidence_rows(models: Models) -> Iterator[MetricRow]:
    """Limits of the bias with 95 % confidence, and the cell whose error over the cycle is largest."""
    for quantity in tabulated():
        error = None if models.sparse else models.relative_error(quantity)
        low, high = (None, None) if error is None else mean_interval(_each_instant(models, error))
        yield models.row(quantity, "bias_low", error=low)
        yield models.row(quantity, "bias_high", error=high)
        if error is not None:
            yield _worst_cell(models, quantity, error)


def _each_instant(models: Models, error: np.ndarray) -> np.ndarray:
    """Mean error over all cells at each instant; the end of a whole cycle is its beginning."""
    series = error.reshape(len(error), -1).mean(axis=1)
    times = models.reference["time"].to_numpy()
    closed = times[-1] - times[0] > (1.0 - SAME_INSTANT) * models.period
    return np.asarray(series[:-1] if closed else series)


def _worst_cell(models: Models, quantity: str, error: np.ndarray) -> MetricRow:
    """Cell with the largest RMS error over the cycle."""
    rms = np.sqrt(np.mean(error**2, axis=0))
    at = np.unravel_index(int(np.argmax(rms)), rms.shape)
    j = int(at[1]) + 1 if len(at) > 1 else None
    return models.row(quantity, "worst_cell", i=int(at[0]) + 1, j=j, error=float(rms[at]))
