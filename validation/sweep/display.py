"""The units in which people read a study: those in which they stated it."""

import re
from dataclasses import dataclass

from cases.values.units import DIMENSION_OF_UNIT, NUMBER, parse_quantity


@dataclass(frozen=True)
class Display:
    """A unit for people: display value = SI value × factor."""

    unit: str
    factor: float


def display_of(stated: object, unit: str) -> Display:
    """Return the unit of a quantity as a study states it.

    Parameters
    ----------
    stated : object
        What was accepted as a number of ``unit``: a text with a unit, a percentage or a plain number.
    unit : str
        SI unit, as `cases.fields` writes it.
    """
    text = str(stated).strip()
    words = text[len(match[0]) :].strip() if (match := re.match(NUMBER, text)) else ""
    if unit == "1":
        return Display("%", 100.0) if words == "%" else Display("1", 1.0)
    return Display(words, 1.0 / parse_quantity(f"1 {words}", DIMENSION_OF_UNIT[unit]))
