"""Figures over all cells and states: errors, and how far changes are apart, a line a quantity and variant."""

from collections.abc import Iterable

from cases.results.metric_row import MetricRow
from reports.blocks import Column, Table, numbers, prose
from reports.result.load import Comparison
from reports.sections.parts.places import row_place
from reports.wording.numbers import ABSENT, DIFFERENCE_UNITS, SPACE, percent, rounded, unsigned, with_unit
from reports.wording.words import baseline_words, quantity_words

_STATISTICS = ("bias", "scatter", "rms_error", "max_error")
_ABSOLUTE = "rms_difference"
NEAR_ZERO = 10.0  # share of 3D by which nothing is off where 3D is not next to zero


def table(comparison: Comparison) -> Table | None:
    """Return the table; None where nothing was pooled. Quantities with the same figures share a line."""
    found: dict[tuple[str, str], dict[str, MetricRow]] = {}
    for statistic in (*_STATISTICS, _ABSOLUTE):
        for row in comparison.metrics.pooled(statistic):
            found.setdefault((row.variant, row.quantity), {})[statistic] = row
    if not found:
        return None
    lines: dict[tuple[str, ...], list[tuple[str, str]]] = {}
    for variant in comparison.variants:
        for (name, quantity), by in found.items():
            if name == variant:
                largest = by.get("max_error")
                where = row_place(comparison, largest) if largest and not _round_off(largest) else ABSENT
                figures = _figures(by, _interval(comparison, variant, quantity))
                lines.setdefault((variant, *figures), []).append((quantity_words(quantity), where))
    rows = tuple(
        (variant, "; ".join(words for words, _ in same), *figures, same[0][1])
        for (variant, *figures), same in lines.items()
        if any(text != ABSENT for text in figures)
    )
    if not rows:
        return None
    return Table(
        "pooled",
        "Errors over all cells and all states of the cycle. A bias near the RMS error means that the 2D "
        "model is off by the same share everywhere; a scatter near it, that it is off differently from place "
        "to place. The 95 % interval of the bias comes from blocks of the cycle drawn anew (bootstrap): "
        "it tells how sure the bias is, not how large errors are. "
        "Quantities whose figures agree share a line." + _through_zero(found.values()),
        (
            Column("variant"),
            Column("quantity", "prose"),
            *numbers("bias", "its 95 %", "scatter", "RMS error", "RMS 2D − 3D", "largest error"),
            *prose("found at"),
        ),
        rows,
        rule_by=0,
    )


def _through_zero(rows: Iterable[dict[str, MetricRow]]) -> str:
    """Say what relative errors are worth where 3D passes zero; "" where none is that large."""
    largest = [row.error for by in rows if (row := by.get("max_error")) and row.error is not None]
    if all(abs(error) < NEAR_ZERO for error in largest):
        return ""
    return (
        " Where 3D passes zero a share of it has no bound, and says nothing of a quantity over the cycle: "
        "RMS 2D − 3D does."
    )


def _round_off(row: MetricRow) -> bool:
    """Whether a largest error is shown as zero, so that its place says nothing."""
    return row.error is not None and percent(row.error) == percent(0.0)


def _figures(by: dict[str, MetricRow], interval: str) -> tuple[str, ...]:
    """Bias and its interval, scatter, RMS and largest error as text."""
    texts = [percent(by[name].error if name in by else None) for name in _STATISTICS]
    return (
        texts[0],
        interval,
        unsigned(texts[1]),
        unsigned(texts[2]),
        _difference(by.get(_ABSOLUTE)),
        texts[3],
    )


def _difference(row: MetricRow | None) -> str:
    """RMS of 2D − 3D in the unit that differences are shown in."""
    if row is None or row.error is None:
        return ABSENT
    unit, factor = DIFFERENCE_UNITS.get(row.unit, (row.unit, 1.0))
    return with_unit(rounded(factor * row.error, 3), unit)


def _interval(comparison: Comparison, variant: str, quantity: str) -> str:
    """Confidence limits of a bias as text."""
    low, high = (comparison.metrics.find(variant, quantity, name) for name in ("bias_low", "bias_high"))
    if low is None or high is None or low.error is None or high.error is None:
        return ABSENT
    return f"{percent(low.error).removesuffix(f'{SPACE}%')} … {percent(high.error)}"


def change_apart(comparison: Comparison, changed: tuple[str, ...]) -> Table | None:
    """Return the table, a line for each quantity and changed variant; None where nothing was scored."""
    rows = []
    for variant in changed:
        for row in comparison.metrics.pooled("change_rms"):
            if row.variant != variant:
                continue
            unit, factor = DIFFERENCE_UNITS.get(row.unit, (row.unit, 1.0))
            sizes = (
                with_unit(rounded(None if size is None else size * factor, 3), unit)
                for size in (row.reference, row.rom)
            )
            rows.append((variant, quantity_words(row.quantity), *sizes, unsigned(percent(row.error, 0))))
    if not rows:
        return None
    return Table(
        "change-apart",
        "Change by calcification over all cells and states: its RMS size in each model, and the RMS distance "
        "of the two changes as a share of the 3D one. 0 % is the same change everywhere; 100 % is no better "
        f"than to expect none (variant minus {baseline_words(comparison)}).",
        (Column("variant"), Column("quantity", "prose"), *numbers("3D", "2D", "apart")),
        tuple(rows),
        rule_by=0,
    )
