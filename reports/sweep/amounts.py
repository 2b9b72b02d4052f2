"""Words for parameters, outputs and their values on the page of a sweep."""

import math
import re

from cases.results.sweep import KeptOutput, VariedParameter
from reports.wording.numbers import ABSENT, SPACE, rounded, with_unit

_LEAST, _MOST = 1e-4, 1e6  # sizes that are written without a power of ten
_LEAST_SPREAD = 1e-4  # of a value, that is worth digits
_ERRORS = ("_error", "_bias", "_scatter", "_rms_difference", "_max_difference")
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")

DESIGNS = {
    "grid": "every combination of the values",
    "list": "the values of all parameters side by side",
    "latin_hypercube": "Latin hypercube",
    "sobol": "Sobol sequence",
    "saltelli": "Saltelli's design for Sobol indices",
}


def amount(item: VariedParameter | KeptOutput, value: float | None, significant: int = 3) -> str:
    """Write an SI value with the unit that people read it in."""
    if value is None:
        return ABSENT
    shown, unit = value * item.display_factor, unit_words(item)
    if shown and not _LEAST <= abs(shown) < _MOST:
        digits, _, power = f"{shown:.{significant - 1}e}".partition("e")
        return with_unit(f"{digits.replace('-', '−')}{SPACE}·{SPACE}10{_raised(int(power))}", unit)
    return with_unit(rounded(shown, significant), unit)


def steady(low: float, high: float) -> bool:
    """Whether values differ too little to matter beside their size."""
    return high - low < _LEAST_SPREAD * max(abs(low), abs(high)) or high == low


def ends(item: VariedParameter | KeptOutput, low: float, high: float) -> str:
    """E.g. "12.04 kPa … 12.09 kPa", with as many digits as tell the ends apart; one value of steady ones."""
    if high == low:
        return f"{amount(item, low)} (does not vary)"
    if steady(low, high):
        return f"{amount(item, low)} (varies by less than {100 * _LEAST_SPREAD:g}{SPACE}%)"
    size = max(abs(low), abs(high)) / (high - low)
    significant = max(3, math.ceil(math.log10(size)) + 1)
    return f"{amount(item, low, significant)} … {amount(item, high, significant)}"


def is_error(output: KeptOutput) -> bool:
    """Whether an output tells how far a sample is from what judges it."""
    return output.name.endswith(_ERRORS)


def unit_words(item: VariedParameter | KeptOutput) -> str:
    """Return the unit with raised exponents; "" for a plain number."""
    plain = "" if item.unit == "1" else item.unit
    return re.sub(r"\^(-?\d+)", lambda found: _raised(int(found[1])), plain)


def _raised(power: int) -> str:
    return str(power).translate(_RAISED)


def axis_label(item: VariedParameter | KeptOutput) -> str:
    """E.g. "wall thickness (mm)"."""
    return f"{item.label} ({unit_words(item) or '–'})"
