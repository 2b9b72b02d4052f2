"""Where in the artery errors are beyond what was declared: errors over limits, cell by cell."""

import numpy as np

from cases.arrays import Flags, Floats
from cases.results.metric_row import MetricRow
from reports.figures.lumen_cells import edges_of, runs
from reports.result.load import Comparison
from reports.wording.numbers import SPACE, fixed, listed

_MOST = 3  # stretches that are told one by one


def limit_of(comparison: Comparison, quantity: str) -> float | None:
    """Tightest limit of an RMS error of a quantity, relative; None where none is declared."""
    found = [
        b.limit for b in comparison.provenance.bands if (b.quantity, b.statistic) == (quantity, "rms_error")
    ]
    return min(found, default=None)


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
    """Say where a band's error is beyond its limit, as in "in 43 % of the cells: x = 1.8 to 5.0 mm"."""
    ratio = over_limit(comparison, row)
    if ratio is None or not np.isfinite(ratio).all() or not (ratio > 1).any():
        return ""
    beyond = ratio > 1
    said = [f"in {100 * float(beyond.mean()):.0f}{SPACE}% of the cells"]
    for name, axis, factor, decimals, unit in (
        ("x", 1, 1e3, 1, f"{SPACE}mm"),
        ("phi", 0, 180 / np.pi, 0, "°"),
    ):
        inside = beyond.any(axis=axis)
        if not inside.all():
            edges = edges_of(factor * comparison.fields[name].values)
            told = _stretches(edges, np.atleast_1d(inside), decimals, around=name == "phi")
            said.append(f"{'φ' if name == 'phi' else name}{SPACE}={SPACE}{told}{unit}")
    return f"{said[0]}: {', '.join(said[1:])}" if said[1:] else said[0]


def _stretches(edges: Floats, inside: Flags, decimals: int, around: bool) -> str:
    """Stretches of cells between their edges; around the artery one may pass φ = 0."""
    found = [(float(edges[first]), float(edges[last])) for first, last in runs(inside)]
    if around and len(found) > 1 and inside[0] and inside[-1]:
        found = [*found[1:-1], (found[-1][0], found[0][1])]
    if len(found) > _MOST:
        return f"{fixed(found[0][0], decimals)} to {fixed(found[-1][1], decimals)} ({len(found)} stretches)"
    return listed(f"{fixed(low, decimals)} to {fixed(high, decimals)}" for low, high in found)
