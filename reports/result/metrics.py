"""The rows of metrics.json, found again by what they are about."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from pydantic import TypeAdapter

from cases.results.metric_row import Inflow, MetricRow, Model, judged
from reports.errors import ReportError
from reports.result.strict_json import read_json


@dataclass(frozen=True)
class Metrics:
    """All rows, and those without a band by (variant, quantity, statistic, i, j, t, inflow)."""

    rows: tuple[MetricRow, ...]
    index: dict[tuple[object, ...], MetricRow]

    def of(self, model: str) -> "Metrics":
        """Return the rows of one reduced model."""
        return of_rows(tuple(row for row in self.rows if row.model == model))

    def bands(self) -> tuple[MetricRow, ...]:
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
        inflow: Inflow = "",
    ) -> MetricRow | None:
        """Return the one row about this, or None where the comparison has none."""
        return self.index.get((variant, quantity, statistic, i, j, _instant(t_s), inflow))

    def largest_row(self, variant: str, quantity: str, model: Model) -> MetricRow | None:
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

    def pooled(self, statistic: str) -> Iterator[MetricRow]:
        """Rows of a statistic over all cells and states (a maximum names where it was found)."""
        for row in self.rows:
            whole = row.t_s is not None if statistic.startswith("max_") else row.i is None
            if row.statistic == statistic and whole and not row.status and not row.inflow:
                yield row


_ROWS = TypeAdapter(tuple[MetricRow, ...])


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
        verdict = judged(row.error, row.band)
        if row.status != verdict:
            raise ReportError(
                f"{path}: row {number} ({row.variant}, {row.quantity}, {row.statistic}): status is "
                f"{row.status!r}, but an error of {row.error} with a band of {row.band} gives {verdict!r}"
            )
    return of_rows(rows)


def of_rows(rows: tuple[MetricRow, ...]) -> Metrics:
    """Return rows of one reduced model, or of several before one is chosen, with their index."""
    index: dict[tuple[object, ...], MetricRow] = {
        (r.variant, r.quantity, r.statistic, r.i, r.j, _instant(r.t_s), r.inflow): r
        for r in rows
        if not r.status
    }
    return Metrics(rows, index)


def _instant(t_s: float | None) -> float | None:
    """Time to a microsecond, so that a time that went through text still finds its row."""
    return None if t_s is None else round(t_s, 6)
