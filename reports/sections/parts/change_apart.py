"""Distance of the changes by calcification in both models, over all cells and states."""

from reports.blocks import Column, Table, numbers
from reports.result.load import Comparison
from reports.wording.numbers import DIFFERENCE_UNITS, percent, rounded, unsigned, with_unit
from reports.wording.words import baseline_words, quantity_words


def table(comparison: Comparison, changed: tuple[str, ...]) -> Table | None:
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
