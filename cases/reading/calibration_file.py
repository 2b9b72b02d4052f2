"""A calibration file: which numbers of a case are fitted, between what limits, and to what."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from pydantic import ValidationInfo, field_validator

from cases.errors import CaseFileError, Problem, QuantityError, RefusedValueError
from cases.fields import FIELDS
from cases.reading.case_file import CaseFile, check_section, load_case_file, part_of, unknown_keys
from cases.reading.file_kinds import require_kind
from cases.reading.numeric_keys import NumericKey, numeric_keys
from cases.reading.template import Template, load_template
from cases.reading.yaml_nodes import Node, Scalar, parse_yaml, read_text
from cases.sections.base import Section
from cases.sections.case import Case
from cases.values.kinds import (
    STEP_TOLERANCE,
    Context,
    ExistingFile,
    Name,
    StepTolerance,
    ValueKind,
    Words,
    distinct,
    one_of,
    refused,
)
from cases.values.ranges import SIZES, Range
from cases.values.units import DIMENSION_OF_UNIT, DIMENSIONS, parse_quantity
from cases.values.wording import choices, not_one_of, shown, unknown_key

FILE_KEYS = ("name", "title", "case", "variant", "parameters", "targets", "reference", "error_tolerance")
NOT_OF_AN_ARTERY = "solver"  # whose numbers say how well it is computed

VALUES = {"pressure": Range("pressure", "1 Pa", "1e9 Pa"), "length": SIZES}  # of targets
LEAST_SHARE, LARGEST_SHARE = 1e-6, 10.0  # of a target's value that its uncertainty may be

CycleQuantity = Literal[
    "systolic_pressure", "diastolic_pressure", "pulse_pressure", "largest_radius", "least_radius"
]
QuantityOverTime = Literal["section_pressure", "section_flow_rate", "radius"]
Place = str | float

PLACE = 'inlet, outlet, or a distance from the inlet, e.g. "7.5 mm"'
ANY_PLACE = f"artery (all of it), {PLACE}"


def _place(value: object, _context: Context | None) -> Place:
    if value in ("inlet", "outlet"):
        return str(value)
    try:
        return parse_quantity(value, DIMENSIONS["length"])
    except QuantityError as error:
        raise refused(value, PLACE) from error


def _any_place(value: object, context: Context | None) -> Place:
    try:
        return "artery" if value == "artery" else _place(value, context)
    except RefusedValueError as error:
        raise refused(value, ANY_PLACE) from error


_AS_STATED = ValueKind(lambda value, _context: value, "a quantity with its unit", {"type": "string"})
_PLACE = ValueKind(_place, PLACE, {"type": "string"})
_ANY_PLACE = ValueKind(_any_place, ANY_PLACE, {"type": "string"})


class Target(Section):
    """One number of the last cycle that the case is to attain.

    Attributes
    ----------
    quantity : str
        A name of `cases.fields.FIELDS`.
    value : float
        In the quantity's SI unit.
    at : str or float
        ``artery`` (extremes over all of it), ``inlet``, ``outlet``, or the distance from the inlet in m.
    uncertainty : float or None
        Standard deviation of the value, in its unit; None where none is stated.
    """

    quantity: Annotated[CycleQuantity, one_of(CycleQuantity)]
    value: Annotated[float, _AS_STATED]
    at: Annotated[Place, _ANY_PLACE] = "artery"
    uncertainty: Annotated[float | None, _AS_STATED] = None

    @field_validator("value", "uncertainty")
    @classmethod
    def _in_unit(cls, stated: object, info: ValidationInfo) -> float | None:
        quantity = info.data.get("quantity")
        if quantity is None or stated is None:
            return None  # the target is refused for its quantity already
        dimension = DIMENSION_OF_UNIT[FIELDS[quantity].unit]
        within, value = VALUES[dimension.name], info.data.get("value")
        allowed = f"{within}, in units such as {choices(dimension.common_units)}"
        try:
            found = parse_quantity(stated, dimension)
        except QuantityError as error:
            raise refused(stated, allowed, str(error)) from error
        if info.field_name == "value" and found not in within:
            raise refused(stated, allowed)
        if info.field_name == "uncertainty" and value and not LEAST_SHARE <= found / value <= LARGEST_SHARE:
            raise refused(stated, f"from {LEAST_SHARE:g} to {LARGEST_SHARE:g} times the value")
        return found


class ReferenceTarget(Section):
    """What the case's 3D reference has over its last cycle.

    Attributes
    ----------
    quantity : str
        A name of `cases.fields.FIELDS`; a radius is averaged over φ.
    at : tuple of str or float
        Sections: ``inlet``, ``outlet``, or distances from the inlet in m.
    """

    quantity: Annotated[QuantityOverTime, one_of(QuantityOverTime)]
    at: tuple[Annotated[Place, _PLACE], ...] = ("outlet",)

    _at = field_validator("at")(distinct)


class _Heading(Section):
    name: Name
    title: Words | None = None
    case: ExistingFile
    variant: Name | None = None
    targets: tuple[Target, ...] = ()
    reference: ReferenceTarget | None = None
    error_tolerance: StepTolerance = STEP_TOLERANCE

    _targets = field_validator("targets")(distinct)


class _Limits(Section):
    """What a file states of one parameter; the key tells how it is read."""

    low: Annotated[object, _AS_STATED]
    high: Annotated[object, _AS_STATED]
    start: Annotated[object, _AS_STATED] = None


@dataclass(frozen=True)
class Parameter:
    """A number of the case that is fitted.

    Attributes
    ----------
    key : NumericKey
    low, high, start : float
        Limits, and where the search begins, in SI units.
    """

    key: NumericKey
    low: float
    high: float
    start: float


@dataclass(frozen=True)
class Calibration:
    """A checked calibration file.

    Attributes
    ----------
    path : pathlib.Path
    text, name, title : str
        The title is the name where none is stated.
    file : CaseFile
    variant : str
        One of its variants.
    template : Template
        Of that variant, for parameters to be replaced in.
    parameters : tuple of Parameter
    targets : tuple of Target
        Empty where there is a reference.
    reference : ReferenceTarget or None
    error_tolerance : float or None
        Relative error of each target by which the time step is chosen; None: the case's own step.
    """

    path: Path
    text: str
    name: str
    title: str
    file: CaseFile
    variant: str
    template: Template
    parameters: tuple[Parameter, ...]
    targets: tuple[Target, ...]
    reference: ReferenceTarget | None
    error_tolerance: float | None

    @property
    def case(self) -> Case:
        """The case as its file states it."""
        return self.file.variants[self.variant]


def load_calibration(path: Path) -> Calibration:
    """Read and check a calibration file and the case that it names.

    Raises
    ------
    CaseFileError
        Anything wrong with either: a line for each problem with file, line, key, what was found and what is
        allowed.
    """
    text = read_text(path)
    root = parse_yaml(text, path)
    require_kind(root, path, "calibration")
    problems = unknown_keys(root, FILE_KEYS)
    context = Context(path.resolve().parent, ())
    stated = part_of(root, tuple(key for key in FILE_KEYS if key != "parameters"))
    heading = check_section(_Heading, stated, context, problems)
    if heading is None:
        raise CaseFileError.of_problems(path, problems)
    file = load_case_file(heading.case)
    variant = _variant(file, heading.variant, root, problems)
    if variant is None:
        raise CaseFileError.of_problems(path, problems)
    parameters = _parameters(root, file.variants[variant], problems)
    problems += _of_targets(heading, root, file.variants[variant])
    if not problems and heading.targets and len(heading.targets) < len(parameters):
        found = f"{len(heading.targets)} for {len(parameters)} parameters"
        problems.append(_problem(root, "targets", f"{found}; allowed: as many as parameters, or more"))
    if problems:
        raise CaseFileError.of_problems(path, problems)
    return Calibration(
        path,
        text,
        heading.name,
        heading.title or heading.name,
        file,
        variant,
        load_template(file.path, variant),
        tuple(parameters),
        heading.targets,
        heading.reference,
        heading.error_tolerance,
    )


def _problem(root: Node, key: str, message: str) -> Problem:
    return Problem(root.find((key,)).line, key, message)


def _variant(file: CaseFile, stated: str | None, root: Node, problems: list[Problem]) -> str | None:
    if stated is None and len(file.variants) == 1:
        return next(iter(file.variants))
    if stated is None:
        problems.append(_problem(root, "variant", f"missing; allowed: {choices(file.variants)}"))
    elif stated not in file.variants:
        problems.append(_problem(root, "variant", not_one_of(stated, file.variants)))
        return None
    return stated


def _of_targets(heading: _Heading, root: Node, case: Case) -> list[Problem]:
    """Find what is wrong with the targets together, and with their places in the artery."""
    problems = []
    if bool(heading.targets) == (heading.reference is not None):
        found = "both targets and a reference" if heading.targets else "neither targets nor a reference"
        problems.append(Problem(root.line, "targets", f"{found}; allowed: one of them"))
    if heading.reference is not None and case.reference is None:
        problems.append(_problem(root, "reference", "the case states none; allowed: targets"))
    uncertain = [target.uncertainty is not None for target in heading.targets]
    if any(uncertain) and not all(uncertain):
        problems.append(_problem(root, "targets", "some without uncertainty; allowed: all with one, or none"))
    places: list[tuple[tuple[str | int, ...], Place]] = [
        (("targets", n, "at"), target.at) for n, target in enumerate(heading.targets)
    ]
    if heading.reference is not None:
        places += [(("reference", "at", n), place) for n, place in enumerate(heading.reference.at)]
    for path, place in places:
        if isinstance(place, float) and not 0 <= place <= case.geometry.length:
            node = root.find(path)
            message = f"{place:g} m; allowed: from 0 m to the artery's length ({case.geometry.length:g} m)"
            problems.append(Problem(node.line, node.key, message))
    return problems


def _parameters(root: Node, case: Case, problems: list[Problem]) -> list[Parameter]:
    """Return the parameters; add what is wrong to the problems."""
    known = {
        name: key
        for name, key in numeric_keys(case).items()
        if not key.whole and key.path[0] != NOT_OF_AN_ARTERY
    }
    stated = root.section.get("parameters")
    if stated is None or not stated.section:
        found = "missing" if stated is None else shown(stated.plain())
        allowed = "a section with low and high of each number, under its key, e.g. outlet.resistance"
        problems.append(_problem(root, "parameters", f"{found}; allowed: {allowed}"))
        return []
    found_parameters = []
    for name, node in stated.section.items():
        if name not in known:
            problems.append(Problem(node.line, "parameters", unknown_key(name, known)))
            continue
        parameter = _parameter(known[name], node, problems)
        if parameter is not None:
            found_parameters.append(parameter)
    return found_parameters


def _parameter(key: NumericKey, node: Node, problems: list[Problem]) -> Parameter | None:
    if not isinstance(node.value, dict):
        allowed = f"a section with the keys {choices(_Limits.model_fields)}"
        problems.append(Problem(node.line, node.key, f"{shown(node.plain())}; allowed: {allowed}"))
        return None
    before = len(problems)
    check_section(_Limits, node, None, problems)
    if len(problems) > before:
        return None
    low, high, start = (_number(key, node, name, problems) for name in ("low", "high", "start"))
    if low is None or high is None or len(problems) > before:
        return None
    if not low < high:
        problems.append(Problem(node.line, node.key, f"low {low:g}, high {high:g}; allowed: low below high"))
        return None
    begin = key.value if start is None else start
    if begin is None:
        problems.append(Problem(node.line, node.key, "start missing; the case states no value to begin with"))
        return None
    if not low <= begin <= high:
        whose = "the case's own value" if start is None else "start"
        message = f"{whose} {begin:g}; allowed: from low ({low:g}) to high ({high:g})"
        problems.append(Problem(node.line, node.key, message))
        return None
    return Parameter(key, low, high, begin)


def _number(key: NumericKey, node: Node, name: str, problems: list[Problem]) -> float | None:
    """Read a limit as the case file itself reads the key."""
    place = node.section.get(name)
    if place is None or place.value is None:
        return None
    try:
        return float(key.kind.parse(place.plain(), None))  # type: ignore[arg-type]
    except RefusedValueError as error:
        problems.append(Problem(place.line, place.key, str(error)))
        return None


def changed_values(
    keys: Iterable[NumericKey], values: Iterable[float]
) -> dict[tuple[str | int, ...], Scalar]:
    """Return what a case file would state under each key, by its path."""
    return {key.path: key.stated(value) for key, value in zip(keys, values, strict=True)}
