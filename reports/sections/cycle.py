"""Section of pressure, radius and flow over the cycle at the chosen cells."""

from collections.abc import Sequence
from functools import partial

from cases.arrays import Floats
from cases.fields import FIELDS
from reports.blocks import Figure, Paragraph
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared
from reports.sections.parts.cells import chunks
from reports.sections.parts.grids import GridPanel, GridRow, grid_figure
from reports.sections.parts.places import degrees_words, place_words, probe_words
from reports.sections.parts.stated import anywhere, left_out
from reports.wording.numbers import listed

_SYMBOLS = {
    "pressure": "$P$",
    "radius": "$R$",
    "sector_flow_rate": r"$q_\varphi$",
    "section_flow_rate": "$q$",
}
_MOST_ROWS = 6  # of one figure; more are two of half as many, that each find room on a page
_OF_ROWS, _OF_SECTIONS = ("radius", "sector_flow_rate"), ("section_flow_rate",)


def _values(variant: str, quantity: str, i: int, j: int | None, view: Comparison, model: str) -> Floats:
    values = view.array(f"{model}_{quantity}", variant)[:, i - 1]
    return values if j is None else values[:, j - 1]


def _rows(comparison: Comparison, variant: str, columns: Sequence[int]) -> list[GridRow]:
    """Rows of panels of what the reference states: each quantity along each row j, then of sections."""
    lines = [("pressure", comparison.rows_of(variant)[0])]  # it hardly differs around a section
    lines += [(name, j) for name in _OF_ROWS for j in comparison.rows_of(variant)]
    if not comparison.wall_varies_around[variant]:
        lines = [line for line in lines if line[0] != "sector_flow_rate"]  # all are alike
    rows = []
    for quantity, j in [*lines, *((name, None) for name in _OF_SECTIONS)]:
        panels = tuple(
            GridPanel(partial(_values, variant, quantity, i, j), comparison.calcified(variant, i, j))
            for i in columns
        )
        if any(anywhere(panel.values(comparison, "reference")) for panel in panels):
            place = "section" if j is None else f"φ = {degrees_words(comparison, j)}"
            rows.append(GridRow(FIELDS[quantity], _SYMBOLS[quantity], place, panels))
    return rows


def _figures(comparison: Comparison, number: int, variant: str) -> list[Figure]:
    return [
        _figure(comparison, variant, columns, rows, f"cycle-{number}-{columns[0]}{f'-{part}' * (part > 1)}")
        for columns in chunks(comparison.i)
        for part, rows in enumerate(_in_parts(_rows(comparison, variant, columns)), start=1)
    ]


def _figure(
    comparison: Comparison, variant: str, columns: Sequence[int], rows: Sequence[GridRow], key: str
) -> Figure:
    what = listed(dict.fromkeys(row.field.label for row in rows))
    where = listed(place_words(comparison, i) for i in columns)
    return grid_figure(
        comparison,
        (
            key,
            f"Variant {variant}: {what} over the cycle at the probes; each row has its own scale.",
            f"Curves of {what} over time in 3D and 2D, variant {variant}, at {where}.",
        ),
        ("time into the cycle (s)", comparison.fields["time"].values.astype(float)),
        [probe_words(comparison, i) for i in columns],
        rows,
        from_zero=False,
    )


def _in_parts(rows: list[GridRow]) -> list[list[GridRow]]:
    """All rows, or both halves of many; none of none."""
    half = -(-len(rows) // 2)
    return [part for part in ([rows] if len(rows) <= _MOST_ROWS else [rows[:half], rows[half:]]) if part]


@declared("cycle", "Over the cycle at the probes", appendix=True)
def section(comparison: Comparison) -> Blocks:
    """Return the curves of each variant at the shown cells."""
    found = {name: _figures(comparison, k, name) for k, name in enumerate(comparison.variants, start=1)}
    told = left_out(comparison, [name for name in found if found[name]], "value over the cycle there")
    return (*((Paragraph(told),) if told else ()), *(figure for of in found.values() for figure in of))
