"""Fields over the unrolled lumen, (x, φ), both models and their difference side by side.

The cells are drawn as an image inside the vector drawing. Fields use a perceptually uniform map with one
scale for both models, differences a diverging map centred on zero; both are safe for the colour-blind.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib import colormaps, style
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.colors import Colormap, Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from reports.drawing import STYLE, WIDTH, svg_text

Array = NDArray[np.float64]

_LEFT, _RIGHT, _TOP, _BOTTOM = 0.62, 0.62, 0.22, 0.42
_GAP, _ROW_GAP = 0.10, 0.14
_BAR, _BAR_ROOM = 0.08, 0.72  # a colour bar's width, and with its numbers
_HEIGHT = 1.05
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

    panels: tuple[Array, ...]
    label: str
    difference: bool = False
    limits: tuple[float, float] | None = None


@dataclass(frozen=True)
class MapRow:
    """One row of panels: a label at its right edge, and groups of panels with a scale each."""

    label: str
    groups: tuple[Maps, ...]


def heat_maps(
    x: Array, phi: Array, columns: Sequence[str], rows: Sequence[MapRow], calcified: NDArray[np.bool_]
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
        total = _TOP + _BOTTOM + _HEIGHT * len(rows) + _ROW_GAP * (len(rows) - 1)
        figure = Figure(figsize=(WIDTH, total))
        FigureCanvasSVG(figure)
        for number, row in enumerate(rows):
            bottom = total - _TOP - (number + 1) * _HEIGHT - number * _ROW_GAP
            axes = _row(figure, row, (bottom / total, _HEIGHT / total), x, phi, calcified)
            if number == 0:
                for axis, title in zip(axes, columns, strict=True):
                    axis.set_title(title, fontsize=7.0, pad=3.0)
            if number == len(rows) - 1:
                for axis in axes:
                    axis.tick_params(labelbottom=True)
        figure.supxlabel("distance from the inlet x (mm)", fontsize=7.5, y=0.06 / total, va="bottom")
        return svg_text(figure)


def _row(
    figure: Figure,
    row: MapRow,
    place: tuple[float, float],
    x: Array,
    phi: Array,
    calcified: NDArray[np.bool_],
) -> list[Axes]:
    """Draw one row at (bottom, height), shares of the figure's."""
    bottom, height = place
    count = sum(len(group.panels) for group in row.groups)
    room = WIDTH - _LEFT - _RIGHT - (count - 1) * _GAP - _BAR_ROOM * (len(row.groups) - 1)
    width = (room - _BAR) / count
    axes: list[Axes] = []
    left = _LEFT
    for group in row.groups:
        norm, colours = _scale(group)
        for values in group.panels:
            axis = figure.add_axes((left / WIDTH, bottom, width / WIDTH, height))
            image = axis.pcolormesh(
                x,
                phi,
                np.ma.masked_invalid(values.T),
                shading="nearest",
                norm=norm,
                cmap=colours,
                rasterized=True,
            )
            _outline(axis, x, phi, calcified)
            axis.set_yticks([0, 90, 180, 270, 360])
            axis.xaxis.set_major_locator(MaxNLocator(3, prune="upper"))  # clear of the next panel's first
            axis.tick_params(labelbottom=False, labelleft=not axes)
            axis.set_xlim(*_ends(x))
            axis.set_ylim(*_ends(phi))
            axes.append(axis)
            left += width + _GAP
        bar_axis = figure.add_axes(((left - _GAP / 2) / WIDTH, bottom, _BAR / WIDTH, height))
        bar = figure.colorbar(image, cax=bar_axis, ticks=MaxNLocator(4))
        bar.outline.set_linewidth(0.5)
        bar.set_label(group.label, fontsize=7.0, labelpad=1.5)
        left += _BAR_ROOM - _GAP
    axes[0].set_ylabel(f"{row.label}\nφ (°)", fontsize=7.0, labelpad=1.0, parse_math=False)
    return axes


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


def _outline(axis: Axes, x: Array, phi: Array, calcified: NDArray[np.bool_]) -> None:
    """Outline the calcified cells so that the line shows on every colour."""
    if calcified.any() and not calcified.all():
        for colour, width, dashes in (("#ffffff", 1.4, "solid"), ("#000000", 0.7, "dashed")):
            axis.contour(
                x, phi, calcified.T.astype(float), [0.5], colors=colour, linewidths=width, linestyles=dashes
            )


def _ends(centres: Array) -> tuple[float, float]:
    """Outer edges of cells with these centres."""
    if centres.size == 1:
        return float(centres[0]) - 0.5, float(centres[0]) + 0.5
    first, last = centres[1] - centres[0], centres[-1] - centres[-2]
    return float(centres[0] - first / 2), float(centres[-1] + last / 2)
