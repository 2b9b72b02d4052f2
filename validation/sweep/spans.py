"""Keys of a sweep that move or widen a calcification whole: centre and extent of its `x` and `phi`."""

import math
from collections.abc import Iterator, Mapping
from types import MappingProxyType

from cases.reading.numeric_keys import NumericKey
from cases.reading.yaml_nodes import join
from cases.sections.calcification import Part, SeveralCalcifications
from cases.sections.case import Case
from cases.values.kinds import ValueKind, quantity
from cases.values.ranges import ANGLES, POSITIONS, SIZES, Range

FULL_TURN = 2.0 * math.pi
CENTRE, EXTENT = "centre", "extent"
EXTENTS = Range("angle", "0.001 deg", "359.999 deg")  # a patch has two ends; all around is a ring
KINDS: Mapping[tuple[str, str], ValueKind] = MappingProxyType(
    {
        ("x", CENTRE): quantity(POSITIONS, "7.5 mm"),
        ("x", EXTENT): quantity(SIZES, "5 mm"),
        ("phi", CENTRE): quantity(ANGLES, "180 deg"),
        ("phi", EXTENT): quantity(EXTENTS, "90 deg"),
    }
)
Keys = tuple[str | int, ...]


def span_keys(case: Case) -> dict[str, NumericKey]:
    """Return centre and extent of what a case's calcification covers, by name; of several, those of each."""
    found = {}
    for path, part in _parts(case):
        for (axis, name), kind in KINDS.items():
            if hasattr(part, axis):
                keys = (*path, axis, name)
                value = _of_ends(axis, getattr(part, axis))[name]
                found[join("", *keys)] = NumericKey(join("", *keys), keys, kind, whole=False, value=value)
    return found


def _parts(case: Case) -> Iterator[tuple[Keys, Part]]:
    """Yield each part of a calcification with the keys that lead to it."""
    several = isinstance(case.calcification, SeveralCalcifications)
    for number, part in enumerate(case.calcification.parts):
        yield ("calcification", "patches", number) if several else ("calcification",), part


def _of_ends(axis: str, ends: tuple[float, float]) -> dict[str, float]:
    """Centre and extent between two ends; around the artery from the first on in the direction of φ."""
    first, last = ends
    if axis == "x":
        return {CENTRE: 0.5 * (first + last), EXTENT: last - first}
    extent = (last - first) % FULL_TURN or FULL_TURN
    return {CENTRE: (first + 0.5 * extent) % FULL_TURN, EXTENT: extent}


def ends_of(case: Case, stated: Mapping[Keys, float]) -> dict[Keys, str]:
    """Return the ends that centres and extents stand for, as a case file states them, by their keys.

    Parameters
    ----------
    case : Case
        Its own centre or extent counts where only the other one is stated.
    stated : mapping of keys to float
        By the keys of :func:`span_keys`, SI.
    """
    found: dict[Keys, str] = {}
    for path, part in _parts(case):
        for axis, unit in (("x", "m"), ("phi", "rad")):
            names = {name: (*path, axis, name) for name in (CENTRE, EXTENT)}
            own = {name: stated[keys] for name, keys in names.items() if keys in stated}
            if own:
                ends = _ends(axis, {**_of_ends(axis, getattr(part, axis)), **own})
                found |= {(*path, axis, place): f"{end!r} {unit}" for place, end in enumerate(ends)}
    return found


def _ends(axis: str, span: Mapping[str, float]) -> tuple[float, float]:
    first, last = span[CENTRE] - 0.5 * span[EXTENT], span[CENTRE] + 0.5 * span[EXTENT]
    return (first % FULL_TURN, last % FULL_TURN) if axis == "phi" else (first, last)
