"""Keys of a sweep that move or widen a calcification whole: centre and extent of its `x` and `phi`."""

import math
from collections.abc import Mapping

from cases.numeric_keys import NumericKey
from cases.ranges import ANGLES, POSITIONS, SIZES
from cases.schema import Case, NoCalcification
from cases.values import quantity

FULL_TURN = 2.0 * math.pi
CENTRE, EXTENT = "centre", "extent"


def span_keys(case: Case) -> dict[str, NumericKey]:
    """Return centre and extent of what a case's calcification covers, by name."""
    calcification = case.calcification
    if isinstance(calcification, NoCalcification):
        return {}
    kinds = {
        ("x", CENTRE): quantity(POSITIONS, "7.5 mm"),
        ("x", EXTENT): quantity(SIZES, "5 mm"),
        ("phi", CENTRE): quantity(ANGLES, "180 deg"),
        ("phi", EXTENT): quantity(ANGLES, "90 deg"),
    }
    found = {}
    for (axis, part), kind in kinds.items():
        if hasattr(calcification, axis):
            name = f"calcification.{axis}.{part}"
            value = _of_ends(axis, getattr(calcification, axis))[part]
            found[name] = NumericKey(name, ("calcification", axis, part), kind, whole=False, value=value)
    return found


def _of_ends(axis: str, ends: tuple[float, float]) -> dict[str, float]:
    """Centre and extent between two ends; around the artery from the first on in the direction of φ."""
    first, last = ends
    if axis == "x":
        return {CENTRE: 0.5 * (first + last), EXTENT: last - first}
    extent = (last - first) % FULL_TURN or FULL_TURN
    return {CENTRE: (first + 0.5 * extent) % FULL_TURN, EXTENT: extent}


def ends_for(case: Case, axis: str, stated: Mapping[str, float]) -> tuple[float, float]:
    """Return the ends of a span; centre or extent is the case's own where it is not stated, SI."""
    span = {**_of_ends(axis, getattr(case.calcification, axis)), **stated}
    first, last = span[CENTRE] - 0.5 * span[EXTENT], span[CENTRE] + 0.5 * span[EXTENT]
    return (first % FULL_TURN, last % FULL_TURN) if axis == "phi" else (first, last)
