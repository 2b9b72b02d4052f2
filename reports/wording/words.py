"""Words for quantities, statistics and cells in a report."""

from cases.fields import FIELDS, Field
from cases.results.metric_row import MetricRow
from cases.statistics import statistic_of
from reports.result.load import Comparison
from reports.wording.numbers import ABSENT, SPACE, fixed, listed, percent, unsigned, with_unit


def field_of(quantity: str, unit: str) -> Field:
    """Return the quantity's field; a quantity the table does not know is shown in its SI unit."""
    return FIELDS.get(quantity) or Field(
        quantity, quantity, quantity.replace("_", " "), unit, unit, 1.0, dims=()
    )


def quantity_words(quantity: str) -> str:
    """E.g. "flow rate through the section"."""
    return field_of(quantity, "1").label


def statistic_words(statistic: str) -> str:
    """E.g. "RMS error"."""
    return statistic_of(statistic).label


def measure(row: MetricRow, value: float | None, decimals: int = 2) -> str:
    """Write an error or a limit in the unit of its statistic: percent, or the quantity's display unit."""
    statistic = statistic_of(row.statistic)
    if statistic.relative:
        text = percent(value, decimals)
        return text if statistic.signed else unsigned(text)
    field = field_of(row.quantity, row.unit)
    return with_unit(
        fixed(None if value is None else value * field.display_factor, decimals), field.display_unit
    )


def limit(row: MetricRow) -> str:
    """Write a band's limit as it was declared: without trailing zeros."""
    if row.band is None:
        return ABSENT
    if statistic_of(row.statistic).relative:
        return f"{100 * row.band:.6g}{SPACE}%"
    field = field_of(row.quantity, row.unit)
    return with_unit(f"{row.band * field.display_factor:.6g}", field.display_unit)


def error_text(row: MetricRow) -> str:
    """Write a judged error with as many decimals as it takes to tell it from its limit."""
    for decimals in range(2, 7):
        text = measure(row, row.error, decimals)
        if text.lstrip("+−") != measure(row, row.band, decimals).lstrip("+"):
            break
    return text


def baseline_words(comparison: Comparison) -> str:
    """Name the variant that changes are counted from, or each of several with the variants it is for."""
    names = list(dict.fromkeys(comparison.baselines[name] for name in comparison.changed))
    if len(names) == 1:
        return names[0]
    return "; ".join(
        f"{base} (for {listed(name for name in comparison.changed if comparison.baselines[name] == base)})"
        for base in names
    )


def instant(name: str, t_s: float) -> str:
    """E.g. "systole (0.090 s)"; a name that is itself a time stays as it is."""
    value, _, unit = name.partition(" ")
    if unit == "s" and value.replace(".", "", 1).isdecimal():
        return f"{value}{SPACE}s"
    return f"{name} ({t_s:.3f}{SPACE}s)"
