"""From "15 mm" to 0.015: quantities with units become SI numbers here and nowhere else."""

import decimal
import functools
import math
import re
from dataclasses import dataclass
from decimal import Decimal
from typing import TYPE_CHECKING

from cases.errors import QuantityError
from cases.wording import nearest, shown

if TYPE_CHECKING:
    import pint

LONGEST_TEXT = 100
NUMBER = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
TERM = r"(?:[^\W\d_][^\W\d_]*[0-9]?[^\W\d_]+|[^\W\d_])(?:\^?-?[0-9])?|°|%"
QUANTITY = re.compile(rf"({NUMBER})\s*((?:{TERM})(?:\s*[*/·]\s*(?:{TERM})|\s+(?:{TERM}))*)?")
SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻·", "0123456789-*")
BARE_EXPONENT = re.compile(r"(?<=[^\W\d_])(-?[0-9])(?!\w)")


@dataclass(frozen=True)
class Dimension:
    """A kind of quantity.

    Attributes
    ----------
    name : str
        Words for messages.
    unit : str
        SI unit, written as in `cases.fields`.
    example : str
        A typical quantity, as a case file states it.
    common_units : tuple of str
        Units to suggest in place of an unknown one.
    """

    name: str
    unit: str
    example: str
    common_units: tuple[str, ...]


DIMENSIONS = {
    dimension.name: dimension
    for dimension in (
        Dimension("length", "m", "15 mm", ("m", "cm", "mm", "µm")),
        Dimension("time", "s", "1 ms", ("s", "ms", "µs", "min")),
        Dimension("velocity", "m s-1", "8.4 cm/s", ("m/s", "cm/s", "mm/s")),
        Dimension("pressure", "Pa", "9330 Pa", ("Pa", "kPa", "MPa", "mmHg", "dyn/cm^2")),
        Dimension("density", "kg m-3", "1060 kg/m^3", ("kg/m^3", "g/cm^3")),
        Dimension("viscosity", "Pa s", "0.0035 Pa s", ("Pa s", "mPa s", "kg/m/s", "poise", "cP")),
        Dimension("flow rate", "m3 s-1", "0.6 cm^3/s", ("m^3/s", "cm^3/s", "ml/s", "ml/min", "l/min")),
        Dimension("resistance", "Pa s m-3", "1.358e9 Pa s/m^3", ("Pa s/m^3", "mmHg s/ml", "dyn s/cm^5")),
        Dimension("stiffness", "Pa m", "100 Pa m", ("Pa m", "N/m")),
        Dimension("angle", "rad", "135 deg", ("deg", "rad")),
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
    match = QUANTITY.fullmatch(text.strip()) if isinstance(text, str) and len(text) <= LONGEST_TEXT else None
    if match is None:
        raise QuantityError("not a number with a unit")
    number, unit = match.groups()
    if unit is None:
        raise QuantityError("no unit")
    return _product(number, _si_factor(unit, dimension))


def parse_ratio(text: object) -> float:
    """Convert a percentage such as "2 %", or a plain number, to a ratio.

    Raises
    ------
    QuantityError
        Anything else, or a value that is not finite.
    """
    if isinstance(text, bool) or not isinstance(text, str | int | float):
        raise QuantityError("not a percentage")
    match = re.fullmatch(rf"({NUMBER})\s*(%?)", str(text).strip())
    if match is None or len(str(text)) > LONGEST_TEXT:
        raise QuantityError("not a percentage")
    return _product(match[1], Decimal("0.01") if match[2] else Decimal(1))


def _product(number: str, factor: Decimal) -> float:
    try:
        value = float(Decimal(number) * factor)
    except decimal.DecimalException as error:
        raise QuantityError("out of range") from error
    if not math.isfinite(value):
        raise QuantityError("out of range")
    return value


@functools.cache
def _registry() -> "pint.UnitRegistry[Decimal]":
    import pint  # here, since it is slow to import and many need only the types of a case

    # decimal factors keep 0.6 MPa at exactly 600000 Pa
    return pint.UnitRegistry(non_int_type=Decimal)


@functools.cache
def _base_units(unit: str) -> tuple[Decimal, object]:
    """Return the SI factor of a unit and its base units; raises `pint.errors.PintError`."""
    registry = _registry()
    written = BARE_EXPONENT.sub(r"^\1", unit.translate(SUPERSCRIPTS))
    factor, base = registry.get_base_units(registry.parse_units(written))
    return Decimal(str(factor)), base


def _si_factor(unit: str, dimension: Dimension) -> Decimal:
    from pint.errors import PintError

    try:
        factor, base = _base_units(unit)
    except PintError as error:
        raise QuantityError(f"unknown unit {shown(unit)}{nearest(unit, dimension.common_units)}") from error
    # base units, not dimensionality: pint counts an angle as dimensionless, and 15 mm rad is no length
    if base != _base_units(dimension.unit)[1]:
        raise QuantityError(f"{unit} is no unit of {dimension.name}")
    return factor
