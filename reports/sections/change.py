"""Section on what calcification changes, in 3D and in 2D."""

import math
from dataclasses import dataclass

import numpy as np

from cases.fields import FIELDS, Field
from cases.results.metric_row import MetricRow
from reports.blocks import Block, Column, Paragraph, Subsection, Table
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared, of_each_model
from reports.sections.parts import pooled
from reports.sections.parts.cells import cell_tables
from reports.sections.parts.places import row_place
from reports.wording.numbers import (
    DIFFERENCE_UNITS,
    SPACE,
    decimals_for,
    fixed,
    listed,
    percent,
    plus,
    with_unit,
)
from reports.wording.words import baseline_words, field_of, instant

_CELL_QUANTITIES = ("pressure", "radius", "sector_flow_rate")
_NOTICEABLE = 1e-3  # changes below this share of the baseline's own value are not read as a change


def _cycle_fields(comparison: Comparison) -> list[Field]:
    """Quantities of the whole cycle: those of the table of fields in its order, then others."""
    rows = [row for row in comparison.metrics.rows if row.statistic == "cycle" and not row.status]
    present = {row.quantity: field_of(row.quantity, row.unit) for row in rows}
    known = [field for field in FIELDS.values() if field.name in present]
    return known + [field for name, field in present.items() if name not in FIELDS]


@dataclass(frozen=True)
class _CycleLine:
    """One quantity of the whole cycle in one variant: its value and what became of the baseline's."""

    value: MetricRow
    change: MetricRow | None
    ratio: MetricRow | None


def _cycle_lines(comparison: Comparison, field: Field) -> list[_CycleLine]:
    find = comparison.metrics.find
    return [
        _CycleLine(value, find(variant, field.name, "change"), find(variant, field.name, "ratio"))
        for variant in comparison.variants
        if (value := find(variant, field.name, "cycle"))
        and not (comparison.sparse and value.reference is None)
    ]


def _cycle_table(comparison: Comparison) -> Table | None:
    rows = [
        row
        for field in _cycle_fields(comparison)
        for row in _cycle_rows(field, _cycle_lines(comparison, field), comparison)
    ]
    if not rows:
        return None
    columns = [
        Column("quantity", "prose"),
        Column("variant"),
        Column("unit"),
        Column("3D", "number", "value"),
        Column("2D", "number", "value"),
        Column("error", "number", "value"),
    ]
    caption = "Quantities of the whole cycle in both models"
    if comparison.changed:
        columns += [
            Column("3D", "number", "change"),
            Column("2D", "number", "change"),
            Column("3D", "number", "ratio"),
            Column("2D", "number", "ratio"),
        ]
        caption += (
            f", and how calcification changes them: minus and over the value of variant "
            f"{baseline_words(comparison)}. The 2D model gets calcification right where its change, not only "
            "its value, is that of 3D"
        )
    if any(field.unit == "s" for field in _cycle_fields(comparison)):
        interval = with_unit(fixed(1e3 * _between_states(comparison), 0), "ms")
        caption += f". States are {interval} apart, so a lag is known no better than to the digits shown"
    return Table("cycle-quantities", f"{caption}.", tuple(columns), tuple(rows), rule_by=0)


def _both(row: MetricRow | None, factor: float = 1.0) -> tuple[float | None, float | None]:
    """3D and 2D of a row, in display units."""
    if row is None:
        return None, None
    three, two = row.reference, row.rom
    return None if three is None else factor * three, None if two is None else factor * two


def _cycle_rows(field: Field, lines: list[_CycleLine], comparison: Comparison) -> list[tuple[str, ...]]:
    """Rows of one quantity: values to four digits, changes with common decimals, times as states allow."""
    values = [_both(line.value, field.display_factor) for line in lines]
    changes = [_both(line.change, field.display_factor) for line in lines]
    ratios = [_both(line.ratio) for line in lines]
    if not lines:
        return []
    decimals = [decimals_for(pair, 4) for pair in values]
    if field.unit == "s":
        decimals = [_time_decimals(comparison)] * len(lines)
    finer = decimals_for([n for pair in changes for n in pair], 3, most=max(decimals) + 1)
    rows = []
    for line, value, places, change, ratio in zip(lines, values, decimals, changes, ratios, strict=True):
        texts = [
            field.label,
            line.value.variant,
            field.display_unit,
            *(fixed(n, places) for n in value),
            percent(line.value.error),
        ]
        if comparison.changed:
            texts += [plus(fixed(n, finer)) for n in change]
            texts += [fixed(n, decimals_for([n], 4, most=3)) for n in ratio]
        rows.append(tuple(texts))
    return rows


def _between_states(comparison: Comparison) -> float:
    """Time between two states (s)."""
    time = comparison.fields["time"].values
    return float(np.median(np.diff(time))) if time.size > 1 else 0.0


def _time_decimals(comparison: Comparison) -> int:
    """Decimals of a time in ms, to about a twentieth of the time between two states."""
    step = 1e3 * _between_states(comparison) / 20
    return max(0, -round(math.log10(step))) if step > 0 else 0


def _largest(comparison: Comparison, variant: str, quantity: str) -> str:
    """Name where a quantity of 3D changes most at the shown cells and instants, with the 2D change there."""
    rows = [
        row
        for i in comparison.i
        for j in comparison.rows_of(variant)
        for _, t in comparison.times
        if (row := comparison.metrics.find(variant, quantity, "change", i, j, t))
        and row.reference is not None
    ]
    if not rows:
        return ""
    row = max(rows, key=lambda r: abs(r.reference or 0.0))
    field = FIELDS[quantity]
    unit, factor = DIFFERENCE_UNITS[field.unit]
    decimals = decimals_for(_both(row, factor), 3, most=3)
    three, two = (with_unit(plus(fixed(n, decimals)), unit) for n in _both(row, factor))
    return f"{field.label} {three} in 3D and {two} in 2D (at {row_place(comparison, row)})"


def _noticeable(change: float, value: float) -> bool:
    """Whether a change is more than 0.1 % of what it changed."""
    return abs(change) > _NOTICEABLE * abs(value - change)


def _signs(comparison: Comparison, variant: str) -> str:
    """Say for how many cycle quantities that change in 3D the 2D model changes the same way."""
    wrong, changed, stated = [], 0, 0
    for field in _cycle_fields(comparison):
        change = comparison.metrics.find(variant, field.name, "change")
        value = comparison.metrics.find(variant, field.name, "cycle")
        if change is None or value is None:
            continue
        if change.reference is None or change.rom is None or value.reference is None or value.rom is None:
            continue
        stated += 1
        if _noticeable(change.reference, value.reference):
            changed += 1
            followed = _noticeable(change.rom, value.rom) and change.reference * change.rom > 0
            wrong += [] if followed else [field.label]
    if not stated:
        return ""
    if not changed:
        return "No cycle quantity changes by more than 0.1 % in 3D."
    if not wrong:
        return f"All {changed} cycle quantities that change by over 0.1 % in 3D do so the same way in 2D."
    return (
        f"Of {changed} cycle quantities that change by more than 0.1 % in 3D, the 2D model changes "
        f"{len(wrong)} the other way or by less than 0.1 %: {listed(wrong)}."
    ).replace(" %", SPACE + "%")


def _sentence(comparison: Comparison, variant: str) -> str:
    largest = [text for name in _CELL_QUANTITIES if (text := _largest(comparison, variant, name))]
    opening = f"Variant {variant} against {comparison.baselines[variant]}: "
    signs = _signs(comparison, variant)
    if not largest:
        return opening + (signs or "the reference states nothing that could have changed.")
    return f"{opening}the largest changes at the shown cells are {'; '.join(largest)}. {signs}".rstrip()


def _values(comparison: Comparison) -> Subsection:
    around = tuple(name for name in comparison.variants if comparison.wall_varies_around[name])
    tables = cell_tables(
        comparison,
        "section-flow",
        "Flow rate through the section; 3D beside 2D",
        "section_flow_rate",
        "value",
        comparison.variants,
    ) + cell_tables(
        comparison,
        "sector-flow",
        f"Flow rate through one sector (one of {comparison.n_phi} around the artery), for variants whose "
        "wall differs around the artery: values that differ around it mean that flow crosses between rows",
        "sector_flow_rate",
        "value",
        around,
    )
    return Subsection(
        "flow", "Flow rate along the artery", tables or (Paragraph("No flow rates were scored."),)
    )


def _cell_changes(comparison: Comparison) -> tuple[Block, ...]:
    changed = comparison.changed
    tables = cell_tables(
        comparison,
        "change-section-flow",
        f"Change of the flow rate through the section: variant minus {baseline_words(comparison)}",
        "section_flow_rate",
        "change",
        changed,
    )
    around = tuple(name for name in changed if comparison.wall_varies_around[name])
    for quantity in _CELL_QUANTITIES:
        by_sector = quantity == "sector_flow_rate"  # a wall that is the same all around has equal sectors
        tables += cell_tables(
            comparison,
            f"change-{quantity}",
            f"Change of the {FIELDS[quantity].label}: variant minus {baseline_words(comparison)}",
            quantity,
            "change",
            around if by_sector else changed,
        )
    return tables


@declared("change", "What calcification changes, in numbers", appendix=True)
@of_each_model
def section(comparison: Comparison) -> Blocks:
    """Return the largest changes in words, then those of the whole cycle and of the shown cells."""
    times = listed(instant(name, t) for name, t in comparison.times)
    blocks: list[Block | Subsection] = []
    if comparison.changed:
        blocks += [Paragraph(_sentence(comparison, name)) for name in comparison.changed]
    else:
        blocks.append(
            Paragraph(
                "No variant of this case is without calcification, so there is no baseline: what "
                "calcification changes cannot be said; only the values themselves are shown."
            )
        )
    if times:
        blocks.append(
            Paragraph(f"Times are counted from the start of the cycle and are those of 3D states: {times}.")
        )
    apart = pooled.change_apart(comparison, comparison.changed) if comparison.changed else None
    if apart:
        blocks.append(apart)
    cycle = _cycle_table(comparison)
    if cycle:
        blocks.append(Subsection("whole-cycle", "Over the whole cycle", (cycle,)))
    blocks.append(_values(comparison))
    changes = _cell_changes(comparison) if comparison.changed else ()
    if changes:
        blocks.append(Subsection("cell-changes", "Change at the shown cells", changes))
    return tuple(blocks)
