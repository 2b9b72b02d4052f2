"""The rows of metrics.json, found again by what they are about."""

import math
from collections.abc import Iterator
from dataclasses import dataclass as plain_dataclass
from pathlib import Path
from typing import Annotated, Literal

from pydantic import ConfigDict, Field, FiniteFloat, TypeAdapter
from pydantic.dataclasses import dataclass

from reports.errors import ReportError
from reports.result.strict_json import read_json

DIFFERENCE_STATISTICS = ("rms_difference", "max_difference")

Status = Literal["", "OK", "FAIL", "MISSING"]
Model = Literal["reference", "rom"]
Number = Annotated[int, Field(ge=1)]
Limit = Annotated[float, Field(ge=0, allow_inf_nan=False)]


@dataclass(frozen=True, config=ConfigDict(strict=True))
class Row:
    """One figure of the comparison; numbers are SI, errors relative unless the statistic is a difference."""

    case: str
    variant: str
    quantity: str
    statistic: str
    i: Number | None
    j: Number | None
    t_s: FiniteFloat | None
    rom: FiniteFloat | None
    reference: FiniteFloat | None
    error: FiniteFloat | None
    unit: str
    band: Limit | None
    status: Status

    @property
    def ratio(self) -> float:
        """|error| over its band's limit; infinite for a limit of zero, NaN without an error."""
        if self.error is None or self.band is None:
            return math.nan
        return abs(self.error) / self.band if self.band else math.inf


@plain_dataclass(frozen=True)
class Metrics:
    """All rows, and those without a band by (variant, quantity, statistic, i, j, t)."""

    rows: tuple[Row, ...]
    index: dict[tuple[object, ...], Row]

    def bands(self) -> tuple[Row, ...]:
        """Rows that judge a declared band."""
        return tuple(row for row in self.rows if row.status)

    def find(
        self,
        variant: str,
        quantity: str,
        statistic: str,
        i: int | None = None,
        j: int | None = None,
        t_s: float | None = None,
    ) -> Row | None:
        """Return the one row about this, or None where the comparison has none."""
        return self.index.get((variant, quantity, statistic, i, j, _instant(t_s)))

    def largest_row(self, variant: str, quantity: str, model: Model) -> Row | None:
        """Return the row of a model's largest value, which may name the cell where it was found."""
        for row in self.rows:
            about = (row.variant, row.quantity, row.statistic) == (variant, quantity, "largest")
            if about and getattr(row, model) is not None:
                return row
        return None

    def largest(self, variant: str, quantity: str, statistic: str) -> float | None:
        """Return the largest |error| of all rows of a statistic, or None where none has an error."""
        errors = [
            abs(row.error)
            for row in self.rows
            if (row.variant, row.quantity, row.statistic) == (variant, quantity, statistic)
            and row.error is not None
        ]
        return max(errors, default=None)

    def pooled(self, statistic: str) -> Iterator[Row]:
        """Rows of a statistic over all cells and states (a maximum names where it was found)."""
        for row in self.rows:
            whole = row.t_s is not None if statistic.startswith("max_") else row.i is None
            if row.statistic == statistic and whole and not row.status:
                yield row


_ROWS = TypeAdapter(tuple[Row, ...])


def read_metrics(path: Path) -> Metrics:
    """Read metrics.json.

    Raises
    ------
    ReportError
        If it is no list of rows with the declared columns and types, has no row, or a row's status is not
        what follows from its error and band.
    """
    rows = read_json(path, _ROWS)
    if not rows:
        raise ReportError(f"{path}: without any row; a finished comparison has some")
    for number, row in enumerate(rows, start=1):
        if row.status != judged(row):
            raise ReportError(
                f"{path}: row {number} ({row.variant}, {row.quantity}, {row.statistic}): status is "
                f"{row.status!r}, but an error of {row.error} with a band of {row.band} gives {judged(row)!r}"
            )
    index: dict[tuple[object, ...], Row] = {
        (r.variant, r.quantity, r.statistic, r.i, r.j, _instant(r.t_s)): r for r in rows if not r.status
    }
    return Metrics(rows, index)


def judged(row: Row) -> Status:
    """Judge a row by its own numbers: "" where no band is declared."""
    if row.band is None:
        return ""
    if row.error is None:
        return "MISSING"
    return "OK" if abs(row.error) <= row.band else "FAIL"


def _instant(t_s: float | None) -> float | None:
    """Time to a microsecond, so that a time that went through text still finds its row."""
    return None if t_s is None else round(t_s, 6)
