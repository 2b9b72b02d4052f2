"""Reading what a study states under `parameters`."""

from collections.abc import Callable, Iterable, Mapping

import numpy as np

from cases.arrays import Floats
from cases.errors import CaseError, Problem, QuantityError, RefusedValueError
from cases.reading.numeric_keys import NumericKey
from cases.reading.yaml_nodes import Node
from cases.values.kinds import refused
from cases.values.units import DIMENSION_OF_UNIT, parse_quantity, parse_ratio
from cases.values.wording import but_allowed, choices, nearest, not_one_of, shown, unknown_key
from validation.sweep.display import display_of, label_of
from validation.sweep.parameters import MOST_VALUES, NEEDED, OPTIONAL, SPREAD, Parameter

FORMS = "a list of values, {start, stop, count} or {distribution: …}"
RANGE_KEYS = ("start", "stop", "count", "spacing", "label")
SPACINGS = ("linear", "log")


def read_parameters(
    section: Node, keys: Mapping[str, NumericKey], problems: list[Problem]
) -> tuple[Parameter, ...]:
    """Read all parameters; what is wrong is added to the problems.

    Parameters
    ----------
    section : Node
        What the study states under ``parameters``.
    keys : mapping of str to NumericKey
        The numbers of the case by name.
    problems : list of Problem
    """
    if not section.section:
        problems.append(
            Problem(section.line, "parameters", f"{shown(section.plain())}; allowed: keys of the case")
        )
    found = []
    for name, node in section.section.items():
        where = Node(node.value, node.line, f"parameters.{name}")
        if name not in keys:
            problems.append(Problem(node.line, where.key, _no_such_number(name, keys)))
            continue
        try:
            found.append(_parameter(where, keys[name]))
        except _Wrong as wrong:
            problems.append(wrong.problem)
    problems += _contradictions(section)
    return tuple(found)


class _Wrong(CaseError):
    """Something is wrong at one place of a parameter."""

    def __init__(self, node: Node, message: str) -> None:
        super().__init__(message)
        self.problem = Problem(node.line, node.key, message)


def _no_such_number(name: str, keys: Iterable[str]) -> str:
    names = list(keys)
    suggestion = nearest(name, names) or nearest(
        name.rpartition(".")[2], [key.rpartition(".")[2] for key in names]
    )
    section = name.partition(".")[0]
    listed = [key for key in names if key.partition(".")[0] == section] or names
    return but_allowed(f"no number of the case{suggestion}", choices(listed))


def _contradictions(section: Node) -> list[Problem]:
    """Refuse ends of a span beside its centre or extent."""
    problems = []
    for name, node in section.section.items():
        owner, _, part = name.rpartition(".")
        rivals = [
            other
            for other in section.section
            if part in ("centre", "extent") and other.startswith(f"{owner}[")
        ]
        if rivals:
            message = f"beside {choices(rivals)}; allowed: centre and extent, or the ends"
            problems.append(Problem(node.line, f"parameters.{name}", message))
    return problems


def _parameter(node: Node, key: NumericKey) -> Parameter:
    if isinstance(node.value, list):
        return _list(node, key)
    if "distribution" in node.section:
        return _distribution(node, key)
    if "start" in node.section:
        return _range(node, key)
    raise _Wrong(node, f"{shown(node.plain())}; allowed: {FORMS}")


def _value(node: Node, key: NumericKey) -> float:
    """Return one value of the key, SI."""
    try:
        return float(key.kind.parse(node.plain(), None))  # type: ignore[arg-type]
    except RefusedValueError as error:
        raise _Wrong(node, str(error)) from error


def _list(node: Node, key: NumericKey) -> Parameter:
    items = node.value if isinstance(node.value, list) else []
    if not items:
        raise _Wrong(node, f"no values; allowed: {FORMS}")
    values = np.array([_value(item, key) for item in items])
    display = display_of(items[0].value, key.kind.unit)
    return Parameter(key, label_of(key.name), display, "list", {}, values)


def _range(node: Node, key: NumericKey) -> Parameter:
    _refuse_unknown(node, RANGE_KEYS)
    start, stop = (_value(_stated(node, name), key) for name in ("start", "stop"))
    count, spacing = _stated(node, "count"), node.section.get("spacing")
    if (
        not isinstance(count.value, int)
        or isinstance(count.value, bool)
        or not 2 <= count.value <= MOST_VALUES
    ):
        raise _Wrong(count, f"{shown(count.plain())}; allowed: a whole number from 2 to {MOST_VALUES}")
    if spacing is not None and spacing.value not in SPACINGS:
        raise _Wrong(spacing, not_one_of(spacing.plain(), SPACINGS))
    values = _spaced(node, start, stop, count.value, spacing is not None and spacing.value == "log")
    if key.whole and np.any(values != np.rint(values)):
        raise _Wrong(node, f"{values[1]:g} among the values; allowed: whole numbers")
    display = display_of(node.section["start"].value, key.kind.unit)
    return Parameter(key, _label(node, key), display, "range", {}, values)


def _spaced(node: Node, start: float, stop: float, count: int, logarithmic: bool) -> Floats:
    if not logarithmic:
        return np.linspace(start, stop, count)
    if not (start > 0 and stop > 0):
        raise _Wrong(node.section["spacing"], "log from or to a value that is not positive; allowed: linear")
    return np.geomspace(start, stop, count)


def _distribution(node: Node, key: NumericKey) -> Parameter:
    stated = node.section["distribution"]
    if not isinstance(stated.value, str) or stated.value not in NEEDED:
        raise _Wrong(stated, not_one_of(stated.plain(), NEEDED))
    if key.whole:
        raise _Wrong(
            stated, f"{stated.value} for a whole number; allowed: a list of values, {{start, stop, count}}"
        )
    kind = stated.value
    needed, optional = NEEDED[kind], OPTIONAL.get(kind, ())
    _refuse_unknown(node, ("distribution", *needed, *optional, "label"))
    read: dict[str, Callable[[Node, NumericKey], float]] = {SPREAD: _spread}
    numbers = {name: read.get(name, _value)(_stated(node, name), key) for name in needed}
    numbers |= {name: _value(node.section[name], key) for name in optional if name in node.section}
    _refuse_disorder(node, kind, numbers)
    display = display_of(node.section[needed[0]].value, key.kind.unit)
    return Parameter(key, _label(node, key), display, kind, numbers)


def _spread(node: Node, key: NumericKey) -> float:
    """Return a standard deviation, SI: of the key's unit, but not bound to its range."""
    unit = key.kind.unit
    allowed = (
        "a positive number" if unit == "1" else f"a positive {DIMENSION_OF_UNIT[unit].name} with its unit"
    )
    try:
        found = (
            parse_ratio(node.plain())
            if unit == "1"
            else parse_quantity(node.plain(), DIMENSION_OF_UNIT[unit])
        )
        if found <= 0:
            raise refused(node.plain(), allowed)
    except QuantityError as error:
        raise _Wrong(node, but_allowed(f"{shown(node.plain())}: {error}", allowed)) from error
    except RefusedValueError as error:
        raise _Wrong(node, str(error)) from error
    return found


def _refuse_disorder(node: Node, kind: str, numbers: Mapping[str, float]) -> None:
    low, high = numbers.get("low", -np.inf), numbers.get("high", np.inf)
    if not low < high:
        raise _Wrong(node.section["high"], f"{shown(node.section['high'].plain())}; allowed: above low")
    if kind == "loguniform" and not low > 0:
        raise _Wrong(node.section["low"], f"{shown(node.section['low'].plain())}; allowed: above 0")
    for name in ("mode", "mean"):
        if name in numbers and not low <= numbers[name] <= high:
            raise _Wrong(
                node.section[name], f"{shown(node.section[name].plain())}; allowed: from low to high"
            )


def _stated(node: Node, name: str) -> Node:
    found = node.section.get(name)
    if found is None:
        raise _Wrong(Node(None, node.line, f"{node.key}.{name}"), "missing; allowed: a value")
    return Node(found.value, found.line, f"{node.key}.{name}")


def _refuse_unknown(node: Node, known: tuple[str, ...]) -> None:
    for name, below in node.section.items():
        if name not in known:
            raise _Wrong(Node(None, below.line, f"{node.key}.{name}"), unknown_key(name, known))


def _label(node: Node, key: NumericKey) -> str:
    stated = node.section.get("label")
    if stated is None:
        return label_of(key.name)
    if not isinstance(stated.value, str) or not stated.value.strip():
        raise _Wrong(stated, f"{shown(stated.plain())}; allowed: a text")
    return stated.value
