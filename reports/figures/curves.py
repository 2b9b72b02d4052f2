"""Small multiples of both models' curves, drawn once for HTML and PDF.

The reference (3D) is near-black points, the reduced model (2D) a solid blue line, the difference orange:
the three also differ in grey and for the colour-blind. A row of panels is one Axes, in inches from the first
panel's left edge: thirty Axes a figure would take a second to draw.
"""

from collections.abc import Sequence

import numpy as np
from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle
from matplotlib.ticker import MaxNLocator

from cases.arrays import Floats
from reports.figures.canvas import STYLE, WIDTH, legend_above, svg_text
from reports.figures.panels import LEFT, Curves, Layout, PanelRow

REFERENCE_COLOUR = "#1a1a1a"
ROM_COLOUR = "#0072b2"
DIFFERENCE_COLOUR = "#b8480b"
TINT = "#f4ead8"
_MARK_COLOUR = "#9a9a9a"
_TOP, _BOTTOM = 0.50, 0.40
_CURVE_HEIGHT, _CURVE_HEIGHT_ALONE, _DIFFERENCE_HEIGHT = 1.22, 0.86, 0.72
_ROW_GAP = 0.14
_LABEL = 0.40  # of the axis labels, left of the panels
_MOST_MARKERS = 45
_DASHES = (0, (4, 1))


def small_multiples(
    abscissa: Floats,
    abscissa_label: str,
    columns: Sequence[str],
    rows: Sequence[PanelRow],
    marks: Sequence[float] = (),
    from_zero: bool = False,
    names: tuple[str, str] = ("3D", "2D"),
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
    names : (str, str)
        What the legend calls what is drawn in the reference's and in the reduced model's colour.

    Returns
    -------
    str
        SVG; the same text for the same input.
    """
    with style.context(STYLE):
        layout = Layout(len(columns), *_limits([abscissa], from_zero=False))
        heights = [
            height
            for row in rows
            for height in ((_CURVE_HEIGHT, _DIFFERENCE_HEIGHT) if row.difference else (_CURVE_HEIGHT_ALONE,))
        ]
        total = _TOP + _BOTTOM + sum(heights) + _ROW_GAP * (len(heights) - 1)
        figure = Figure(figsize=(WIDTH, total))
        axes = _axes(figure, heights, layout, total)
        _legend(figure, rows, bool(marks), names)
        for left, title in zip(layout.lefts, columns, strict=True):
            _above(axes[0], left + layout.width / 2, title)
        lines = iter(axes)
        for row in rows:
            _curves(next(lines), layout, row, abscissa, marks, from_zero)
            if row.difference:
                _differences(next(lines), layout, row, abscissa, marks)
        _abscissas(axes[-1], layout)
        figure.supxlabel(abscissa_label, fontsize=7.5, y=0.06 / total, va="bottom")
        return svg_text(figure)


def _axes(figure: Figure, heights: Sequence[float], layout: Layout, total: float) -> list[Axes]:
    """One Axes a row, from top to bottom."""
    axes, top = [], total - _TOP
    across = layout.lefts[-1] + layout.width
    for height in heights:
        bottom = top - height
        axis = figure.add_axes((LEFT / WIDTH, bottom / total, across / WIDTH, height / total))
        axis.set_xlim(0.0, across)
        axis.yaxis.set_label_coords(-_LABEL / across, 0.5)
        axis.spines[["left", "bottom", "top", "right"]].set_visible(False)
        axis.xaxis.set_visible(False)
        axes.append(axis)
        top = bottom - _ROW_GAP
    return axes


def _above(axis: Axes, inches: float, title: str) -> None:
    axis.text(
        inches, 1.05, title, transform=axis.get_xaxis_transform(), ha="center", fontsize=7.0, parse_math=False
    )


def _legend(figure: Figure, rows: Sequence[PanelRow], marked: bool, names: tuple[str, str]) -> None:
    points = any(panel.rom.size for row in rows for panel in row.panels)
    handles: list[Line2D | Patch] = [
        Line2D([], [], color=REFERENCE_COLOUR, marker="o", markersize=3.0, linestyle="none", label=names[0])
        if points
        else Line2D([], [], color=REFERENCE_COLOUR, linewidth=1.1, label=names[0]),
        Line2D([], [], color=ROM_COLOUR, linewidth=1.4, label=names[1]),
    ]
    if any(row.difference for row in rows):
        handles.append(
            Line2D([], [], color=DIFFERENCE_COLOUR, linewidth=1.1, linestyle=_DASHES, label="2D − 3D")
        )
    if marked:
        handles.append(Line2D([], [], color=_MARK_COLOUR, linewidth=0.8, linestyle=":", label="named times"))
    if any(panel.calcified for row in rows for panel in row.panels):
        handles.append(Patch(facecolor=TINT, edgecolor=_MARK_COLOUR, linewidth=0.4, label="calcified cell"))
    legend_above(figure, handles, LEFT)


def _curves(
    axis: Axes,
    layout: Layout,
    row: PanelRow,
    abscissa: Floats,
    marks: Sequence[float],
    from_zero: bool,
) -> None:
    limits = _limits([a for p in row.panels for a in (p.reference, p.rom)], from_zero)
    _ordinates(axis, layout, limits, 4)
    _background(axis, layout, row.panels, marks)
    if any(panel.rom.size for panel in row.panels):
        axis.plot(
            *_joined(layout, abscissa, [panel.rom for panel in row.panels]),
            color=ROM_COLOUR,
            linewidth=1.4,
            solid_capstyle="round",
        )
        _points(axis, layout, row.panels, abscissa)
    else:
        axis.plot(
            *_joined(layout, abscissa, [panel.reference for panel in row.panels]),
            color=REFERENCE_COLOUR,
            linewidth=1.1,
        )
    marked = [
        (float(layout.place(column, at)), colour)
        for column, panel in enumerate(row.panels)
        for at, colour in panel.marked
    ]
    axis.add_collection(
        LineCollection(
            [[(at, limits[0]), (at, limits[1])] for at, _ in marked],
            colors=[colour for _, colour in marked],
            linewidths=0.9,
            linestyles=[_DASHES],
        ),
        autolim=False,
    )
    for column, panel in enumerate(row.panels):
        if panel.note:
            _note(axis, layout, column, panel.note, on_the_right=not panel.rom.size)
    axis.set_ylabel(row.quantity, fontsize=7.5, va="bottom")
    _row_label(axis, row.label)


def _joined(layout: Layout, abscissa: Floats, ordinates: Sequence[Floats]) -> tuple[Floats, Floats]:
    """Curves of all panels as one, with gaps between them: a line each would take long to draw."""
    gap = np.full(1, np.nan)
    x = [part for column in range(layout.count) for part in (layout.place(column, abscissa), gap)]
    return np.concatenate(x), np.concatenate([part for values in ordinates for part in (values, gap)])


def _points(axis: Axes, layout: Layout, panels: Sequence[Curves], abscissa: Floats) -> None:
    """Draw the reference, some points of a dense curve and all of one that states few."""
    dense = all(np.isfinite(panel.reference).all() for panel in panels)
    every = max(1, -(-abscissa.size // _MOST_MARKERS)) if dense else 1
    axis.plot(
        *_joined(layout, abscissa[::every], [panel.reference[::every] for panel in panels]),
        color=REFERENCE_COLOUR,
        linestyle="none",
        marker="o",
        markersize=1.7 if dense else 3.0,
        markeredgewidth=0,
    )


def _note(axis: Axes, layout: Layout, column: int, note: str, on_the_right: bool) -> None:
    axis.text(
        layout.lefts[column] + (0.97 if on_the_right else 0.04) * layout.width,
        0.05,
        note,
        transform=axis.get_xaxis_transform(),
        ha="right" if on_the_right else "left",
        fontsize=6.0,
        parse_math=False,
    )


def _differences(axis: Axes, layout: Layout, row: PanelRow, abscissa: Floats, marks: Sequence[float]) -> None:
    differences = [row.difference_factor * (panel.rom - panel.reference) for panel in row.panels]
    _ordinates(axis, layout, _limits([*differences, np.zeros(1)], from_zero=False), 3)
    axis.add_collection(
        LineCollection(
            [[(left, 0.0), (left + layout.width, 0.0)] for left in layout.lefts],
            colors="#555555",
            linewidths=0.5,
        ),
        autolim=False,
    )
    _background(axis, layout, row.panels, marks)
    single = not all(np.isfinite(values).all() for values in differences)  # no line between single values
    axis.plot(
        *_joined(layout, abscissa, differences),
        color=DIFFERENCE_COLOUR,
        linewidth=1.1,
        linestyle="none" if single else _DASHES,
        marker="o" if single else "none",
        markersize=2.2,
        markeredgewidth=0,
    )
    axis.set_ylabel(row.difference, fontsize=7.0, va="bottom")


def _background(axis: Axes, layout: Layout, panels: Sequence[Curves], marks: Sequence[float]) -> None:
    """Draw the tint of calcified cells, each panel's own axis, and the named instants."""
    transform = axis.get_xaxis_transform()
    for left, panel in zip(layout.lefts, panels, strict=True):
        if panel.calcified:
            axis.add_patch(
                Rectangle(
                    (left, 0), layout.width, 1, transform=transform, color=TINT, linewidth=0, zorder=0.2
                )
            )
    frames = [[(left, 1.0), (left, 0.0), (left + layout.width, 0.0)] for left in layout.lefts]
    axis.add_collection(
        LineCollection(frames, colors="#000000", linewidths=0.5, transform=transform), autolim=False
    )
    places = [float(layout.place(column, mark)) for column in range(layout.count) for mark in marks]
    lines = [[(place, 0.0), (place, 1.0)] for place in places]
    axis.add_collection(
        LineCollection(lines, colors=_MARK_COLOUR, linewidths=0.6, linestyles=":", transform=transform),
        autolim=False,
    )


def _abscissas(axis: Axes, layout: Layout) -> None:
    """Write numbers below the last row's panels."""
    ticks = _ticks(layout.low, layout.high, 3)
    words = [f"{tick:g}" for tick in ticks]
    places = [float(layout.place(column, tick)) for column in range(layout.count) for tick in ticks]
    axis.xaxis.set_visible(True)
    axis.set_xticks(places, words * layout.count)


def _ordinates(axis: Axes, layout: Layout, limits: tuple[float, float], most: int) -> None:
    """Give a row of panels its vertical axis: numbers at its left edge and lines across every panel."""
    ticks = _ticks(*limits, most)
    axis.set_ylim(*limits)
    axis.set_yticks(ticks)
    lines = [[(left, tick), (left + layout.width, tick)] for left in layout.lefts for tick in ticks]
    axis.add_collection(LineCollection(lines, colors="#d8d8d8", linewidths=0.4, zorder=0.5), autolim=False)


def _ticks(low: float, high: float, most: int) -> list[float]:
    return [float(tick) for tick in MaxNLocator(most).tick_values(low, high) if low <= tick <= high]


def _row_label(axis: Axes, label: str) -> None:
    axis.text(
        1.008,
        0.5,
        label,
        transform=axis.transAxes,
        rotation=-90,
        va="center",
        ha="left",
        fontsize=7.0,
        parse_math=False,
    )


def _limits(arrays: Sequence[Floats], from_zero: bool) -> tuple[float, float]:
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
