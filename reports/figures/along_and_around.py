"""What calcification moves, along the artery and around it: variant minus baseline in all models."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from matplotlib import style
from matplotlib.axes import Axes

from cases.arrays import Flags, Floats
from reports.figures import sheet
from reports.figures.canvas import STYLE, WIDTH, svg_text
from reports.figures.colours import CALCIFIED, QUIET
from reports.figures.lumen_cells import edges_of, runs

_LEFT, _RIGHT, _TOP, _BOTTOM = 0.66, 0.10, 0.46, 0.36
_HEIGHT, _GAP = 1.06, 0.44  # inches: of the panels, and below them for their abscissas
_LOW, _MANY = 0.84, 3  # the height where more rows than so many share a page
_CLOSE = 0.14  # below panels whose abscissas stand below the next row


@dataclass(frozen=True)
class Change:
    """What calcification changes along one line of cells, in display units.

    Attributes
    ----------
    reference : ndarray, shape (n,)
        In 3D; NaN is not stated.
    models : tuple of ndarray, each of shape (n,)
        In the reduced models.
    calcified : ndarray of bool, shape (n,)
        Cells to tint.
    """

    reference: Floats
    models: tuple[Floats, ...]
    calcified: Flags


@dataclass(frozen=True)
class ChangeRow:
    """One quantity along one kind of line, in all variants.

    Attributes
    ----------
    label, abscissa_label : str
        With units; the abscissa's tells where, as in ``"x (mm), at φ = 180°"``.
    abscissa : ndarray, shape (n,)
        Centres of the cells.
    panels : tuple of Change
        One a variant.
    ticks : tuple of float
        Numbers on the abscissa; by default round ones.
    """

    label: str
    abscissa_label: str
    abscissa: Floats
    panels: tuple[Change, ...]
    ticks: tuple[float, ...] = ()


def along_and_around(
    variants: Sequence[str],
    rows: Sequence[ChangeRow],
    models: Sequence[str],
    reference: str = "3D",
    from_zero: bool = True,
) -> str:
    """Draw a column a variant and a row a quantity and kind of line; each row has one scale.

    Parameters
    ----------
    variants : sequence of str
        Headings of the columns, as in ``"local − none"``.
    rows : sequence of ChangeRow
        From top to bottom.
    models : sequence of str
        Names of the reduced models.
    reference : str
        Name of the reference.
    from_zero : bool
        Whether each scale has zero in it.

    Returns
    -------
    str
        SVG; the same text for the same input.
    """
    with style.context(STYLE):
        below = [_CLOSE if _same_abscissa(*pair) else _GAP for pair in pairwise(rows)]
        high = _HEIGHT if len(rows) <= _MANY else _LOW
        total = _TOP + high * len(rows) + sum(below) + _BOTTOM
        figure, axis = sheet.sheet(total)
        for number, row in enumerate(rows):
            bottom = total - _TOP - high * (number + 1) - sum(below[:number])
            edges = edges_of(row.abscissa)
            known = [v for p in row.panels for v in (p.reference, *p.models)]
            panels = sheet.in_a_row(
                len(variants),
                (bottom, high),
                (_LEFT, WIDTH - _RIGHT),
                (float(edges[0]), float(edges[-1])),
                sheet.limits([*([np.zeros(1)] if from_zero else []), *known]),
                gap=0.26,
            )
            if number == 0:
                sheet.headings(axis, panels, variants)
            _tint(axis, panels, row, edges)
            sheet.ordinates(axis, panels, row.label, 4)
            sheet.across_panels(axis, panels, [0.0], color=QUIET, linewidth=0.6)
            at = [row.abscissa] * len(panels)
            sheet.model_curves(axis, panels, at, list(zip(*(p.models for p in row.panels), strict=True)))
            sheet.reference_points(axis, panels, at, [p.reference for p in row.panels])
            sheet.frames(axis, panels)
            if number == len(below) or below[number] == _GAP:
                sheet.abscissas(axis, panels, row.abscissa_label, row.ticks or None, 4)
        keys = list(sheet.models_keys(reference, models))
        if any(panel.calcified.any() for row in rows for panel in row.panels):
            keys.append(sheet.Key("calcified", fill=CALCIFIED))
        sheet.legend(axis, keys, _LEFT, total - 0.12)
        return svg_text(figure)


def _same_abscissa(row: ChangeRow, below: ChangeRow) -> bool:
    return row.abscissa_label == below.abscissa_label and np.array_equal(row.abscissa, below.abscissa)


def _tint(axis: Axes, panels: Sequence[sheet.Panel], row: ChangeRow, edges: Floats) -> None:
    """Tint the calcified stretches of each panel."""
    corners = [
        (float(panel.across(edges[first])), float(panel.across(edges[last])), panel.bottom, panel.top)
        for panel, change in zip(panels, row.panels, strict=True)
        for first, last in runs(change.calcified)
    ]
    sheet.boxes(axis, corners, CALCIFIED)
