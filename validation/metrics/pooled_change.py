"""What calcification changes, over all cells and instants: in 2D, in 3D, and how far they are apart."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from cases.quantities import tabulated
from cases.results.metric_row import MetricRow
from validation.metrics.rows import Models
from validation.metrics.statistics import rms


def without_rays(models: Models) -> Models:
    """Both models without fields along rays, which changes are not counted of."""
    kept = {}
    for side in ("rom", "reference"):
        fields = getattr(models, side)
        names = [name for name in tabulated() if name in fields]
        kept[side] = fields[names].drop_vars("y", errors="ignore")
    return replace(models, **kept)


def pooled_change_rows(
    compared: Mapping[tuple[str, str], Models], baselines: Mapping[str, str]
) -> Iterator[MetricRow]:
    """Root mean square over all cells and instants of each model's change from the baseline.

    ``error`` is that of the difference between both models' changes, over the reference's change.

    Parameters
    ----------
    compared : mapping of (str, str) to Models
        By variant and reduced model.
    baselines : mapping of str to str
        By variant, the one to compare it with.
    """
    for (name, model), models in compared.items():
        baseline = compared.get((baselines.get(name, name), model))
        if baseline is None or baseline is models or models.sparse:
            continue
        for quantity in tabulated():
            here, there = models.pair(quantity), baseline.pair(quantity)
            rom, reference = (_change(new, old) for new, old in zip(here, there, strict=True))
            if rom is None or reference is None:
                yield models.row(quantity, "change_rms")
                continue
            size = rms(reference)
            apart = rms(rom - reference) / size if size > 0 else None
            yield models.row(quantity, "change_rms", rom=rms(rom), reference=size, error=apart)


def _change(new: np.ndarray, old: np.ndarray) -> np.ndarray | None:
    """Change of a field; None where a value is not finite."""
    finite = np.all(np.isfinite(new)) and np.all(np.isfinite(old))
    return new - old if finite else None
