"""Tables of both models' values at chosen cells and instants."""

from collections.abc import Iterator, Sequence

from cases.results.metric_row import MetricRow
from reports.blocks import Column, Table
from reports.result.load import Comparison
from reports.sections.parts.places import degrees_words, place_words
from reports.wording.numbers import DIFFERENCE_UNITS, decimals_for, fixed
from reports.wording.words import field_of, instant

_MOST_COLUMNS = 5  # cells side by side on a page


def chunks(cells: Sequence[int]) -> Iterator[tuple[int, ...]]:
    """Cells i in groups that fit side by side."""
    for start in range(0, len(cells), _MOST_COLUMNS):
        yield tuple(cells[start : start + _MOST_COLUMNS])


def cell_tables(
    comparison: Comparison,
    key: str,
    caption: str,
    quantity: str,
    statistic: str,
    variants: Sequence[str],
) -> tuple[Table, ...]:
    """Tables of one statistic: a line per variant, instant (and row j), 3D beside 2D for each cell i.

    A statistic "value" is shown in the quantity's display unit with four digits, "change" in the finer unit
    for differences with three. Lines without any figure are left out; without any line there is no table.
    """
    sections = field_of(quantity, "").dims == ("time", "x")
    lines = [
        (variant, name, t, None if sections else j)
        for variant in variants
        for name, t in comparison.times
        for j in (comparison.rows_of(variant)[:1] if sections else comparison.rows_of(variant))
    ]
    found = {
        (line, i): comparison.metrics.find(line[0], quantity, statistic, i, line[3], line[2])
        for line in lines
        for i in comparison.i
    }
    present = [row for row in found.values() if row is not None]
    if not present:
        return ()
    unit, factor = _unit(quantity, statistic, present[0].unit)
    numbers = [n * factor for row in present for n in (row.reference, row.rom) if n is not None]
    decimals = decimals_for(numbers, 4 if statistic == "value" else 3, most=6 if statistic == "value" else 3)

    def pair(row: MetricRow | None) -> tuple[str, str]:
        both = (row.reference, row.rom) if row else (None, None)
        three, two = (None if n is None else n * factor for n in both)
        return fixed(three, decimals), fixed(two, decimals)

    tables = []
    mark = "section through the calcification" if sections else "inside the calcification"
    for cells in chunks(comparison.i):
        shown = [
            line
            for line in lines
            if any(
                row is not None and not (comparison.sparse and row.reference is None)
                for row in (found[line, i] for i in cells)
            )
        ]
        if not shown:
            continue
        first = 2 if sections else 3
        marked = frozenset(
            (number, first + 2 * column + model)
            for number, line in enumerate(shown)
            for column, i in enumerate(cells)
            if comparison.calcified(line[0], i, line[3])
            for model in (0, 1)
        )
        heading = (Column("variant"), Column("time"), *(() if sections else (Column("φ", "number"),)))
        body = tuple(
            (
                line[0],
                instant(line[1], line[2]),
                *(() if sections else (degrees_words(comparison, line[3]),)),
                *(text for i in cells for text in pair(found[line, i])),
            )
            for line in shown
        )
        columns = tuple(
            Column(model, "number", place_words(comparison, i)) for i in cells for model in ("3D", "2D")
        )
        suffix = "" if len(comparison.i) <= _MOST_COLUMNS else f"-{cells[0]}"
        said = f"{caption}; in {unit}." + (f" Shaded: {mark}." if marked else "")
        tables.append(Table(f"{key}{suffix}", said, heading + columns, body, 0, marked, mark))
    return tuple(tables)


def _unit(quantity: str, statistic: str, si_unit: str) -> tuple[str, float]:
    field = field_of(quantity, si_unit)
    if statistic == "value":
        return field.display_unit, field.display_factor
    return DIFFERENCE_UNITS.get(field.unit, (field.display_unit, field.display_factor))
