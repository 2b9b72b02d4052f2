"""The rows of metrics.json, found again by what they are about."""

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from reports.errors import ReportError

STATUSES = ("OK", "FAIL", "MISSING")
DIFFERENCE_STATISTICS = ("rms_difference", "max_difference")
_TEXTS = ("case", "variant", "quantity", "statistic", "unit", "status")
_NUMBERS = ("i", "j", "t_s", "rom", "reference", "error", "band")


@dataclass(frozen=True)
class Row:
    """One figure of the comparison; numbers are SI, errors relative unless the statistic is a difference."""

    case: str
    variant: str
    quantity: str
    statistic: str
    i: int | None
    j: int | None
    t_s: float | None
    rom: float | None
    reference: float | None
    error: float | None
    unit: str
    band: float | None
    status: str

    @property
    def ratio(self) -> float:
        """|error| over its band's limit; infinite for a limit of zero, NaN without an error."""
        if self.error is None or self.band is None:
            return math.nan
        return abs(self.error) / self.band if self.band else math.inf


@dataclass(frozen=True)
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

    def pooled(self, statistic: str) -> Iterator[Row]:
        """Rows of a statistic over all cells and states (a maximum names where it was found)."""
        for row in self.rows:
            whole = row.t_s is not None if statistic.startswith("max_") else row.i is None
            if row.statistic == statistic and whole and not row.status:
                yield row


def read_metrics(path: Path) -> Metrics:
    """Read metrics.json.

    Raises
    ------
    ReportError
        If it is no list of rows with the declared columns, types and statuses.
    """
    try:
        records = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise ReportError(f"{path}: cannot be read as JSON: {error}") from error
    if not isinstance(records, list):
        raise ReportError(f"{path}: a list of rows is expected, found {type(records).__name__}")
    rows = tuple(_row(path, number, record) for number, record in enumerate(records, start=1))
    index: dict[tuple[object, ...], Row] = {
        (r.variant, r.quantity, r.statistic, r.i, r.j, _instant(r.t_s)): r for r in rows if not r.status
    }
    return Metrics(rows, index)


def _instant(t_s: float | None) -> int | None:
    """Time in whole microseconds, so that a time that went through text still finds its row."""
    return None if t_s is None else round(t_s * 1e6)


def _row(path: Path, number: int, record: object) -> Row:
    where = f"{path}: row {number}"
    if not isinstance(record, dict):
        raise ReportError(f"{where}: an object is expected, found {type(record).__name__}")
    missing = [name for name in (*_TEXTS, *_NUMBERS) if name not in record]
    if missing:
        raise ReportError(f"{where}: without {', '.join(missing)}")
    texts = {name: _text(where, name, record[name]) for name in _TEXTS}
    numbers = {name: _number(where, name, record[name]) for name in _NUMBERS}
    if texts["status"] not in ("", *STATUSES):
        raise ReportError(f"{where}: status {texts['status']!r}; allowed are {', '.join(STATUSES)} or none")
    i, j = (None if numbers[name] is None else int(numbers[name] or 0) for name in ("i", "j"))
    return Row(
        case=texts["case"],
        variant=texts["variant"],
        quantity=texts["quantity"],
        statistic=texts["statistic"],
        i=i,
        j=j,
        t_s=numbers["t_s"],
        rom=numbers["rom"],
        reference=numbers["reference"],
        error=numbers["error"],
        unit=texts["unit"],
        band=numbers["band"],
        status=texts["status"],
    )


def _text(where: str, name: str, value: object) -> str:
    if value is None:
        return ""
    if not isinstance(value, str):
        raise ReportError(f"{where}: {name} is {value!r}; text is expected")
    return value


def _number(where: str, name: str, value: object) -> float | None:
    if value is None or value == "":
        return None
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ReportError(f"{where}: {name} is {value!r}; a number is expected")
    return None if math.isnan(value) else float(value)
