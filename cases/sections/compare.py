"""What a case compares with its reference: cells, times, and the bands that must hold."""

import math
from collections.abc import Callable
from typing import Annotated, Literal

from pydantic import ValidationInfo, field_validator

from cases.errors import QuantityError, RefusedValueError
from cases.fields import FIELDS
from cases.quantities import compared_quantities, statistics_of
from cases.sections.base import Section
from cases.statistics import JUDGED
from cases.values.kinds import (
    Context,
    Switch,
    ValueKind,
    Words,
    distinct,
    refused,
    registered,
    whole_number,
    words_of,
)
from cases.values.units import DIMENSION_OF_UNIT, DIMENSIONS, parse_quantity, parse_ratio
from cases.values.wording import choices, not_one_of

Event = Literal["systole", "first trough", "second trough", "end diastole"]

# a constant inlet has no largest and no least value
EVENTS_OF_A_CONSTANT: tuple[Event, ...] = ("end diastole",)

EVENTS = words_of(Event)

# cells of a grid with 120 sections and 48 rows at which results are tabulated
DEFAULT_N_X, DEFAULT_N_PHI = 120, 48
DEFAULT_SECTIONS, DEFAULT_ROWS = (1, 39, 61, 82, 120), (4, 15, 25)


def _instants(events: tuple[str, ...]) -> str:
    return f'{choices(events)}, or a time into the last cycle, e.g. "0.3 s"'


def _instant(value: object, _context: Context | None) -> str | float:
    allowed = _instants(EVENTS)
    if isinstance(value, str) and value in EVENTS:
        return value
    try:
        seconds = parse_quantity(value, DIMENSIONS["time"])
    except QuantityError as error:
        raise refused(value, allowed) from error
    if seconds < 0:
        raise refused(value, allowed)
    return seconds


def _variant(value: object, context: Context | None) -> str:
    known = () if context is None else context.variants
    if not isinstance(value, str) or (known and value not in known):
        raise RefusedValueError(not_one_of(value, known))
    return value


CellNumber = Annotated[int, whole_number("a whole number from 1 on", lambda value: value >= 1)]
Instant = Annotated[str | float, ValueKind(_instant, "an instant of the cycle", {"type": "string"})]
VariantName = Annotated[str, ValueKind(_variant, "the name of a variant", {"type": "string"})]
LIMIT = ValueKind(
    lambda value, _context: value,  # its unit follows from the quantity and the statistic: Band checks it
    "a percentage, or a quantity with its unit",
    {"type": ["string", "number"]},
)


class Cells(Section):
    """Cells whose results are tabulated, counted from 1.

    Attributes
    ----------
    i, j : tuple of int
        Sections along x and rows along φ. In a loaded case both lie on its grid.
    """

    i: tuple[CellNumber, ...] = DEFAULT_SECTIONS
    j: tuple[CellNumber, ...] = DEFAULT_ROWS

    _items = field_validator("i", "j")(distinct)

    def on_grid(self, n_x: int, n_phi: int) -> "Cells":
        """Return the cells for a grid: defaults move to the nearest cells, stated ones must exist.

        Raises
        ------
        RefusedValueError
            A stated cell lies outside the grid.
        """
        counts = {"i": n_x, "j": n_phi}
        for axis in sorted(self.model_fields_set):
            for item, cell in enumerate(getattr(self, axis)):
                if cell > counts[axis]:
                    name = {"i": "n_x", "j": "n_phi"}[axis]
                    raise refused(cell, f"1 to {counts[axis]} (solver.{name})", key=("cells", axis, item))
        return Cells(
            i=self.i if "i" in self.model_fields_set else nearest_sections(n_x),
            j=self.j if "j" in self.model_fields_set else nearest_rows(n_phi),
        )


def nearest_sections(n_x: int) -> tuple[int, ...]:
    """Return the default sections on a grid of `n_x`; the first and the last stay so."""
    scale = (n_x - 1) / (DEFAULT_N_X - 1)
    return tuple(sorted({1 + math.floor((i - 1) * scale + 0.5) for i in DEFAULT_SECTIONS}))


def nearest_rows(n_phi: int) -> tuple[int, ...]:
    """Return the rows on a grid of `n_phi` that hold the default angles."""
    return tuple(sorted({1 + math.floor((j - 0.5) * n_phi / DEFAULT_N_PHI) for j in DEFAULT_ROWS}))


class Band(Section):
    """A limit that an error must keep, and the reason for it.

    Attributes
    ----------
    quantity : str
        A name of `cases.fields.FIELDS` that is compared.
    statistic : str
        What is limited, of `cases.statistics.JUDGED`. `*_difference` statistics carry
        the quantity's unit, all others are relative.
    limit : float
        Greater than 0; a ratio, or in the quantity's SI unit.
    reason : str
        Why this limit.
    variants : tuple of str or None
        Variants that the band judges; all of them if None.
    """

    quantity: Annotated[str, registered(compared_quantities)]
    statistic: Annotated[str, registered(lambda: tuple(JUDGED))]
    limit: Annotated[float, LIMIT]
    reason: Words
    variants: tuple[VariantName, ...] | None = None

    @property
    def relative(self) -> bool:
        """Whether the limit is a ratio; otherwise it has the quantity's SI unit."""
        return JUDGED[self.statistic].relative

    @field_validator("statistic")
    @classmethod
    def _statistic(cls, name: str, info: ValidationInfo) -> str:
        quantity = info.data.get("quantity")
        if quantity is not None and name not in statistics_of(quantity):
            raise RefusedValueError(not_one_of(name, statistics_of(quantity)))
        return name

    @field_validator("limit")
    @classmethod
    def _limit(cls, stated: object, info: ValidationInfo) -> float:
        quantity, statistic = info.data.get("quantity"), info.data.get("statistic")
        if quantity is None or statistic is None:
            return math.nan  # what the limit means is unknown; the band is refused for that key already
        if JUDGED[statistic].relative:
            return _relative_limit(stated)
        return _absolute_limit(stated, FIELDS[quantity].unit)

    @field_validator("variants")
    @classmethod
    def _variants(cls, names: tuple[str, ...] | None) -> tuple[str, ...] | None:
        return names if names is None else distinct(names)


def _relative_limit(stated: object) -> float:
    """Return the limit of a relative statistic as a ratio."""
    allowed = 'a positive percentage, e.g. "2 %", or a ratio below 1'
    limit = _positive(stated, parse_ratio, allowed)
    if limit >= 1 and "%" not in str(stated):
        raise refused(stated, f'"{stated} %", or a ratio below 1', f"means {limit * 100:g} %")
    return limit


def _absolute_limit(stated: object, unit: str) -> float:
    """Return the limit of a difference, in a SI unit as `cases.fields` writes them ("1": a number)."""
    if unit == "1":
        return _positive(stated, parse_ratio, "a positive number")
    dimension = DIMENSION_OF_UNIT[unit]
    allowed = f"a positive {dimension.name} in units such as {choices(dimension.common_units)}"
    return _positive(stated, lambda text: parse_quantity(text, dimension), allowed)


def _positive(stated: object, parse: Callable[[object], float], allowed: str) -> float:
    try:
        limit = parse(stated)
    except QuantityError as error:
        raise refused(stated, allowed, str(error)) from error
    if limit <= 0:
        raise refused(stated, allowed)
    return limit


class Compare(Section):
    """Where and when results are tabulated, and the bands that judge them.

    Attributes
    ----------
    cells : Cells
        Cells of the tables.
    times : tuple of str or float
        Instants of the last cycle: names of events, or seconds from the cycle's start. In a loaded case with
        a constant inlet the only event is end diastole.
    bands : tuple of Band
        The declared bands; may be empty.
    matched_inflow : bool
        Whether the reduced model also runs with the flow rate that the 3D reference takes in, so that what
        both owe to their inlets is told apart.
    """

    cells: Cells = Cells()
    times: tuple[Instant, ...] = ("systole", "second trough", "end diastole")
    bands: tuple[Band, ...] = ()
    matched_inflow: Switch = False

    _times = field_validator("times")(distinct)

    def in_cycle(self, period: float, constant: bool) -> tuple[str | float, ...]:
        """Return the times for an inlet: stated ones must lie in its cycle.

        Parameters
        ----------
        period : float
            The inlet's period in s.
        constant : bool
            Whether the inlet is constant.

        Raises
        ------
        RefusedValueError
            A stated time lies beyond the period, or names an event of a pulse where the inlet is constant.
        """
        if constant and "times" not in self.model_fields_set:
            return EVENTS_OF_A_CONSTANT
        for item, time in enumerate(self.times):
            if isinstance(time, float) and time > period:
                allowed = f"at most the period of the inlet ({period:g} s)"
                raise refused(f"{time:g} s", allowed, key=("times", item))
            if constant and isinstance(time, str) and time not in EVENTS_OF_A_CONSTANT:
                reason = "a constant inlet has none"
                raise refused(time, _instants(EVENTS_OF_A_CONSTANT), reason, key=("times", item))
        return self.times
