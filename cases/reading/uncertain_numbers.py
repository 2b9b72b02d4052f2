"""Uncertain inputs with the units of the case that they belong to."""

from collections.abc import Mapping
from dataclasses import dataclass

from cases.errors import Problem, QuantityError, RefusedValueError
from cases.reading.models import ModelVariant
from cases.reading.numeric_keys import NumericKey, numeric_keys
from cases.reading.yaml_nodes import Node, join
from cases.sections.case import Case
from cases.sections.uncertainty import UncertainInput
from cases.values.kinds import refused
from cases.values.units import DIMENSION_OF_UNIT, parse_quantity, parse_ratio
from cases.values.wording import but_allowed, choices, nearest

# numbers that say where and when results are, not what they are
OF_THE_COMPARISON = ("geometry.length", "inlet.period", "inlet.fourier.period")


@dataclass(frozen=True)
class UncertainNumber:
    """An uncertain number of a case, SI.

    Attributes
    ----------
    key : NumericKey
        Which one; its value is the mean of a normal distribution.
    numbers : dict of str to float
        ``mean`` and ``standard_deviation`` of a normal distribution, or ``low`` and ``high`` of a uniform
        one.
    """

    key: NumericKey
    numbers: Mapping[str, float]

    @property
    def standard_deviation(self) -> float:
        """Standard deviation of the number; of a uniform one its width over √12."""
        if "mean" in self.numbers:
            return self.numbers["standard_deviation"]
        return float((self.numbers["high"] - self.numbers["low"]) / 12**0.5)


def offered_keys(case: Case) -> dict[str, NumericKey]:
    """Numbers of a case that may be uncertain, by name: physical ones that are no whole numbers."""
    return {
        name: key
        for name, key in numeric_keys(case).items()
        if not (key.whole or name.startswith("solver.") or name in OF_THE_COMPARISON or key.value is None)
    }


def uncertain_numbers(case: Case) -> tuple[dict[str, UncertainNumber], list[str]]:
    """Uncertain numbers of a case by name, and names of those that it lacks.

    Raises
    ------
    RefusedValueError
        What is stated does not fit the case; its key is the way below ``uncertainty.inputs``.
    """
    offered = offered_keys(case)
    stated = () if case.uncertainty is None else case.uncertainty.inputs
    found = {each.key: _number(each, offered[each.key]) for each in stated if each.key in offered}
    return found, [each.key for each in stated if each.key not in offered]


def _number(stated: UncertainInput, key: NumericKey) -> UncertainNumber:
    place = (stated.key, stated.form)
    base = key.value or 0.0
    if isinstance(stated.stated, tuple):
        low, high = (_value(each, key, (*place, n)) for n, each in enumerate(stated.stated))
        if not low <= base <= high or low == high:
            raise refused(
                " to ".join(map(str, stated.stated)),
                f"a low and a high value around that of the case ({key.stated(base)})",
                key=place,
            )
        return UncertainNumber(key, {"low": low, "high": high})
    spread = (
        float(str(stated.stated)) * abs(base)
        if stated.form == "relative"
        else _spread(stated.stated, key, place)
    )
    if spread == 0:
        raise refused("a share of 0", "standard_deviation or range", key=place)
    return UncertainNumber(key, {"mean": base, "standard_deviation": spread})


def _value(stated: object, key: NumericKey, place: tuple[str | int, ...]) -> float:
    try:
        return float(key.kind.parse(stated, None))  # type: ignore[arg-type]
    except RefusedValueError as error:
        raise RefusedValueError(str(error), place) from error


def _spread(stated: object, key: NumericKey, place: tuple[str | int, ...]) -> float:
    """Return a standard deviation, SI: of the key's unit, but not bound to its range."""
    unit = key.kind.unit
    allowed = (
        "a positive number" if unit == "1" else f"a positive {DIMENSION_OF_UNIT[unit].name} with its unit"
    )
    try:
        found = parse_ratio(stated) if unit == "1" else parse_quantity(stated, DIMENSION_OF_UNIT[unit])
    except QuantityError as error:
        raise refused(stated, allowed, str(error), place) from error
    if found <= 0:
        raise refused(stated, allowed, key=place)
    return found


def uncertainty_problems(
    cases: Mapping[ModelVariant, Case], nodes: Mapping[ModelVariant, Node]
) -> list[Problem]:
    """Problems of uncertain inputs: units that do not fit, and keys that no variant of any model has.

    Parameters
    ----------
    cases : mapping of (str, str) to Case
        Checked, by model and variant.
    nodes : mapping of (str, str) to Node
        The whole of each, merged.
    """
    problems: list[Problem] = []
    offered = {name: None for case in cases.values() for name in offered_keys(case)}
    for place, case in cases.items():
        root = nodes[place]
        try:
            _, lacking = uncertain_numbers(case)
        except RefusedValueError as error:
            problems.append(_problem(root, error.key, str(error)))
            continue
        for name in lacking:
            if name not in offered:
                message = but_allowed(
                    f"no number of the case that may be uncertain{nearest(name, offered)}", choices(offered)
                )
                problems.append(_problem(root, (name,), message))
    return list(dict.fromkeys(problems))


def _problem(root: Node, path: tuple[str | int, ...], message: str) -> Problem:
    node = root.find(("uncertainty", "inputs", *path))
    return Problem(node.line, node.key or join("uncertainty", "inputs", *path), message)
