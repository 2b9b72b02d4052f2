"""How uncertain a change by calcification is: what the 3D mesh leaves open of both variants.

A change is a difference of two runs. The part of the error budget that the 3D mesh has in each bounds what it
has in their difference by the sum of both; on one mesh the two errors are alike, so that it may be less.
"""

import numpy as np

from reports.result.load import Comparison
from reports.sections.parts.error_budget import budget


def _of_mesh(comparison: Comparison, variant: str, quantity: str) -> float | None:
    """Relative uncertainty by the 3D mesh."""
    found = budget(comparison, variant, quantity)
    return None if found is None else found["mesh"]


def of_cycle(comparison: Comparison, variant: str, quantity: str) -> float | None:
    """Most by which the 3D change of a number of the cycle may be off, SI; None where no mesh tells."""
    parts = []
    for name in (variant, comparison.baselines[variant]):
        relative = _of_mesh(comparison, name, quantity)
        value = comparison.metrics.find(name, quantity, "cycle")
        if relative is None or value is None or value.reference is None:
            return None
        parts.append(relative * abs(value.reference))
    return sum(parts)


def of_field(comparison: Comparison, variant: str, quantity: str) -> float | None:
    """Most by which the 3D change of a field may be off, over its RMS size; None where no mesh tells."""
    change = comparison.metrics.find(variant, quantity, "change_rms")
    if change is None or not change.reference:
        return None
    parts = []
    for name in (variant, comparison.baselines[variant]):
        relative = _of_mesh(comparison, name, quantity)
        if relative is None:
            return None
        values = comparison.array(f"reference_{quantity}", name)
        parts.append(relative * float(np.sqrt(np.nanmean(np.square(values)))))
    return sum(parts) / change.reference
