"""The numbers of a case: every key that holds one, with its unit and what is allowed there."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, get_args, get_origin

from cases.reading.yaml_nodes import Scalar, join
from cases.sections.base import Section, annotation_of, bare, is_section
from cases.sections.case import Case
from cases.values.kinds import ValueKind
from cases.values.units import DIMENSION_OF_UNIT

# sections that say how an artery is run; the others say what it is compared with
SECTIONS = ("geometry", "blood", "wall", "calcification", "inlet", "outlet", "solver")


@dataclass(frozen=True)
class NumericKey:
    """A key of a case that holds a number.

    Attributes
    ----------
    name : str
        As messages write it; items count from 1: ``wall.layers[1].thickness``.
    path : tuple of str or int
        The keys that lead to it; items count from 0.
    kind : ValueKind
        How a stated value is read; its ``unit`` is not empty.
    whole : bool
        Whether it holds whole numbers only.
    value : float or None
        What the case has there, SI; None where that is nothing.
    """

    name: str
    path: tuple[str | int, ...]
    kind: ValueKind
    whole: bool
    value: float | None

    def stated(self, value: float) -> Scalar:
        """Write a number in SI units as a case file states it: all digits, with its unit."""
        if self.whole:
            return int(value)
        if self.kind.unit == "1":
            return float(value)
        unit = DIMENSION_OF_UNIT[self.kind.unit]
        return f"{float(value)!r} {'rad' if unit.name == 'angle' else unit.common_units[0]}"


def numeric_keys(case: Case) -> dict[str, NumericKey]:
    """Return the keys of a case that hold or may hold a number, by name; absent sections have none."""
    keys = (key for name in SECTIONS for key in _within(getattr(case, name), (name,)))
    return {key.name: key for key in keys}


def _within(section: Section, path: tuple[str | int, ...]) -> Iterator[NumericKey]:
    for name, field in type(section).model_fields.items():
        yield from _of_value(annotation_of(field), getattr(section, name), (*path, name))


def _of_value(annotation: Any, value: object, path: tuple[str | int, ...]) -> Iterator[NumericKey]:
    stated = bare(annotation)
    if isinstance(value, Section):
        yield from _within(value, path)
    elif isinstance(value, tuple):
        for place, item in enumerate(value):
            yield from _of_value(get_args(stated)[0], item, (*path, place))
    elif not is_section(stated) and get_origin(stated) is not tuple:
        kind = _kind(annotation)
        if kind is not None and kind.unit:
            number = float(value) if isinstance(value, int | float) else None
            yield NumericKey(join("", *path), path, kind, stated is int, number)


def _kind(annotation: Any) -> ValueKind | None:
    """Return the kind of value that an annotation asks for, the first one of a union."""
    marks = [mark for mark in getattr(annotation, "__metadata__", ()) if isinstance(mark, ValueKind)]
    if marks:
        return marks[0]
    return next((found for part in get_args(annotation) if (found := _kind(part)) is not None), None)
