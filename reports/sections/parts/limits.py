"""Where in the artery errors are beyond what was declared: errors over limits, cell by cell."""

import numpy as np

from cases.arrays import Floats
from cases.results.metric_row import MetricRow
from reports.result.load import Comparison
from reports.wording.numbers import SPACE, fixed

_NEAR = 0.5  # of the rest of the artery: farther from the calcification, a place is told by its x


def over_limit(comparison: Comparison, row: MetricRow) -> Floats | None:
    """Error of a band's quantity over the cycle, in each cell, over the band's limit.

    Parameters
    ----------
    comparison : Comparison
        With the model of `row` in view.
    row : MetricRow
        A band's.

    Returns
    -------
    ndarray, shape (x, phi), or None
        None where the report does not hold the quantity's field, or the statistic is of one instant.
    """
    names = [f"{model}_{row.quantity}" for model in ("rom", "reference")]
    if not row.band or any(name not in comparison.fields for name in names):
        return None
    rom, reference = (comparison.array(name, row.variant) for name in names)
    error = _error(row.statistic, rom, reference)
    if error is None:
        return None
    ratio = error / row.band
    return np.broadcast_to(ratio if ratio.ndim == 2 else ratio[:, None], (ratio.shape[0], comparison.n_phi))


def _error(statistic: str, rom: Floats, reference: Floats) -> Floats | None:
    """Size of a statistic's error over time, the first axis; None for one that is of an instant."""
    difference = rom - reference
    with np.errstate(divide="ignore", invalid="ignore"):
        relative = difference / reference
    match statistic:
        case "rms_error":
            return _rms(relative)
        case "max_error":
            return np.asarray(np.abs(relative).max(axis=0))
        case "bias":
            return np.asarray(np.abs(relative.mean(axis=0)))
        case "scatter":
            return np.asarray(relative.std(axis=0))
        case "rms_difference":
            return _rms(difference)
        case "max_difference":
            return np.asarray(np.abs(difference).max(axis=0))
        case "rms_over_rms":
            return _rms(difference) / float(np.sqrt(np.mean(reference**2)))
        case "rms_over_largest":
            return _rms(difference) / float(np.abs(reference).max())
    return None


def _rms(values: Floats) -> Floats:
    return np.asarray(np.sqrt(np.mean(values**2, axis=0)))


def worst_over_limits(comparison: Comparison, variant: str) -> Floats | None:
    """Largest error over its limit in each cell, (x, phi), of all bands of a variant; None without any."""
    rows = [row for row in comparison.metrics.bands() if row.variant == variant]
    found = [ratio for row in rows if (ratio := over_limit(comparison, row)) is not None]
    return np.max(found, axis=0) if found else None


def place_beyond(comparison: Comparison, row: MetricRow) -> str:
    """Say where a band's error is beyond its limit, as in "within 3.9 mm of the calcification"."""
    ratio = over_limit(comparison, row)
    if ratio is None or not np.isfinite(ratio).all() or not (ratio > 1).any():
        return ""
    sections = (ratio > 1).any(axis=1)
    share = f"in {100 * float((ratio > 1).mean()):.0f}{SPACE}% of the cells"
    if sections.all():
        return share
    x = 1e3 * comparison.fields["x"].values
    calcified = comparison.fields["calcified"].sel(variant=row.variant).values.astype(bool).any(axis=1)
    if calcified.any():
        away = np.maximum(x[calcified].min() - x, 0.0) + np.maximum(x - x[calcified].max(), 0.0)
        reach = float(away[sections].max())
        if reach == 0.0:
            return f"{share}, all along the calcification"
        if reach < _NEAR * float(away.max()):
            return f"{share}, all within {fixed(reach, 1)}{SPACE}mm of the calcification"
    first, last = x[sections][[0, -1]]
    return f"{share}, between x{SPACE}={SPACE}{fixed(first, 1)} and {fixed(last, 1)}{SPACE}mm"
