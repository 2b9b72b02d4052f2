"""Small multiples of both models' curves, drawn once for HTML and PDF.

The reference (3D) is near-black points, the reduced model (2D) a solid blue line, the difference orange:
the three also differ in grey and for the colour-blind.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from reports.drawing import STYLE, WIDTH, svg_text

Array = NDArray[np.float64]

REFERENCE_COLOUR = "#1a1a1a"
ROM_COLOUR = "#0072b2"
DIFFERENCE_COLOUR = "#b8480b"
_MARK_COLOUR = "#9a9a9a"
_LEFT, _RIGHT, _TOP, _BOTTOM, _GAP = 0.62, 0.26, 0.50, 0.40, 0.10
_CURVE_HEIGHT, _CURVE_HEIGHT_ALONE, _DIFFERENCE_HEIGHT = 1.22, 0.86, 0.72
_ROW_GAP = 0.14
_MOST_MARKERS = 45


@dataclass(frozen=True)
class Curves:
    """Both models in one panel, in display units; a name in the panel's corner if there is one."""

    reference: Array
    rom: Array
    note: str = ""


@dataclass(frozen=True)
class PanelRow:
    """One row of panels.

    Attributes
    ----------
    quantity : str
        Axis label with unit.
    label : str
        Written at the row's right edge: which cell row, instant or quantity.
    panels : tuple of Curves
        One a column.
    difference : str
        Axis label of the panels for 2D − 3D below the curves; "" for none.
    difference_factor : float
        Unit of the differences over that of the curves.
    """

    quantity: str
    label: str
    panels: tuple[Curves, ...]
    difference: str = ""
    difference_factor: float = 1.0


def small_multiples(
    abscissa: Array,
    abscissa_label: str,
    columns: Sequence[str],
    rows: Sequence[PanelRow],
    marks: Sequence[float] = (),
    from_zero: bool = False,
) -> str:
    """Draw rows × columns panels with shared axes and one legend.

    Parameters
    ----------
    abscissa : ndarray, shape (n,)
        Common to all curves.
    abscissa_label : str
        With its unit.
    columns : sequence of str
        Headings of the columns.
    rows : sequence of PanelRow
        From top to bottom.
    marks : sequence of float
        Abscissas of thin vertical lines (the named instants).
    from_zero : bool
        Whether the curves' axes include zero.

    Returns
    -------
    str
        SVG; the same text for the same input.
    """
    with style.context(STYLE):
        heights = [
            height
            for row in rows
            for height in ((_CURVE_HEIGHT, _DIFFERENCE_HEIGHT) if row.difference else (_CURVE_HEIGHT_ALONE,))
        ]
        total = _TOP + _BOTTOM + sum(heights) + _ROW_GAP * (len(heights) - 1)
        figure = Figure(figsize=(WIDTH, total))
        FigureCanvasSVG(figure)
        axes = _panels(figure, heights, len(columns), total)
        _legend(figure, bool(marks), any(row.difference for row in rows))
        for title, axis in zip(columns, axes[0], strict=True):
            axis.set_title(title, fontsize=7.0, pad=3.0)
        lines = iter(axes)
        for row in rows:
            _curves(next(lines), row, abscissa, marks, from_zero)
            if row.difference:
                _differences(next(lines), row, abscissa, marks)
        _abscissas(axes, abscissa)
        figure.supxlabel(abscissa_label, fontsize=7.5, y=0.06 / total, va="bottom")
        return svg_text(figure)


def _panels(figure: Figure, heights: Sequence[float], n_columns: int, total: float) -> list[list[Axes]]:
    width = (WIDTH - _LEFT - _RIGHT - _GAP * (n_columns - 1)) / n_columns
    grid, top = [], total - _TOP
    for height in heights:
        bottom = top - height
        grid.append(
            [
                figure.add_axes(
                    (
                        (_LEFT + column * (width + _GAP)) / WIDTH,
                        bottom / total,
                        width / WIDTH,
                        height / total,
                    )
                )
                for column in range(n_columns)
            ]
        )
        top = bottom - _ROW_GAP
    for axis in (axis for line in grid for axis in line):
        axis.spines[["top", "right"]].set_visible(False)
        axis.set_xticks([])
        axis.set_yticks([])
    return grid


def _legend(figure: Figure, marked: bool, differences: bool) -> None:
    handles = [
        Line2D([], [], color=REFERENCE_COLOUR, marker="o", markersize=3.0, linestyle="none", label="3D"),
        Line2D([], [], color=ROM_COLOUR, linewidth=1.4, label="2D"),
    ]
    if differences:
        handles.append(
            Line2D([], [], color=DIFFERENCE_COLOUR, linewidth=1.1, linestyle=(0, (4, 1)), label="2D − 3D")
        )
    if marked:
        handles.append(Line2D([], [], color=_MARK_COLOUR, linewidth=0.8, linestyle=":", label="named times"))
    figure.legend(
        handles=handles,
        loc="upper left",
        bbox_to_anchor=(_LEFT / WIDTH, 1.0),
        borderaxespad=0.3,
        ncols=len(handles),
        frameon=False,
        fontsize=7.5,
    )


def _curves(
    axes: Sequence[Axes], row: PanelRow, abscissa: Array, marks: Sequence[float], from_zero: bool
) -> None:
    every = max(1, -(-abscissa.size // _MOST_MARKERS))
    limits = _limits([a for p in row.panels for a in (p.reference, p.rom)], from_zero)
    for axis, panel in zip(axes, row.panels, strict=True):
        _mark(axis, marks)
        axis.plot(abscissa, panel.rom, color=ROM_COLOUR, linewidth=1.4, solid_capstyle="round")
        axis.plot(
            abscissa,
            panel.reference,
            color=REFERENCE_COLOUR,
            linestyle="none",
            marker="o",
            markersize=1.7,
            markeredgewidth=0,
            markevery=every,
        )
        if panel.note:
            axis.text(0.04, 0.05, panel.note, transform=axis.transAxes, fontsize=6.0, parse_math=False)
    _ordinates(axes, limits, 4)
    axes[0].set_ylabel(row.quantity, fontsize=7.5, labelpad=2.0)
    _row_label(axes[-1], row.label)


def _differences(axes: Sequence[Axes], row: PanelRow, abscissa: Array, marks: Sequence[float]) -> None:
    differences = [row.difference_factor * (panel.rom - panel.reference) for panel in row.panels]
    limits = _limits([*differences, np.zeros(1)], from_zero=False)
    for axis, values in zip(axes, differences, strict=True):
        _mark(axis, marks)
        axis.axhline(0.0, color="#555555", linewidth=0.5)
        axis.plot(abscissa, values, color=DIFFERENCE_COLOUR, linewidth=1.1, linestyle=(0, (4, 1)))
    _ordinates(axes, limits, 3)
    axes[0].set_ylabel(row.difference, fontsize=7.0, labelpad=2.0)


def _abscissas(axes: Sequence[Sequence[Axes]], abscissa: Array) -> None:
    """Give all panels one horizontal axis, with numbers below the last row only."""
    low, high = _limits([abscissa], from_zero=False)
    for axis in (axis for line in axes for axis in line):
        axis.set_xlim(low, high)
    for axis in axes[-1]:
        axis.set_xticks(_ticks(low, high, 3))


def _ordinates(axes: Sequence[Axes], limits: tuple[float, float], most: int) -> None:
    """Give a row of panels one vertical axis, with numbers at its first panel and lines across all."""
    ticks = _ticks(*limits, most)
    for axis in axes:
        axis.set_ylim(*limits)
        lines = [[(0.0, tick), (1.0, tick)] for tick in ticks]
        across = LineCollection(
            lines, colors="#d8d8d8", linewidths=0.4, zorder=0.5, transform=axis.get_yaxis_transform()
        )
        axis.add_collection(across, autolim=False)
    axes[0].set_yticks(ticks)


def _ticks(low: float, high: float, most: int) -> list[float]:
    return [float(tick) for tick in MaxNLocator(most).tick_values(low, high) if low <= tick <= high]


def _mark(axis: Axes, marks: Sequence[float]) -> None:
    for mark in marks:
        axis.axvline(mark, color=_MARK_COLOUR, linewidth=0.6, linestyle=":")


def _row_label(axis: Axes, label: str) -> None:
    axis.text(
        1.06,
        0.5,
        label,
        transform=axis.transAxes,
        rotation=-90,
        va="center",
        ha="left",
        fontsize=7.0,
        parse_math=False,
    )


def _limits(arrays: Sequence[Array], from_zero: bool) -> tuple[float, float]:
    """Range of all finite values with a margin; never empty."""
    values = np.concatenate([np.ravel(a) for a in arrays])
    values = values[np.isfinite(values)]
    if from_zero:
        values = np.append(values, 0.0)
    if values.size == 0:
        return 0.0, 1.0
    low, high = float(values.min()), float(values.max())
    span = high - low if high - low > 1e-9 * max(abs(low), abs(high)) else 0.0  # not what is mere round-off
    margin = 0.06 * span or 0.05 * abs(high) or 1.0
    return (low if from_zero and low == 0 else low - margin), high + margin
