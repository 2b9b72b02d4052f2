"""Bands: declared limits, each judged OK, FAIL or MISSING. No band derives from what it judges."""

from collections.abc import Iterator

import numpy as np

from cases.fields import FIELDS
from cases.results.metric_row import MetricRow
from cases.sections.case import Case
from cases.sections.compare import Band
from validation.metrics.rows import Models
from validation.metrics.statistics import statistic_value


def judged_value(models: Models, band: Band) -> float | None:
    """Value that a band judges, over all cells and states; None where it could not be computed."""
    dims = FIELDS[band.quantity].dims
    if not dims:
        ours, theirs = models.of_cycle(band.quantity)
        return (
            None if theirs is None else statistic_value(band.statistic, np.array([ours]), np.array([theirs]))
        )
    if not models.has(band.quantity):
        return None
    rom, reference = models.pair(band.quantity)
    if "y" in dims:  # on the wall both velocities are zero
        rom, reference = rom[..., :-1], reference[..., :-1]
    return models.statistic(band.statistic, rom, reference)


def band_rows(models: Models, case: Case) -> Iterator[MetricRow]:
    """One row per band declared for this variant: the value judged, the limit, the verdict."""
    for band in case.compare.bands:
        if band.variants is not None and models.variant not in band.variants:
            continue
        value = judged_value(models, band)
        yield models.row(band.quantity, band.statistic, error=value, band=band.limit)
