"""Bands: declared limits, each judged OK, FAIL or MISSING. No band derives from what it judges."""

from collections.abc import Iterator

import numpy as np

from cases.fields import FIELDS
from cases.sections.case import Case
from cases.sections.compare import Band
from validation.metrics.cycle_quantities import CYCLE_QUANTITIES
from validation.metrics.rows import Models, Row, pooled

OK, FAIL, MISSING = "OK", "FAIL", "MISSING"


def judged_value(models: Models, band: Band) -> float | None:
    """Value that a band judges, over all cells and states; None where it could not be computed."""
    if band.quantity in CYCLE_QUANTITIES:
        ours, theirs = models.of_cycle(band.quantity)
        return None if theirs is None else pooled(band.statistic, np.array([ours]), np.array([theirs]))
    if not models.has(band.quantity):
        return None
    rom, reference = models.pair(band.quantity)
    if "y" in FIELDS[band.quantity].dims:  # on the wall both velocities are zero
        rom, reference = rom[..., :-1], reference[..., :-1]
    return models.statistic(band.statistic, rom, reference)


def band_rows(models: Models, case: Case) -> Iterator[Row]:
    """One row per band declared for this variant: the value judged, the limit, the verdict."""
    for band in case.compare.bands:
        if band.variants is not None and models.variant not in band.variants:
            continue
        value = judged_value(models, band)
        status = MISSING if value is None else OK if abs(value) <= band.limit else FAIL
        yield Row(
            models.case,
            models.variant,
            band.quantity,
            band.statistic,
            error=value,
            unit=FIELDS[band.quantity].unit if not band.relative else "1",
            band=band.limit,
            status=status,
        )
