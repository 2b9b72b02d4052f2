"""How sure a bias is, and which cell is worst: rows that stand beside bias and scatter."""

from collections.abc import Iterator

import numpy as np

from cases.quantities import tabulated
from cases.results.metric_row import MetricRow
from validation.metrics.bootstrap import mean_interval
from validation.metrics.rows import Models
from validation.metrics.statistics import relative_error

SAME_INSTANT = 1e-3  # share of a cycle by which its two ends may miss each other


def confidence_rows(models: Models) -> Iterator[MetricRow]:
    """Limits of the bias with 95 % confidence, and the cell whose error over the cycle is largest."""
    for quantity in tabulated():
        rom, reference = models.pair(quantity)
        error = None if models.sparse else relative_error(rom, reference)
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
