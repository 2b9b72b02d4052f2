"""The kinds of value that a case file holds, each with the words that say what is allowed."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, TypeVar, get_args

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, PlainSerializer
from pydantic_core import CoreSchema, core_schema

from cases.errors import ColumnFileError, QuantityError, RefusedValueError
from cases.values.column_file import FLOW_RATE, PRESSURE, VELOCITY, Column
from cases.values.input_files import find_file, place_for
from cases.values.ranges import (
    ANGLES,
    COMPLIANCES,
    COORDINATES,
    DENSITIES,
    FLOW_RATES,
    MODULI,
    OFFSETS,
    PERIODS,
    POSITIONS,
    PRESSURES,
    RESISTANCES,
    SERIES_RESISTANCES,
    SIZES,
    TIME_STEPS,
    TRANSITION_ANGLES,
    VELOCITIES,
    VISCOSITIES,
    Range,
)
from cases.values.units import DIMENSIONS, parse_quantity, parse_ratio
from cases.values.wall_curve_file import WallCurve, read_wall_curve
from cases.values.waveform_file import Waveform, read_waveform
from cases.values.wording import but_allowed, choices, not_one_of, shown, shown_path

T = TypeVar("T")


@dataclass(frozen=True)
class Context:
    """What the schema must know beyond the values.

    Attributes
    ----------
    folder : pathlib.Path
        Where files are looked for.
    variants : tuple of str
        Names of the file's variants.
    results_exist : bool
        Whether the files of a 3D run must exist where the case does not say how they are made.
    """

    folder: Path
    variants: tuple[str, ...]
    results_exist: bool = True


@dataclass(frozen=True, eq=False)
class ValueKind:
    """How one kind of value is checked; used as `Annotated[type, ValueKind(...)]`.

    Attributes
    ----------
    parse : callable
        From what the file states, and the context or None, to the value; raises `RefusedValueError`.
    allowed : str
        What is allowed, in words.
    json_schema : dict
        The kind for editors.
    unit : str
        SI unit of a number, as `cases.fields` writes units ("1": none); empty for what is no number.
    """

    parse: Callable[[object, Context | None], object]
    allowed: str
    json_schema: dict[str, Any]
    unit: str = ""

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Check values by `parse` alone; see pydantic's documentation of custom types."""

        def check(value: object, info: "core_schema.ValidationInfo[Context | None]") -> object:
            return self.parse(value, info.context)

        return core_schema.with_info_plain_validator_function(check)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """Describe the value as a case file states it."""
        return {**self.json_schema, "description": self.allowed}


def refused(
    value: object, allowed: str, reason: str = "", key: tuple[str | int, ...] = ()
) -> RefusedValueError:
    """Return the error "found: reason; allowed: …"."""
    found = f"{shown(value)}: {reason}" if reason else shown(value)
    return RefusedValueError(but_allowed(found, allowed), key)


def quantity(within: Range, example: str) -> ValueKind:
    """Return the kind of quantities with a unit in a range; values become floats in SI units."""
    allowed, dimension = f'{within}, e.g. "{example}"', DIMENSIONS[within.dimension]

    def parse(value: object, _context: Context | None) -> float:
        try:
            number = parse_quantity(value, dimension)
        except QuantityError as error:
            raise refused(value, allowed, str(error)) from error
        if number not in within:
            raise refused(value, allowed)
        return number

    return ValueKind(parse, allowed, {"type": "string", "examples": [example]}, dimension.unit)


def whole_number(allowed: str, is_allowed: Callable[[int], bool]) -> ValueKind:
    """Return the kind of whole numbers without a unit."""

    def parse(value: object, _context: Context | None) -> int:
        if not isinstance(value, int) or isinstance(value, bool) or not is_allowed(value):
            raise refused(value, allowed)
        return value

    return ValueKind(parse, allowed, {"type": "integer"}, "1")


def number(allowed: str, is_allowed: Callable[[float], bool]) -> ValueKind:
    """Return the kind of numbers without a unit; `is_allowed` must refuse what is not finite."""

    def parse(value: object, _context: Context | None) -> float:
        if not isinstance(value, int | float) or isinstance(value, bool) or not is_allowed(value):
            raise refused(value, allowed)
        return float(value)

    return ValueKind(parse, allowed, {"type": "number"}, "1")


def text(allowed: str, pattern: str) -> ValueKind:
    """Return the kind of texts that match a pattern in full."""

    def parse(value: object, _context: Context | None) -> str:
        if not isinstance(value, str) or re.fullmatch(pattern, value) is None:
            raise refused(value, allowed)
        return value

    return ValueKind(parse, allowed, {"type": "string"})


def one_of(literal: object) -> ValueKind:
    """Return the kind of words that a `Literal`, or a union of such, lists."""
    words = words_of(literal)
    return registered(lambda: words)


def registered(names: Callable[[], tuple[str, ...]]) -> ValueKind:
    """Return the kind of words that a registry holds at the time when a value is checked."""

    def parse(value: object, _context: Context | None) -> str:
        if not isinstance(value, str) or value not in names():
            raise RefusedValueError(not_one_of(value, names()))
        return value

    return ValueKind(parse, choices(names()), {"enum": list(names())})


def words_of(literal: object) -> tuple[str, ...]:
    """Return the words that a `Literal`, or a union of such, lists."""
    parts = get_args(literal)
    return tuple(w for part in parts for w in ((part,) if isinstance(part, str) else words_of(part)))


def distinct(items: tuple[T, ...]) -> tuple[T, ...]:
    """Return a list that is not empty and states nothing twice; refuse any other."""
    if not items:
        raise refused(items, "one item or more", "no items")
    if len(set(items)) < len(items):
        raise refused(items, "different items", "an item twice")
    return items


def existing_file(value: object, context: Context | None) -> Path:
    """Return the absolute path of a file that a case names; refuse what is none."""
    if not isinstance(value, str) or not value:
        raise refused(value, "the path of a file")
    folder = Path.cwd() if context is None else context.folder
    found = find_file(value, folder)
    if found is None:
        searched = "" if Path(value).is_absolute() else f"; looked for in {folder} and the folders above it"
        raise RefusedValueError(f"{shown_path(value)}: no such file{searched}")
    return found


def _run_file(value: object, context: Context | None) -> Path:
    """Return the path of a file where it is or, as long as there is none, where it is to be."""
    if not isinstance(value, str) or not value:
        raise refused(value, "the path of a file")
    folder = Path.cwd() if context is None else context.folder
    return find_file(value, folder) or place_for(value, folder)


def counted(most: int) -> ValueKind:
    """Return the kind of whole numbers from 1 to `most`."""
    return whole_number(f"a whole number from 1 to {most}", lambda value: 1 <= value <= most)


def _waveform_of(quantity: Column) -> ValueKind:
    """Return the kind of waveforms of a quantity, stated as the path of a file."""

    def parse(value: object, context: Context | None) -> Waveform:
        path = existing_file(value, context)
        try:
            return read_waveform(path, name=shown_path(str(value)), quantity=quantity)
        except ColumnFileError as error:
            raise RefusedValueError(str(error)) from error

    return ValueKind(parse, "the path of a waveform (.csv)", PATH_SCHEMA)


def _wall_curve(value: object, context: Context | None) -> WallCurve:
    path = existing_file(value, context)
    try:
        return read_wall_curve(path, name=shown_path(str(value)))
    except ColumnFileError as error:
        raise RefusedValueError(str(error)) from error


def _samples(waveform: Waveform) -> dict[str, list[float]]:
    """Return what a waveform says, wherever its file lies."""
    times, values = zip(*waveform.rows, strict=True)
    return {"times": list(times), "values": list(values)}


def _curve_samples(curve: WallCurve) -> dict[str, list[float]]:
    """Return what a wall curve says, wherever its file lies."""
    radii, pressures = zip(*curve.rows, strict=True)
    return {"radii": list(radii), "pressures": list(pressures)}


def _switch(value: object, _context: Context | None) -> bool:
    if not isinstance(value, bool):
        raise refused(value, SWITCH)
    return value


def ratio(allowed: str, least: float, largest: float) -> ValueKind:
    """Return the kind of ratios in a range, as numbers or in %."""

    def parse(value: object, _context: Context | None) -> float:
        try:
            found = parse_ratio(value)
        except QuantityError as error:
            raise refused(value, allowed, str(error)) from error
        if not least <= found <= largest:
            raise refused(value, allowed)
        return found

    return ValueKind(parse, allowed, {"type": ["string", "number"]}, "1")


STEP_TOLERANCE = 1e-3
_STEP_TOLERANCE = ratio('a ratio from 1e-6 to 0.1, e.g. "0.1 %", or none', 1e-6, 0.1)


def _step_tolerance(value: object, context: Context | None) -> object:
    """Return None where the word none switches it off; what is left empty is as if it were not stated."""
    if value == "none":
        return None
    return STEP_TOLERANCE if value is None else _STEP_TOLERANCE.parse(value, context)


SWITCH = "true, false"
PATH_SCHEMA = {"type": "string", "minLength": 1}

Length = Annotated[float, quantity(COORDINATES, "0 mm")]
ArteryLength = Annotated[float, quantity(SIZES, "15 mm")]
Radius = Annotated[float, quantity(SIZES, "2.5 mm")]
Thickness = Annotated[float, quantity(SIZES, "0.5 mm")]
Position = Annotated[float, quantity(POSITIONS, "5 mm")]
TransitionLength = Annotated[float, quantity(SIZES, "2.5 mm")]
Angle = Annotated[float, quantity(ANGLES, "135 deg")]
TransitionAngle = Annotated[float, quantity(TRANSITION_ANGLES, "67.5 deg")]
Time = Annotated[float, quantity(OFFSETS, "0.2 s")]
TimeStep = Annotated[float, quantity(TIME_STEPS, "1 ms")]
Period = Annotated[float, quantity(PERIODS, "0.8 s")]
Ramp = Annotated[float, quantity(PERIODS, "8 ms")]
Velocity = Annotated[float, quantity(VELOCITIES, "8.4 cm/s")]
FlowRate = Annotated[float, quantity(FLOW_RATES, "5 ml/s")]
Pressure = Annotated[float, quantity(PRESSURES, "9330 Pa")]
Modulus = Annotated[float, quantity(MODULI, "0.6 MPa")]
Density = Annotated[float, quantity(DENSITIES, "1060 kg/m^3")]
Viscosity = Annotated[float, quantity(VISCOSITIES, "0.0035 Pa s")]
Resistance = Annotated[float, quantity(RESISTANCES, "1.358e9 Pa s/m^3")]
SeriesResistance = Annotated[float, quantity(SERIES_RESISTANCES, "1.358e9 Pa s/m^3")]
Compliance = Annotated[float, quantity(COMPLIANCES, "1e-10 m^3/Pa")]
Exponent = Annotated[float, number("a number from 0.01 to 1000", lambda value: 0.01 <= value <= 1000)]
Scale = Annotated[float, number("a number from 0.001 to 1000", lambda value: 0.001 <= value <= 1000)]
Tolerance = Annotated[float, ratio('a ratio from 1e-9 to 0.1, e.g. "0.1 %"', 1e-9, 0.1)]
CourantLimit = Annotated[float, number("a number from 0.001 to 1e6", lambda value: 0.001 <= value <= 1e6)]
DefectLimit = Annotated[float, ratio('a ratio from 1e-15 to 1, e.g. "0.1 %"', 1e-15, 1.0)]
StepTolerance = Annotated[
    float | None, ValueKind(_step_tolerance, _STEP_TOLERANCE.allowed, _STEP_TOLERANCE.json_schema, "1")
]
Switch = Annotated[bool, ValueKind(_switch, SWITCH, {"type": "boolean"})]
Words = Annotated[str, text("a text", r"(?s).*\S.*")]
NAME_PATTERN = r"[A-Za-z0-9][A-Za-z0-9_-]{0,63}"
NAME_CHARACTERS = "up to 64 letters, digits, - and _"
Name = Annotated[str, text(f"{NAME_CHARACTERS}, e.g. axisymmetric", NAME_PATTERN)]
ExistingFile = Annotated[Path, ValueKind(existing_file, "the path of a file", PATH_SCHEMA)]
RunFile = Annotated[Path, ValueKind(_run_file, "the path of a file", PATH_SCHEMA)]
_SAMPLES = PlainSerializer(_samples, when_used="json")
VelocityWaveform = Annotated[Waveform, _waveform_of(VELOCITY), _SAMPLES]
FlowWaveform = Annotated[Waveform, _waveform_of(FLOW_RATE), _SAMPLES]
PressureWaveform = Annotated[Waveform, _waveform_of(PRESSURE), _SAMPLES]
WallCurveFile = Annotated[
    WallCurve,
    ValueKind(_wall_curve, "the path of a wall curve (.csv)", PATH_SCHEMA),
    PlainSerializer(_curve_samples, when_used="json"),
]
