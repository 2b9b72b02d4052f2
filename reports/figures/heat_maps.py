"""Fields over the unrolled lumen, (x, φ), in panels side by side.

The cells are drawn as an image inside the vector drawing. Fields use a perceptually uniform map with one
scale for all panels of a group, differences a diverging map centred on zero; both are safe for the
colour-blind.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib import style
from matplotlib.axes import Axes

from cases.arrays import Flags, Floats
from reports.figures import sheet
from reports.figures.canvas import STYLE, WIDTH, svg_text
from reports.figures.colour_scale import BAR, Scale, bar, cells, hatch, scale_of
from reports.figures.lumen_cells import cell_borders, edges_of
from reports.figures.sheet import Panel

_LEFT, _RIGHT, _TOP, _BOTTOM = 0.50, 0.62, 0.24, 0.36
_LINE = 0.13  # inches; of a line of a row's label
_GAP, _ROW_GAP = 0.10, 0.14
_BAR_ROOM = 0.72  # a colour bar with its numbers
_HEIGHT, _HEIGHT_OF_MANY, _MANY = 0.86, 0.60, 4  # two figures of many rows share a page
_ANGLES = (0.0, 180.0, 360.0)
_PLAIN = "#f2f2f2"  # behind words that stand for a panel


@dataclass(frozen=True)
class Maps:
    """Neighbouring panels with one colour scale.

    Attributes
    ----------
    panels : tuple of ndarray, each of shape (x, phi)
        In display units; what is not finite is drawn grey.
    label : str
        Of the colour bar, with the unit.
    difference : bool
        Whether the scale is diverging and centred on zero.
    limits : (float, float), optional
        Ends of the scale; by default those of the panels.
    scale : Scale, optional
        In place of the one that the three above make.
    words : tuple of str
        In place of each panel, "" where it is drawn; by default all are.
    corners : tuple of str
        Written into the upper left corner of each panel, "" for nothing.
    threshold : float, optional
        Value whose exceedance is bordered.
    """

    panels: tuple[Floats, ...]
    label: str
    difference: bool = False
    limits: tuple[float, float] | None = None
    scale: Scale | None = None
    words: tuple[str, ...] = ()
    corners: tuple[str, ...] = ()
    threshold: float | None = None


@dataclass(frozen=True)
class MapRow:
    """One row of panels: a label at its left edge, and groups of panels with a scale each."""

    label: str
    groups: tuple[Maps, ...]


def heat_maps(
    x: Floats,
    phi: Floats,
    columns: Sequence[str],
    rows: Sequence[MapRow],
    calcified: Flags,
    note: str = "",
) -> str:
    """Draw rows of maps with shared axes; rows that share one scale have one bar.

    Parameters
    ----------
    x, phi : ndarray
        Centres of the cells (mm, degrees).
    columns : sequence of str
        Headings of the panels.
    rows : sequence of MapRow
        From top to bottom, all with the same numbers of panels.
    calcified : ndarray of bool, shape (x, phi) or (column, x, phi)
        Cells to outline.
    note : str
        Written at the lower right: what a colour or line means.

    Returns
    -------
    str
        SVG; the same text for the same input.
    """
    with style.context(STYLE):
        height = _HEIGHT if len(rows) < _MANY else _HEIGHT_OF_MANY
        foot = _BOTTOM + (_LINE if note else 0.0)
        total = _TOP + foot + height * len(rows) + _ROW_GAP * (len(rows) - 1)
        figure, axis = sheet.sheet(total)
        edges = (edges_of(x), edges_of(phi))
        inside = np.broadcast_to(calcified, (len(columns), x.size, phi.size))
        shared = _shared(rows)
        left = _LEFT + _LINE * max(1 + row.label.count("\n") if row.label else 0 for row in rows)
        for number, row in enumerate(rows):
            bottom = total - _TOP - (number + 1) * height - number * _ROW_GAP
            panels = _row(axis, row, (left, bottom, height), edges, inside)
            if number == 0:
                sheet.headings(axis, panels, columns)
            if number == len(rows) - 1 or not shared:
                _bars(axis, row, panels, total - _TOP - bottom if shared else height)
        sheet.abscissas(axis, panels, "distance from the inlet $x$ (mm)")
        if note:
            axis.text(WIDTH - 0.08, 0.05, note, ha="right", va="bottom", fontsize=sheet.SMALL)
        return svg_text(figure)


def _shared(rows: Sequence[MapRow]) -> bool:
    """Whether all rows have the same scales, given."""
    first = [group.scale for group in rows[0].groups]
    return None not in first and all([g.scale for g in row.groups] == first for row in rows)


def _row(
    axis: Axes, row: MapRow, place: tuple[float, float, float], edges: tuple[Floats, Floats], inside: Flags
) -> list[Panel]:
    """Draw the panels of one row at (left, bottom, height), inches, and return them."""
    panels = _places(row, place, edges)
    places = iter(panels)
    for group, scale in zip(row.groups, _scales(row), strict=True):
        for number, values in enumerate(group.panels):
            panel = next(places)
            if group.words and group.words[number]:
                _write(axis, panel, group.words[number])
            else:
                _draw(axis, panel, edges, values, scale, group.threshold)
            if group.corners and group.corners[number]:
                sheet.corner(axis, panel, group.corners[number])
    for panel, flags in zip(panels, inside, strict=True):
        _border(axis, panel, cell_borders(*edges, flags), 1.6, 0.7)
    sheet.frames(axis, panels, closed=True)
    sheet.ordinates(axis, panels[:1], "$φ$ (°)", _ANGLES, grid=False, aside=0.36)
    at = 0.08, place[1] + place[2] / 2
    axis.text(*at, row.label, rotation=90, ha="left", va="center", fontsize=7.0, linespacing=1.1)
    return panels


def _places(row: MapRow, place: tuple[float, float, float], edges: tuple[Floats, Floats]) -> list[Panel]:
    """Panels of a row, with room for a bar behind each group."""
    count = sum(len(group.panels) for group in row.groups)
    left, bottom, height = place
    room = WIDTH - left - _RIGHT - (count - 1) * _GAP - _BAR_ROOM * (len(row.groups) - 1)
    width = (room - BAR) / count
    panels = []
    for group in row.groups:
        for _ in group.panels:
            ends = [(float(ends[0]), float(ends[-1])) for ends in edges]
            panels.append(Panel(left, bottom, width, height, ends[0], ends[1]))
            left += width + _GAP
        left += _BAR_ROOM - _GAP
    return panels


def _scales(row: MapRow) -> list[Scale]:
    return [group.scale or scale_of(group.panels, group.difference, group.limits) for group in row.groups]


def _bars(axis: Axes, row: MapRow, panels: Sequence[Panel], height: float) -> None:
    """Draw the bar of each group behind its last panel."""
    count = 0
    for group, scale in zip(row.groups, _scales(row), strict=True):
        count += len(group.panels)
        last = panels[count - 1]
        bar(axis, (last.left + last.width + _GAP / 2, last.bottom, height), scale, group.label)


def _draw(
    axis: Axes,
    panel: Panel,
    edges: tuple[Floats, Floats],
    values: Floats,
    scale: Scale,
    threshold: float | None,
) -> None:
    cells(axis, panel, *edges, values, scale)
    if scale.limit is not None:
        hatch(axis, panel, *edges, values, scale.limit)
    if threshold is not None:
        with np.errstate(invalid="ignore"):
            _border(axis, panel, cell_borders(*edges, values > threshold), 0.0, 0.5)


def _border(axis: Axes, panel: Panel, borders: Floats, halo: float, width: float) -> None:
    """Draw borders between cells in black, and in white around, so that they show on every colour."""
    x, y = (np.pad(borders[..., k], ((0, 0), (0, 1)), constant_values=np.nan).ravel() for k in (0, 1))
    for colour, size in (("#ffffff", halo), ("#000000", width)):
        if size and x.size:
            sheet.line(
                axis, panel.across(x), panel.up(y), color=colour, linewidth=size, solid_capstyle="projecting"
            )


def _write(axis: Axes, panel: Panel, words: str) -> None:
    """Write words in place of a panel."""
    right = panel.left + panel.width
    sheet.boxes(axis, [(panel.left, right, panel.bottom, panel.top)], _PLAIN)
    middle = (panel.left + right) / 2, panel.bottom + panel.height / 2
    pad = {"facecolor": _PLAIN, "linewidth": 0, "pad": 1.0}
    axis.text(*middle, words, ha="center", va="center", fontsize=7.5, zorder=4, bbox=pad, parse_math=False)
