"""All rows of metrics.json as JSON values, for the page's table of every figure."""

from typing import Any

from cases.results.metric_row import MetricRow
from cases.statistics import statistic_of
from reports.result.metrics import Metrics
from reports.wording.words import field_of, quantity_words, statistic_words

_NUMBERS = ("i", "j", "t_s", "reference", "rom", "error", "band")


def columns(metrics: Metrics) -> dict[str, Any]:
    """Return all rows by columns; words that occur often stand once."""
    return {
        "variant": _coded([row.variant for row in metrics.rows]),
        "quantity": _coded([quantity_words(row.quantity) for row in metrics.rows]),
        "statistic": _coded([statistic_words(row.statistic) for row in metrics.rows]),
        "status": _coded([row.status for row in metrics.rows]),
        "unit": _coded([_display(row)[0] for row in metrics.rows]),
        "relative": [statistic_of(row.statistic).relative for row in metrics.rows],
        **{name: [_number(row, name) for row in metrics.rows] for name in _NUMBERS},
    }


def _display(row: MetricRow) -> tuple[str, float]:
    """Return the unit that people read a row's values in, and display over stored value."""
    field = field_of(row.quantity, row.unit)
    return (field.display_unit, field.display_factor) if row.unit == field.unit else (row.unit, 1.0)


def _number(row: MetricRow, name: str) -> float | None:
    value = getattr(row, name)
    relative = name in ("error", "band") and statistic_of(row.statistic).relative
    if name in ("reference", "rom", "error", "band") and value is not None and not relative:
        value *= _display(row)[1]
    return float(f"{value:.6g}") if isinstance(value, float) else value


def _coded(words: list[str]) -> dict[str, list[Any]]:
    names = list(dict.fromkeys(words))
    number = {name: k for k, name in enumerate(names)}
    return {"names": names, "rows": [number[word] for word in words]}
