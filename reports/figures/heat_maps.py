"""Fields over the unrolled lumen, (x, φ), both models and their difference side by side.

The cells are drawn as an image inside the vector drawing. Fields use a perceptually uniform map with one
scale for both models, differences a diverging map centred on zero; both are safe for the colour-blind.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib import colormaps, style
from matplotlib.axes import Axes
from matplotlib.colors import Colormap, Normalize
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator

from cases.arrays import Flags, Floats
from reports.figures.canvas import STYLE, WIDTH, svg_text
from reports.figures.lumen_cells import cell_borders, edges_of

_LEFT, _RIGHT, _TOP, _BOTTOM = 0.62, 0.62, 0.22, 0.42
_GAP, _ROW_GAP = 0.10, 0.14
_BAR, _BAR_ROOM = 0.08, 0.72  # a colour bar's width, and with its numbers
_HEIGHT, _HEIGHT_OF_MANY, _MANY = 0.86, 0.60, 4  # two figures of many rows share a page
_MISSING_COLOUR = "#b0b0b0"


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
    """

    panels: tuple[Floats, ...]
    label: str
    difference: bool = False
    limits: tuple[float, float] | None = None


@dataclass(frozen=True)
class MapRow:
    """One row of panels: a label at its right edge, and groups of panels with a scale each."""

    label: str
    groups: tuple[Maps, ...]


def heat_maps(
    x: Floats, phi: Floats, columns: Sequence[str], rows: Sequence[MapRow], calcified: Flags
) -> str:
    """Draw rows of maps with shared axes.

    Parameters
    ----------
    x, phi : ndarray
        Centres of the cells (mm, degrees).
    columns : sequence of str
        Headings of the panels.
    rows : sequence of MapRow
        From top to bottom, all with the same numbers of panels.
    calcified : ndarray of bool, shape (x, phi)
        Cells to outline.

    Returns
    -------
    str
        SVG; the same text for the same input.
    """
    with style.context(STYLE):
        height = _HEIGHT if len(rows) < _MANY else _HEIGHT_OF_MANY
        total = _TOP + _BOTTOM + height * len(rows) + _ROW_GAP * (len(rows) - 1)
        figure = Figure(figsize=(WIDTH, total))
        edges = (edges_of(x), edges_of(phi))
        outline = cell_borders(*edges, calcified)
        for number, row in enumerate(rows):
            bottom = total - _TOP - (number + 1) * height - number * _ROW_GAP
            titles = columns if number == 0 else ()
            axis = _row(figure, row, (bottom / total, height / total), edges, outline, titles)
            axis.tick_params(labelbottom=number == len(rows) - 1)
        figure.supxlabel("distance from the inlet x (mm)", fontsize=7.5, y=0.06 / total, va="bottom")
        return svg_text(figure)


def _row(
    figure: Figure,
    row: MapRow,
    place: tuple[float, float],
    edges: tuple[Floats, Floats],
    outline: Floats,
    columns: Sequence[str],
) -> Axes:
    """Draw one row at (bottom, height), shares of the figure's; return the Axes of its panels."""
    bottom, height = place
    count = sum(len(group.panels) for group in row.groups)
    room = WIDTH - _LEFT - _RIGHT - (count - 1) * _GAP - _BAR_ROOM * (len(row.groups) - 1)
    width = (room - _BAR) / count
    across = WIDTH - _LEFT
    axis = figure.add_axes((_LEFT / WIDTH, bottom, across / WIDTH, height))
    axis.set_xlim(0.0, across)
    axis.set_ylim(edges[1][0], edges[1][-1])
    axis.spines[:].set_visible(False)
    x, phi = edges
    left, lefts, titles = 0.0, [], iter(columns)
    for group in row.groups:
        norm, colours = _scale(group)
        for values in group.panels:
            _panel(axis, left, width, (x, phi), values, norm, colours)
            _outline(axis, left + width * (outline[..., 0] - x[0]) / (x[-1] - x[0]), outline[..., 1])
            axis.text(
                left + width / 2,
                1.04,
                next(titles, ""),
                transform=axis.get_xaxis_transform(),
                ha="center",
                fontsize=7.0,
            )
            lefts.append(left)
            left += width + _GAP
        colour_bar(figure, (_LEFT + left - _GAP / 2, bottom, height), norm, colours, group.label)
        left += _BAR_ROOM - _GAP
    axis.set_yticks([tick for tick in (0, 180, 360) if phi[0] <= tick <= phi[-1]])
    axis.set_ylabel(f"{row.label}\nφ (°)".strip(), fontsize=7.0, labelpad=1.0, parse_math=False)
    ticks = [t for t in MaxNLocator(3, prune="upper").tick_values(x[0], x[-1]) if x[0] <= t <= x[-1]]
    axis.set_xticks(
        [start + width * (t - x[0]) / (x[-1] - x[0]) for start in lefts for t in ticks],
        [f"{t:g}" for t in ticks] * count,
    )
    return axis


def _panel(
    axis: Axes,
    left: float,
    width: float,
    edges: tuple[Floats, Floats],
    values: Floats,
    norm: Normalize,
    colours: Colormap,
) -> None:
    """Draw a panel's cells as an image, `left` inches from the first panel."""
    x, phi = edges
    cells = axis.pcolorfast(
        left + width * (x - x[0]) / (x[-1] - x[0]),
        phi,
        np.ma.masked_invalid(values.T),
        norm=norm,
        cmap=colours,
    )
    if isinstance(cells, AxesImage):
        cells.set_interpolation("none")  # a pixel a cell, whatever the drawing's size
    frame = Rectangle((left, phi[0]), width, phi[-1] - phi[0], fill=False, linewidth=0.5, clip_on=False)
    axis.add_patch(frame)


def scale_colours(bar: Axes, norm: Normalize, colours: Colormap) -> None:
    """Fill an axis with the colours of a scale, its values on the right."""
    low, high = float(norm.vmin or 0.0), float(norm.vmax or 0.0)
    bar.imshow(
        np.linspace(low, high, 256)[:, None],
        extent=(0.0, 1.0, low, high),
        origin="lower",
        aspect="auto",
        norm=norm,
        cmap=colours,
        interpolation="none",
    )
    bar.yaxis.tick_right()
    bar.yaxis.set_label_position("right")
    bar.set_xticks([])


def colour_bar(
    figure: Figure, place: tuple[float, float, float], norm: Normalize, colours: Colormap, label: str
) -> None:
    """Draw a colour bar at (left (inches), bottom, height)."""
    left, bottom, height = place
    bar = figure.add_axes((left / WIDTH, bottom, _BAR / WIDTH, height))
    low, high = float(norm.vmin or 0.0), float(norm.vmax or 0.0)
    scale_colours(bar, norm, colours)
    bar.set_yticks([tick for tick in MaxNLocator(3).tick_values(low, high) if low <= tick <= high])
    bar.set_ylabel(label, fontsize=7.0, labelpad=1.5)


def _scale(group: Maps) -> tuple[Normalize, Colormap]:
    values = np.concatenate([panel.ravel() for panel in group.panels])
    values = values[np.isfinite(values)]
    low, high = group.limits or ((values.min(), values.max()) if values.size else (0.0, 1.0))
    if group.difference:
        high = max(abs(low), abs(high))
        low = -high
    if high - low <= 1e-9 * max(abs(low), abs(high)):  # mere round-off is not spread over all colours
        margin = 0.05 * abs(high) or 1.0
        low, high = low - margin, high + margin
    colours = colormaps["RdBu_r" if group.difference else "viridis"].with_extremes(bad=_MISSING_COLOUR)
    return Normalize(float(low), float(high)), colours


def _outline(axis: Axes, inches: Floats, phi: Floats) -> None:
    """Outline the calcified cells in black and white, so that the line shows on every colour."""
    x, y = (np.pad(ends, ((0, 0), (0, 1)), constant_values=np.nan).ravel() for ends in (inches, phi))
    for colour, width in (("#ffffff", 1.6), ("#000000", 0.7)):
        axis.plot(x, y, color=colour, linewidth=width, solid_capstyle="projecting", clip_on=False)
