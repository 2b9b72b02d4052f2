"""The errors over all cells and states, a line for each quantity and variant."""

from reports.blocks import Column, Table
from reports.load import Comparison
from reports.metrics import Row
from reports.numbers import ABSENT, percent, unsigned
from reports.words import place, quantity_words

_STATISTICS = ("bias", "scatter", "rms_error", "max_error")


def table(comparison: Comparison) -> Table | None:
    """Return the table; None where nothing was pooled. Quantities with the same figures share a line."""
    found: dict[tuple[str, str], dict[str, Row]] = {}
    for statistic in _STATISTICS:
        for row in comparison.metrics.pooled(statistic):
            found.setdefault((row.variant, row.quantity), {})[statistic] = row
    if not found:
        return None
    lines: dict[tuple[str, ...], list[tuple[str, str]]] = {}
    for variant in comparison.variants:
        for (name, quantity), by in found.items():
            if name == variant:
                largest = by.get("max_error")
                where = place(largest) if largest else ABSENT
                lines.setdefault((variant, *_figures(by)), []).append((quantity_words(quantity), where))
    rows = tuple(
        (variant, "; ".join(words for words, _ in same), *figures, same[0][1])
        for (variant, *figures), same in lines.items()
    )
    return Table(
        "pooled",
        "Errors over all cells and all states of the cycle. A bias near the RMS error means that the 2D "
        "model is off by the same share everywhere; a scatter near it, that it is off differently from place "
        "to place. Quantities whose figures agree share a line.",
        (
            Column("variant"),
            Column("quantity", "prose"),
            Column("bias", "number"),
            Column("scatter", "number"),
            Column("RMS error", "number"),
            Column("largest error", "number"),
            Column("found at"),
        ),
        rows,
        rule_by=0,
    )


def _figures(by: dict[str, Row]) -> tuple[str, ...]:
    """Bias, scatter, RMS and largest error as text."""
    texts = [percent(by[name].error if name in by else None) for name in _STATISTICS]
    return texts[0], unsigned(texts[1]), unsigned(texts[2]), texts[3]
