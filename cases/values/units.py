"""From "15 mm" to 0.015: quantities with units become SI numbers here and nowhere else."""

import decimal
import functools
import math
import re
from dataclasses import dataclass
from decimal import Decimal
from typing import TYPE_CHECKING

from cases.errors import QuantityError
from cases.values.common_units import common_unit
from cases.values.wording import nearest, shown

if TYPE_CHECKING:
    import pint

LONGEST_TEXT = 100
NUMBER = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
LETTER = r"[^\W\d_]"
TERM = rf"(?:{LETTER}+(?:[0-9]{LETTER}+)?(?:\^?-?[1-9])?|°|%)"  # mm, m^3, m3, s-1; cmH2O
UNIT = re.compile(rf"{TERM}(?:(?:\s*[*/]\s*|\s+){TERM})*")
BARE_EXPONENT = re.compile(rf"(?<={LETTER})(-?[0-9])(?!\w)")
SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻·", "0123456789-*")


@dataclass(frozen=True)
class Dimension:
    """A kind of quantity.

    Attributes
    ----------
    name : str
        Words for messages.
    unit : str
        SI unit, written as in `cases.fields`.
    common_units : tuple of str
        Units to suggest in place of an unknown one.
    """

    name: str
    unit: str
    common_units: tuple[str, ...]


DIMENSIONS = {
    dimension.name: dimension
    for dimension in (
        Dimension("length", "m", ("m", "cm", "mm", "µm")),
        Dimension("time", "s", ("s", "ms", "µs", "min")),
        Dimension("velocity", "m s-1", ("m/s", "cm/s", "mm/s")),
        Dimension("pressure", "Pa", ("Pa", "kPa", "MPa", "mmHg", "dyn/cm^2")),
        Dimension("density", "kg m-3", ("kg/m^3", "g/cm^3")),
        Dimension("viscosity", "Pa s", ("Pa s", "mPa s", "kg/m/s", "poise", "cP")),
        Dimension("flow rate", "m3 s-1", ("m^3/s", "cm^3/s", "ml/s", "ml/min", "l/min")),
        Dimension("resistance", "Pa s m-3", ("Pa s/m^3", "mmHg s/ml", "dyn s/cm^5")),
        Dimension("compliance", "m3 Pa-1", ("m^3/Pa", "ml/mmHg", "cm^5/dyn")),
        Dimension("angle", "rad", ("deg", "rad")),
    )
}
DIMENSION_OF_UNIT = {dimension.unit: dimension for dimension in DIMENSIONS.values()}


def parse_quantity(text: object, dimension: Dimension) -> float:
    """Convert a text such as "15 mm" to a number in SI units.

    The text is a decimal number and a unit; a unit is a product of powers such as "Pa s/m^3" or "cm³/s".
    The result is the float closest to the exact decimal value: "0.1 mm" gives 0.0001.

    Parameters
    ----------
    text : object
        What the case file states; anything but a text is refused.
    dimension : Dimension
        The expected kind of quantity.

    Returns
    -------
    float
        The value in `dimension.unit`.

    Raises
    ------
    QuantityError
        No unit, an unknown unit, a unit of another dimension, or a value that is not finite.
        The message is the reason alone, without the text itself.
    """
    if isinstance(text, int | float) and not isinstance(text, bool):
        raise QuantityError("no unit")
    match = re.match(NUMBER, text.strip()) if isinstance(text, str) and len(text) <= LONGEST_TEXT else None
    if match is None:
        raise QuantityError("not a number with a unit")
    unit = match.string[match.end() :].strip()
    if not unit:
        raise QuantityError("no unit")
    return parse_number(match[0], _si_factor(unit, dimension))


def parse_ratio(text: object) -> float:
    """Convert a percentage such as "2 %", or a plain number, to a ratio.

    Raises
    ------
    QuantityError
        Anything else, or a value that is not finite.
    """
    if isinstance(text, bool) or not isinstance(text, str | int | float):
        raise QuantityError("not a percentage")
    number, percent, rest = str(text).partition("%")
    if rest:
        raise QuantityError("not a percentage")
    return parse_number(number.strip(), Decimal("0.01") if percent else Decimal(1))


def parse_number(text: str, factor: Decimal) -> float:
    """Convert a decimal number to the float closest to the number times a factor.

    Raises
    ------
    QuantityError
        Not a decimal number, or a value that is not finite.
    """
    if len(text) > LONGEST_TEXT or re.fullmatch(NUMBER, text) is None:
        raise QuantityError("not a number")
    try:
        value = float(Decimal(text) * factor)
    except decimal.DecimalException as error:
        raise QuantityError("out of range") from error
    if not math.isfinite(value):
        raise QuantityError("out of range")
    return value


@functools.cache
def _registry() -> "pint.UnitRegistry[Decimal]":
    import pint

    # decimal factors keep 0.6 MPa at exactly 600000 Pa
    return pint.UnitRegistry(non_int_type=Decimal)


@functools.cache
def _base_units(unit: str) -> tuple[Decimal, object]:
    """Return the SI factor of any unit and its base units; raises `pint.errors.PintError`."""
    registry = _registry()
    factor, base = registry.get_base_units(registry.parse_units(BARE_EXPONENT.sub(r"^\1", unit)))
    return Decimal(str(factor)), base


def _si_factor(unit: str, dimension: Dimension) -> Decimal:
    plain_unit = unit.translate(SUPERSCRIPTS)
    if UNIT.fullmatch(plain_unit) is None:
        raise QuantityError("not a number with a unit")
    factor, fits = _common_factor(plain_unit, dimension) or _any_factor(unit, plain_unit, dimension)
    if not fits:
        raise QuantityError(f"{unit} is no unit of {dimension.name}")
    return factor


def _common_factor(unit: str, dimension: Dimension) -> tuple[Decimal, bool] | None:
    """Return the factor of a unit of common terms, and whether it is one of a dimension; None for others."""
    found, wanted = common_unit(unit), common_unit(dimension.unit)
    if found is None or wanted is None:
        return None
    return found[0], found[1] == wanted[1]


def _any_factor(stated: str, unit: str, dimension: Dimension) -> tuple[Decimal, bool]:
    from pint.errors import PintError

    try:
        factor, base = _base_units(unit)
    except (PintError, ValueError) as error:  # ValueError: the word nan
        message = f"unknown unit {shown(stated)}{nearest(stated, dimension.common_units)}"
        raise QuantityError(message) from error
    # base units, not dimensionality: pint counts an angle as dimensionless, and 15 mm rad is no length
    return factor, base == _base_units(dimension.unit)[1]
