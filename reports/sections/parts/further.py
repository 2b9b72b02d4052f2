"""Figures of the whole artery that no other table of the report has a place for."""

from cases.results.metric_row import MetricRow
from cases.statistics import PLACED
from reports.blocks import Column, Table, numbers, prose
from reports.result.load import Comparison
from reports.wording.numbers import ABSENT, percent, rounded, with_unit
from reports.wording.words import field_of, place, quantity_words, statistic_words

_BY_CELL_AND_STATE = ("plane_integral", "prescribed_inflow")
_WITH_TABLES = ("bias_low", "bias_high", "change_rms", "cost")  # statistics that have tables of their own


def table(comparison: Comparison, placed: frozenset[str]) -> Table | None:
    """Return the rows of other statistics, and the largest values of quantities that are not `placed`."""
    rows = tuple(
        _line(row)
        for row in comparison.metrics.rows
        if not row.status
        and row.statistic not in PLACED
        and row.statistic not in (*_BY_CELL_AND_STATE, *_WITH_TABLES)
        and (row.statistic != "largest" or row.quantity not in placed)
        and (row.i is None or row.statistic == "largest")
        and (row.reference is not None or row.error is not None)
    )
    if not rows:
        return None
    return Table(
        "further",
        "Further figures of the whole artery and cycle; metrics.csv holds all there are.",
        (Column("variant"), *prose("quantity", "statistic"), *numbers("3D", "2D", "error"), Column("at")),
        rows,
        rule_by=0,
    )


def _line(row: MetricRow) -> tuple[str, ...]:
    field = field_of(row.quantity, row.unit)
    shown = field if row.unit == field.unit else field_of("", row.unit)  # a ratio has no unit

    def value(number: float | None) -> str:
        text = rounded(None if number is None else number * shown.display_factor)
        return with_unit(text, shown.display_unit)

    texts = (quantity_words(row.quantity), statistic_words(row.statistic), value(row.reference))
    return (row.variant, *texts, value(row.rom), percent(row.error), place(row) or ABSENT)
