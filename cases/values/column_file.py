"""CSV files of two columns whose header names quantities with their units, read into SI numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

from cases.errors import ColumnFileError, QuantityError, UnreadableFileError
from cases.values.common_units import UNITS
from cases.values.input_files import read_file
from cases.values.ranges import CYCLE_TIMES, FLOW_RATES, PRESSURES, SIZES, VELOCITIES, Range
from cases.values.units import parse_number
from cases.values.wording import but_allowed, choices, nearest, shown

if TYPE_CHECKING:
    from cases.arrays import Floats

LARGEST_FILE = 10_000_000
SEPARATORS = {"\t": "tabs", ";": "semicolons", "|": "bars", " ": "blanks"}
MMHG, _ = UNITS["mmHg"]


@dataclass(frozen=True)
class Column:
    """A quantity that a column may hold.

    Attributes
    ----------
    quantity : str
        Words for messages.
    unit : str
        SI unit for messages.
    within : Range
        Between what limits its values lie.
    factors : dict of str to Decimal
        Header name → factor to SI; decimal, so that 8.41199 cm/s is the float closest to 0.0841199.
    """

    quantity: str
    unit: str
    within: Range
    factors: dict[str, Decimal]


TIME = Column("a time", "s", CYCLE_TIMES, {"t_s": Decimal(1), "t_ms": Decimal("1e-3")})
RADIUS = Column("a radius", "m", SIZES, {"radius_mm": Decimal("1e-3"), "radius_m": Decimal(1)})
VELOCITY = Column(
    "a mean velocity",
    "m/s",
    VELOCITIES,
    {"mean_velocity_m_s": Decimal(1), "mean_velocity_cm_s": Decimal("0.01")},
)
FLOW_RATE = Column(
    "a flow rate",
    "m^3/s",
    FLOW_RATES,
    {
        "flow_rate_m3_s": Decimal(1),
        "flow_rate_cm3_s": Decimal("1e-6"),
        "flow_rate_mL_s": Decimal("1e-6"),
        "flow_rate_mL_min": Decimal("1e-6") / 60,
    },
)
PRESSURE = Column(
    "a pressure",
    "Pa",
    PRESSURES,
    {"pressure_Pa": Decimal(1), "pressure_kPa": Decimal(1000), "pressure_mmHg": MMHG},
)
COLUMNS = (TIME, RADIUS, VELOCITY, FLOW_RATE, PRESSURE)


@dataclass(frozen=True)
class Samples:
    """The rows of a file.

    Attributes
    ----------
    rows : tuple of (float, float), length n
        The two columns in SI units.
    lines : tuple of int, length n
        Line of each row, counted from 1.
    """

    rows: tuple[tuple[float, float], ...]
    lines: tuple[int, ...]

    def require_increasing(self, column: int, word: str, plural: str) -> None:
        """Refuse a column, 0 or 1, whose values do not increase strictly from row to row.

        Raises
        ------
        ColumnFileError
            With the line of the first value that does not; the message lacks the file's name.
        """
        for line, (before, after) in zip(self.lines[1:], pairwise(self.rows), strict=True):
            if after[column] <= before[column]:
                message = f"{word} does not increase; allowed: strictly increasing {plural}"
                raise ColumnFileError(f", line {line}: {message}")


def read_samples(path: Path, first: Column, second: Column, fewest_rows: int) -> Samples:
    """Read a file with two columns; lines that start with # are comments.

    Parameters
    ----------
    path : pathlib.Path
        The file.
    first, second : Column
        What its columns must hold, in this order.
    fewest_rows : int
        How many rows it must have.

    Returns
    -------
    Samples
        SI values.

    Raises
    ------
    ColumnFileError
        The file cannot be read, or lacks such columns of numbers. Messages start behind the file's name, with
        ", line …: " or ": ".
    """
    try:
        lines = read_file(path, LARGEST_FILE).decode("utf-8-sig").splitlines()
    except UnreadableFileError as error:
        raise ColumnFileError(f": {error}") from error
    except UnicodeDecodeError as error:
        raise ColumnFileError(": not UTF-8 text") from error
    numbered = [
        (number, [cell.strip() for cell in line.split(",")])
        for number, line in enumerate(lines, start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not numbered:
        raise ColumnFileError(": empty; allowed: a header and rows of numbers")
    (header_line, header), *rows = numbered
    _check_header(header_line, header, first, second)
    if len(rows) < fewest_rows:
        raise ColumnFileError(f": {len(rows)} rows; allowed: {fewest_rows} or more")
    values = tuple(_row(line, cells, header, (first, second)) for line, cells in rows)
    return Samples(values, tuple(line for line, _ in rows))


def array_of(rows: Sequence[tuple[float, float]], column: int) -> Floats:
    """Return a column of rows, 0 or 1, as a read-only array (n,)."""
    import numpy as np  # here: who only checks a file need not wait for it

    values = np.array([row[column] for row in rows])
    values.setflags(write=False)
    return values


def _check_header(line: int, names: list[str], first: Column, second: Column) -> None:
    """Refuse a header that does not name the two columns."""
    known = [*first.factors, *second.factors]
    for separator, word in SEPARATORS.items():
        parts = [part.strip() for name in names for part in name.split(separator)]
        if len(parts) > len(names) and parts[0] in known:
            raise ColumnFileError(
                f", line {line}: {word} separate columns; allowed: commas, and decimal points"
            )
    for name in names:
        if name not in known:
            raise ColumnFileError(f", line {line}: {but_allowed(_unknown(name, known), choices(known))}")
    if len(names) != 2 or names[0] not in first.factors or names[1] not in second.factors:
        allowed = f"{choices(first.factors)}, then {choices(second.factors)}"
        raise ColumnFileError(f", line {line}: columns {', '.join(names)}; allowed: {allowed}")


def _unknown(name: str, known: list[str]) -> str:
    """Say what a column is that the file may not have."""
    for column in COLUMNS:
        if name in column.factors:
            return f"column {name} is {column.quantity}"
    return f"unknown column {shown(name)}{nearest(name, known)}"


def _row(
    line: int, cells: list[str], names: list[str], columns: tuple[Column, Column]
) -> tuple[float, float]:
    """Return the two values of one row, in SI units."""
    if len(cells) != len(names):
        decimals = ": are there decimal commas?" if len(cells) == 2 * len(names) else ""
        raise ColumnFileError(f", line {line}: {len(cells)} columns; allowed: {len(names)}{decimals}")
    values = []
    for name, cell, column in zip(names, cells, columns, strict=True):
        found = f", line {line}: {name}: {shown(cell)}"
        try:
            value = parse_number(cell, column.factors[name])
        except QuantityError as error:
            raise ColumnFileError(f"{found}; allowed: a finite number") from error
        if value not in column.within:
            raise ColumnFileError(f"{found}; allowed: {column.within}")
        values.append(value)
    return values[0], values[1]
