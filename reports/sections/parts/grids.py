"""Curves of all models as a grid of panels, with their data: what the sections of curves share."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from cases.arrays import Floats
from cases.fields import Field
from reports.blocks import Figure
from reports.figures.along_and_around import Change, ChangeRow, along_and_around
from reports.result.load import Comparison
from reports.sections.parts.models import headed
from reports.wording.csv_text import comma_separated

Values = Callable[[Comparison, str], Floats]  # of a view and "reference" or "rom", SI


@dataclass(frozen=True)
class GridPanel:
    """One panel.

    Attributes
    ----------
    values : callable
        What gives the ordinates of a model, SI.
    calcified : bool
        Whether its place is in the calcification.
    """

    values: Values
    calcified: bool


@dataclass(frozen=True)
class GridRow:
    """One row of panels, a quantity in display units.

    Attributes
    ----------
    field : Field
    symbol : str
        As mathematics.
    place : str
        Of the row, for its label and its data.
    panels : tuple of GridPanel
    """

    field: Field
    symbol: str
    place: str
    panels: tuple[GridPanel, ...]


def grid_figure(
    comparison: Comparison,
    about: tuple[str, str, str],
    abscissa: tuple[str, Floats],
    columns: Sequence[str],
    rows: Sequence[GridRow],
    from_zero: bool = True,
) -> Figure:
    """Return a figure of all models.

    Parameters
    ----------
    comparison : Comparison
    about : (str, str, str)
        Key, caption and alternative text.
    abscissa : (str, ndarray)
        Label with unit, and values.
    columns : sequence of str
        Headings.
    rows : sequence of GridRow
        From top to bottom.
    from_zero : bool
        Whether their scales have zero in them.
    """
    drawn = [_row(comparison, row, abscissa) for row in rows]
    models = [headed(comparison, model) for model in comparison.models]
    key, caption, alt = about
    return Figure(
        key,
        caption,
        alt,
        partial(along_and_around, list(columns), drawn, models, from_zero=from_zero),
        _csv(comparison, abscissa, columns, list(zip(rows, drawn, strict=True))),
    )


def _row(comparison: Comparison, row: GridRow, abscissa: tuple[str, Floats]) -> ChangeRow:
    label, at = abscissa
    factor = row.field.display_factor
    return ChangeRow(
        f"{row.symbol} ({row.field.display_unit})\n{row.place}",
        label,
        at,
        tuple(
            Change(
                factor * panel.values(comparison, "reference"),
                tuple(factor * panel.values(comparison.of(model), "rom") for model in comparison.models),
                np.full(at.size, panel.calcified),
            )
            for panel in row.panels
        ),
    )


def _csv(
    comparison: Comparison,
    abscissa: tuple[str, Floats],
    columns: Sequence[str],
    rows: Sequence[tuple[GridRow, ChangeRow]],
) -> str:
    lines = [
        (
            of.field.name,
            of.field.display_unit,
            of.place,
            column,
            at,
            drawn.reference[n],
            *(m[n] for m in drawn.models),
        )
        for of, row in rows
        for column, drawn in zip(columns, row.panels, strict=True)
        for n, at in enumerate(abscissa[1].tolist())
    ]
    heading = ("quantity", "unit", "row", "column", abscissa[0], "reference", *comparison.models)
    return comma_separated(heading, lines)
