"""The quantities that a budget is of, and how far two models or levels are apart in them, as one number."""

import xarray as xr

from cases.arrays import Floats
from cases.quantities import of_cycle, pooled, reads
from validation.metrics.quantities import values_of
from validation.metrics.statistics import relative_error


def judged_quantities() -> tuple[str, ...]:
    """Names of the fields that errors are pooled of, then those of the numbers of the cycle."""
    return (*pooled(), *of_cycle())


def apart(quantity: str, ours: xr.Dataset, theirs: xr.Dataset) -> Floats | None:
    """Relative distance of a quantity between models; None without meaning, or where one lacks it."""
    if not all(name in model for model in (ours, theirs) for name in reads(quantity)):
        return None  # profiles of two modes have no exponent
    return relative_error(values_of(quantity, ours), values_of(quantity, theirs))
