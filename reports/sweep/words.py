"""How parameters, outputs and their values are written on the page of a sweep."""

import re

from reports.numbers import ABSENT, SPACE, rounded, with_unit
from reports.sweep.study_file import Output, Parameter

_LEAST, _MOST = 1e-4, 1e6  # sizes that are written without a power of ten
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")

DESIGNS = {
    "grid": "every combination of the values",
    "list": "the values of all parameters side by side",
    "latin_hypercube": "Latin hypercube",
    "sobol": "Sobol sequence",
    "saltelli": "Saltelli's design for Sobol indices",
}


def amount(item: Parameter | Output, value: float | None, significant: int = 3) -> str:
    """Write an SI value with the unit that people read it in."""
    if value is None:
        return ABSENT
    shown, unit = value * item.display_factor, unit_words(item)
    if shown and not _LEAST <= abs(shown) < _MOST:
        digits, _, power = f"{shown:.{significant - 1}e}".partition("e")
        return with_unit(f"{digits.replace('-', '−')}{SPACE}·{SPACE}10{_raised(int(power))}", unit)
    return with_unit(rounded(shown, significant), unit)


def unit_words(item: Parameter | Output) -> str:
    """Return the unit with raised exponents; "" for a plain number."""
    plain = "" if item.unit == "1" else item.unit
    return re.sub(r"\^(-?\d+)", lambda found: _raised(int(found[1])), plain)


def _raised(power: int) -> str:
    return str(power).translate(_RAISED)


def axis_label(item: Parameter | Output) -> str:
    """E.g. "wall thickness (mm)"."""
    return f"{item.label} ({unit_words(item) or '–'})"
