"""Samples of a sweep as points over its parameters, those that fail a band as crosses."""

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib import colormaps, style
from matplotlib.axes import Axes
from matplotlib.colors import Colormap, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from cases.arrays import Flags, Floats
from reports.figures.canvas import STYLE, WIDTH, legend_above, svg_text
from reports.figures.colours import BEYOND, MODELS, REFERENCE
from reports.figures.lumen_cells import edges_of
from reports.sweep.amounts import steady

_LEFT, _RIGHT, _TOP, _BOTTOM = 0.98, 0.10, 0.30, 0.62
_GAP, _ROW_GAP = 0.12, 0.16
_HEIGHT = 1.02
_LETTERS = 17.0  # an inch of a label of 7 points
_STEADY_HALF = 0.05  # of a value that hardly varies, shown on either side of it
_MANY = 200  # points that are drawn as an image
_NEIGHBOURS, _MOST_GROUPS = 8, 12  # samples of a mean; means of a curve


@dataclass(frozen=True)
class Abscissa:
    """A parameter's axis: its label, its values at the samples, whether it is logarithmic."""

    label: str
    values: Floats
    logarithmic: bool = False


@dataclass(frozen=True)
class Ordinate:
    """An output's axis: label, values at the samples, limit of its band (NaN: none), which are within it."""

    label: str
    values: Floats
    limit: float
    ok: Flags


def responses(columns: Sequence[Abscissa], rows: Sequence[Ordinate]) -> str:
    """Draw each output (a row) over each parameter (a column), with the mean over neighbours as a line.

    Returns
    -------
    str
        SVG; the same text for the same input.
    """
    with style.context(STYLE):
        total = _TOP + _BOTTOM + _HEIGHT * len(rows) + _ROW_GAP * (len(rows) - 1)
        figure = Figure(figsize=(WIDTH, total))
        width = (WIDTH - _LEFT - _RIGHT - _GAP * (len(columns) - 1)) / len(columns)
        for number, row in enumerate(rows):
            bottom = total - _TOP - (number + 1) * _HEIGHT - number * _ROW_GAP
            for place, column in enumerate(columns):
                left = _LEFT + place * (width + _GAP)
                axis = figure.add_axes((left / WIDTH, bottom / total, width / WIDTH, _HEIGHT / total))
                _response(axis, column, row)
                axis.tick_params(labelleft=place == 0, labelbottom=number == len(rows) - 1)
                if place == 0:
                    axis.set_ylabel(wrapped(row.label, _HEIGHT), fontsize=6.5)
                if number == len(rows) - 1:
                    axis.set_xlabel(wrapped(column.label, width), fontsize=7.0)
        _legend(figure, any(np.isfinite(row.limit) for row in rows))
        return svg_text(figure)


def _response(axis: Axes, column: Abscissa, row: Ordinate) -> None:
    bare(axis)
    _scales(axis, column)
    many = row.values.size > _MANY
    for which, marker, colour in ((row.ok, "o", MODELS[0].colour), (~row.ok, "x", BEYOND)):
        axis.plot(
            column.values[which],
            row.values[which],
            linestyle="none",
            marker=marker,
            markersize=1.6 if many else 2.6,
            markeredgewidth=0.0 if marker == "o" else 0.6,
            color=colour,
            alpha=0.6,
            rasterized=many,
        )
    axis.plot(*means(column.values, row.values), color=REFERENCE, linewidth=0.9)
    for limit in _limits(row):
        axis.axhline(limit, color=REFERENCE, linewidth=0.7, linestyle=(0, (4, 2)))
    known = row.values[np.isfinite(row.values)]
    if known.size and steady(float(known.min()), float(known.max())) and known.any():
        half = _STEADY_HALF * float(np.abs(known).max())  # a line, not a magnified rounding error
        axis.set_ylim(float(known.mean()) - half, float(known.mean()) + half)
    axis.yaxis.set_major_locator(MaxNLocator(4))
    if not column.logarithmic:
        axis.xaxis.set_major_locator(MaxNLocator(4))


def _limits(row: Ordinate) -> list[float]:
    """Where a limit on the size is met: below zero too where there are values."""
    if not np.isfinite(row.limit):
        return []
    return [-row.limit, row.limit] if np.nanmin(row.values) < 0 else [row.limit]


def means(abscissas: Floats, ordinates: Floats) -> tuple[Floats, Floats]:
    """Mean over samples with one abscissa, or where these are many over groups of neighbours."""
    most = min(_MOST_GROUPS, max(3, abscissas.size // _NEIGHBOURS))
    known = np.isfinite(ordinates)
    x, y = abscissas[known], ordinates[known]
    values = np.unique(x)
    if values.size <= _MOST_GROUPS and values.size < x.size:
        return values, np.array([y[x == value].mean() for value in values])
    order = np.argsort(x, kind="stable")
    parts = np.array_split(order, min(most, order.size)) if order.size else []
    return np.array([x[part].mean() for part in parts]), np.array([y[part].mean() for part in parts])


@dataclass(frozen=True)
class Plane:
    """Samples over two parameters; `cells` where they fill a grid."""

    across: Abscissa
    up: Abscissa
    cells: bool


def planes(pairs: Sequence[Plane], row: Ordinate) -> str:
    """Draw where a band holds: colour is the output, crosses are samples beyond the limit."""
    with style.context(STYLE):
        height, bar, right = 1.75, 0.09, 0.75
        total = _TOP + _BOTTOM + height
        figure = Figure(figsize=(WIDTH, total))
        gap = 0.75
        room = WIDTH - _LEFT - right - gap * (len(pairs) - 1)
        width = min(room / len(pairs), 3.4)
        norm = _norm(row.values)
        for place, pair in enumerate(pairs):
            left = _LEFT + place * (width + gap)
            axis = figure.add_axes((left / WIDTH, _BOTTOM / total, width / WIDTH, height / total))
            _plane(axis, pair, row, norm)
            axis.set_xlabel(wrapped(pair.across.label, width), fontsize=7.0)
            axis.set_ylabel(wrapped(pair.up.label, height), fontsize=7.0)
        left = _LEFT + len(pairs) * width + (len(pairs) - 1) * gap + 0.08
        scale = figure.add_axes((left / WIDTH, _BOTTOM / total, bar / WIDTH, height / total))
        _bar(scale, norm, row)
        handles = [
            Line2D([], [], **_marker("o", "#ffffff"), label="band holds"),
            Line2D([], [], **_marker("X", "#ffffff"), label="beyond the limit"),
        ]
        legend_above(figure, handles, _LEFT)
        return svg_text(figure)


def _plane(axis: Axes, pair: Plane, row: Ordinate, norm: Normalize) -> None:
    axis.set_xscale("log" if pair.across.logarithmic else "linear")
    axis.set_yscale("log" if pair.up.logarithmic else "linear")
    x, y = pair.across.values, pair.up.values
    if pair.cells:
        _cells(axis, pair, row, norm)
    many = x.size > _MANY
    for which, marker in ((row.ok, "o"), (~row.ok, "X")):
        axis.scatter(
            x[which],
            y[which],
            c=row.values[which],
            norm=norm,
            cmap="viridis",
            marker=marker,
            s=10.0 if many else 18.0,
            edgecolors="#000000",
            linewidths=0.35,
            rasterized=many,
            zorder=3,
        )
    for axes, logarithmic in ((axis.xaxis, pair.across.logarithmic), (axis.yaxis, pair.up.logarithmic)):
        if not logarithmic:
            axes.set_major_locator(MaxNLocator(5))


def _cells(axis: Axes, pair: Plane, row: Ordinate, norm: Normalize) -> None:
    """Colour the grid's cells and draw the line where the output meets the limit."""
    x, y = np.unique(pair.across.values), np.unique(pair.up.values)
    values = np.full((y.size, x.size), np.nan)
    values[np.searchsorted(y, pair.up.values), np.searchsorted(x, pair.across.values)] = row.values
    axis.pcolormesh(
        _edges(x, pair.across.logarithmic),
        _edges(y, pair.up.logarithmic),
        np.ma.masked_invalid(values),
        norm=norm,
        cmap="viridis",
        alpha=0.75,
        rasterized=True,
    )
    levels = [limit for limit in _limits(row) if np.nanmin(values) < limit < np.nanmax(values)]
    if levels and np.isfinite(values).all() and min(values.shape) > 1:
        for colour, width in (("#ffffff", 2.2), ("#000000", 1.0)):
            axis.contour(x, y, values, levels=levels, colors=colour, linewidths=width, linestyles="solid")


def _edges(centres: Floats, logarithmic: bool) -> Floats:
    return np.exp(edges_of(np.log(centres))) if logarithmic else edges_of(centres)


def _norm(values: Floats) -> Normalize:
    low, high = float(np.min(values)), float(np.max(values))
    if high - low <= 1e-9 * max(abs(low), abs(high)):
        low, high = low - (0.05 * abs(low) or 1.0), high + (0.05 * abs(high) or 1.0)
    return Normalize(low, high)


def _fill(bar: Axes, norm: Normalize, colours: Colormap) -> None:
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


def _bar(axis: Axes, norm: Normalize, row: Ordinate) -> None:
    low, high = float(norm.vmin or 0.0), float(norm.vmax or 0.0)
    _fill(axis, norm, colormaps["viridis"])
    axis.yaxis.set_major_locator(MaxNLocator(5))
    axis.set_ylabel(wrapped(row.label, 1.75), fontsize=7.0)
    for limit in _limits(row):
        if low <= limit <= high:
            for colour, width in (("#ffffff", 2.4), ("#000000", 1.0)):
                axis.axhline(limit, color=colour, linewidth=width)


def _legend(figure: Figure, judged: bool) -> None:
    handles = [
        Line2D(
            [], [], **_marker("o", MODELS[0].colour), label="sample" + (", within its band" if judged else "")
        ),
        Line2D([], [], color=REFERENCE, linewidth=0.9, label="mean of neighbours"),
    ]
    if judged:
        handles[1:1] = [
            Line2D([], [], linestyle="none", marker="x", color=BEYOND, markersize=4.0, label="beyond")
        ]
        handles.append(Line2D([], [], color=REFERENCE, linewidth=0.7, linestyle=(0, (4, 2)), label="limit"))
    legend_above(figure, handles, _LEFT)


def _marker(marker: str, colour: str) -> dict[str, Any]:
    return {
        "linestyle": "none",
        "marker": marker,
        "color": colour,
        "markeredgecolor": "#000000",
        "markeredgewidth": 0.4,
        "markersize": 4.0,
    }


def bare(axis: Axes) -> None:
    """Leave an axis a grid and two spines."""
    axis.spines[["top", "right"]].set_visible(False)
    axis.grid(color="#d8d8d8", linewidth=0.4)
    axis.set_axisbelow(True)


def _scales(axis: Axes, column: Abscissa) -> None:
    axis.set_xscale("log" if column.logarithmic else "linear")


def wrapped(label: str, inches: float) -> str:
    """Break a label into lines of so many inches."""
    return "\n".join(textwrap.wrap(label, max(10, int(_LETTERS * inches)), break_long_words=False))
