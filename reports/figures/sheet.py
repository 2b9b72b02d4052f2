"""A sheet of paper in inches on which panels stand: one Axes a figure, for one a panel takes long to draw.

A panel is a rectangle of the sheet that maps its data's coordinates to inches. What many panels share (a
curve of each, their frames, their grid) is one artist with gaps.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator

from cases.arrays import Floats
from reports.figures.canvas import WIDTH
from reports.figures.colours import GRID, MODELS, QUIET, REFERENCE, Dashes

LABEL_SIZE, SMALL = 7.5, 6.5  # points
_LETTER = 0.056  # inches; the mean width of a letter of a legend
_KEY = 0.26  # inches; the length of a legend's line


@dataclass(frozen=True)
class Panel:
    """A rectangle of the sheet.

    Attributes
    ----------
    left, bottom, width, height : float
        Its place, inches.
    x, y : (float, float)
        What its edges mean.
    """

    left: float
    bottom: float
    width: float
    height: float
    x: tuple[float, float]
    y: tuple[float, float]

    @property
    def top(self) -> float:
        """Of the panel, inches."""
        return self.bottom + self.height

    def across(self, x: Floats | float) -> Floats:
        """Inches from the sheet's left edge."""
        return np.asarray(self.left + self.width * (np.asarray(x) - self.x[0]) / (self.x[1] - self.x[0]))

    def up(self, y: Floats | float) -> Floats:
        """Inches from the sheet's lower edge."""
        return np.asarray(self.bottom + self.height * (np.asarray(y) - self.y[0]) / (self.y[1] - self.y[0]))


@dataclass(frozen=True)
class Key:
    """An entry of a legend: a point, a line, or a filled box where ``fill`` is given."""

    words: str
    colour: str = QUIET
    dashes: Dashes | None = None
    fill: str = ""


def sheet(height: float) -> tuple[Figure, Axes]:
    """Return a figure of the text's width and this height (inches), with an Axes in inches that covers it."""
    figure = Figure(figsize=(WIDTH, height))
    axis = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axis.set_axis_off()
    axis.set_xlim(0.0, WIDTH)
    axis.set_ylim(0.0, height)
    axis.set_autoscale_on(False)
    return figure, axis


def in_a_row(
    count: int,
    place: tuple[float, float],
    across: tuple[float, float],
    x: tuple[float, float],
    y: tuple[float, float],
    gap: float = 0.12,
) -> list[Panel]:
    """Panels side by side with common limits.

    Parameters
    ----------
    count : int
    place : (float, float)
        Bottom and height, inches.
    across : (float, float)
        Left edge of the first and right edge of the last, inches.
    x, y : (float, float)
        Limits of each.
    gap : float
        Between two, inches.
    """
    width = (across[1] - across[0] - gap * (count - 1)) / count
    return [Panel(across[0] + k * (width + gap), place[0], width, place[1], x, y) for k in range(count)]


def line(axis: Axes, x: Floats | Sequence[float], y: Floats | Sequence[float], **style: Any) -> None:
    """Draw one line in inches: what ``Axes.plot`` does, without its search for units and limits."""
    axis.add_artist(Line2D(x, y, **style))


def curves(
    axis: Axes, panels: Sequence[Panel], x: Sequence[Floats], y: Sequence[Floats], **style: Any
) -> None:
    """Draw a curve in each panel as one line with gaps; NaN is no point of it."""
    gap = np.full(1, np.nan)
    pieces = list(zip(panels, x, y, strict=True))
    line(
        axis,
        np.concatenate([part for panel, at, _ in pieces for part in (panel.across(at), gap)]),
        np.concatenate([part for panel, _, to in pieces for part in (panel.up(to), gap)]),
        **style,
    )


def model_curves(
    axis: Axes, panels: Sequence[Panel], x: Sequence[Floats], models: Sequence[Sequence[Floats]]
) -> None:
    """Draw the curves of the reduced models, (model, panel, ...), in the models' strokes."""
    for stroke, ordinates in zip(MODELS, models, strict=False):
        curves(axis, panels, x, ordinates, color=stroke.colour, linestyle=stroke.dashes, linewidth=1.3)


def reference_points(
    axis: Axes, panels: Sequence[Panel], x: Sequence[Floats], y: Sequence[Floats], most: int = 45
) -> None:
    """Draw the reference as points: some of a dense curve, all of one that states few."""
    dense = all(bool(np.isfinite(values).all()) for values in y)
    every = max(1, -(-max((values.size for values in y), default=1) // most)) if dense else 1
    curves(
        axis,
        panels,
        [values[::every] for values in x],
        [values[::every] for values in y],
        color=REFERENCE,
        linestyle="none",
        marker="o",
        markersize=1.8 if dense else 3.0,
        markeredgewidth=0,
        zorder=2.5,
    )


def segments(axis: Axes, lines: Sequence[Sequence[tuple[float, float]]], **style: Any) -> None:
    """Draw lines through points (inches), each at least two, as one artist."""
    points = np.array([point for line in lines for point in (*line, (np.nan, np.nan))]).reshape(-1, 2)
    line(axis, *points.T, **{"solid_capstyle": "projecting", **style})


def frames(axis: Axes, panels: Sequence[Panel], closed: bool = False) -> None:
    """Draw the left and lower edge of each panel, or all four."""
    corners = [
        [(p.left, p.top), (p.left, p.bottom), (p.left + p.width, p.bottom)]
        + ([(p.left + p.width, p.top), (p.left, p.top)] if closed else [])
        for p in panels
    ]
    segments(axis, corners, color="#000000", linewidth=0.5, zorder=3)


def across_panels(axis: Axes, panels: Sequence[Panel], ordinates: Sequence[float], **style: Any) -> None:
    """Draw horizontal lines through every panel that has these ordinates."""
    lines = [
        [(p.left, float(p.up(y))), (p.left + p.width, float(p.up(y)))]
        for p in panels
        for y in ordinates
        if p.y[0] <= y <= p.y[1]
    ]
    plain = {"color": GRID, "linewidth": 0.4, "zorder": 0.5, "solid_capstyle": "butt"}
    segments(axis, lines, **{**plain, **style})


def up_panels(axis: Axes, panels: Sequence[Panel], abscissas: Sequence[float], **style: Any) -> None:
    """Draw vertical lines through every panel."""
    lines = [[(float(p.across(x)), p.bottom), (float(p.across(x)), p.top)] for p in panels for x in abscissas]
    segments(axis, lines, **{"color": QUIET, "linewidth": 0.6, "linestyle": ":", "zorder": 1, **style})


def boxes(axis: Axes, corners: Sequence[tuple[float, float, float, float]], colour: str) -> None:
    """Fill rectangles (left, right, bottom, top; inches) behind everything else."""
    if corners:
        axis.add_collection(
            PolyCollection(
                [[(a, c), (b, c), (b, d), (a, d)] for a, b, c, d in corners],
                facecolors=colour,
                linewidths=0,
                zorder=0.2,
            ),
            autolim=False,
        )


def band(axis: Axes, panels: Sequence[Panel], low: float, high: float, colour: str) -> None:
    """Fill each panel between two ordinates, cut where the panel ends."""
    boxes(
        axis,
        [
            (p.left, p.left + p.width, float(p.up(max(low, p.y[0]))), float(p.up(min(high, p.y[1]))))
            for p in panels
        ],
        colour,
    )


def ordinates(
    axis: Axes,
    panels: Sequence[Panel],
    label: str,
    most: int | Sequence[float] = 4,
    grid: bool = True,
    aside: float = 0.48,
) -> None:
    """Write numbers and a label left of the first panel, and draw lines through all at the numbers.

    ``most`` is their largest count, or the numbers themselves; those outside the panel are left out. The
    label stands ``aside`` (inches) or farther where the numbers are long.
    """
    first = panels[0]
    low, high = first.y
    marks = ticks(low, high, most) if isinstance(most, int) else [m for m in most if low <= m <= high]
    if grid:
        across_panels(axis, panels, marks)
    numbers = numerals(marks)
    aside = min(max(aside, 0.19 + _LETTER * max(map(len, numbers), default=0)), first.left - 0.08)
    for tick, words in zip(marks, numbers, strict=True):
        axis.text(first.left - 0.05, float(first.up(tick)), words, ha="right", va="center", fontsize=SMALL)
    upright(axis, first.left - aside, first.bottom + first.height / 2, label)


def upright(axis: Axes, across: float, up: float, label: str) -> None:
    """Write a label that is read from below, centred at a place (inches)."""
    style: dict[str, Any] = {"rotation": 90, "ha": "center", "va": "center"}
    axis.text(across, up, label, fontsize=LABEL_SIZE, linespacing=1.1, **style)


def abscissas(
    axis: Axes, panels: Sequence[Panel], label: str, marks: Sequence[float] | None = None, most: int = 3
) -> None:
    """Write numbers below every panel, and one label below all."""
    for panel in panels:
        shown = ticks(*panel.x, most) if marks is None else marks
        for tick, words in zip(shown, numerals(shown), strict=True):
            axis.text(
                float(panel.across(tick)), panel.bottom - 0.05, words, ha="center", va="top", fontsize=SMALL
            )
        up_panels(
            axis,
            [Panel(panel.left, panel.bottom - 0.03, panel.width, 0.03, panel.x, (0.0, 1.0))],
            shown,
            color="#000000",
            linestyle="-",
        )
    middle = (panels[0].left + panels[-1].left + panels[-1].width) / 2
    axis.text(middle, panels[0].bottom - 0.17, label, ha="center", va="top", fontsize=LABEL_SIZE)


def headings(axis: Axes, panels: Sequence[Panel], words: Sequence[str]) -> None:
    """Write a heading above each panel."""
    for panel, text in zip(panels, words, strict=True):
        axis.text(
            panel.left + panel.width / 2,
            panel.top + 0.06,
            text,
            ha="center",
            va="bottom",
            fontsize=LABEL_SIZE,
            parse_math=False,
        )


def corner(axis: Axes, panel: Panel, words: str) -> None:
    """Write words into the upper left corner of a panel, on white."""
    pad = {"facecolor": "#ffffff", "alpha": 0.85, "linewidth": 0, "pad": 1.0}
    place = panel.left + 0.05, panel.top - 0.05
    axis.text(*place, words, ha="left", va="top", fontsize=SMALL, zorder=4, bbox=pad, parse_math=False)


def models_keys(reference: str, models: Sequence[str]) -> Iterator[Key]:
    """Entries of a legend for the reference and the reduced models."""
    yield Key(reference, REFERENCE)
    for stroke, name in zip(MODELS, models, strict=False):
        yield Key(name, stroke.colour, stroke.dashes)


def legend(axis: Axes, keys: Sequence[Key], left: float, up: float) -> None:
    """Write a legend in one line from ``left`` on, at the height ``up`` (inches), smaller if it is long."""
    wanted = sum(_KEY + 0.19 + _LETTER * len(key.words) for key in keys)
    small = min(1.0, (WIDTH - left) / max(wanted, _KEY))
    for key in keys:
        if key.fill:
            box = Rectangle((left, up - 0.045), 0.18, 0.09, facecolor=key.fill, edgecolor=key.colour)
            box.set(linewidth=0.5)
            axis.add_patch(box)
        elif key.dashes is None:
            line(
                axis, [left + _KEY / 2], [up], color=key.colour, marker="o", markersize=3.0, markeredgewidth=0
            )
        else:
            line(axis, [left, left + _KEY], [up, up], color=key.colour, linestyle=key.dashes, linewidth=1.3)
        left += (0.18 if key.fill else _KEY) + 0.05
        axis.text(left, up, key.words, ha="left", va="center", fontsize=7.0 * small, parse_math=False)
        left += small * (_LETTER * len(key.words) + 0.14)


def ticks(low: float, high: float, most: int) -> list[float]:
    """At most ``most`` + 1 round numbers between two."""
    margin = 1e-9 * (high - low)
    return [
        float(tick)
        for tick in MaxNLocator(most).tick_values(low, high)
        if low - margin <= tick <= high + margin
    ]


def numerals(marks: Sequence[float]) -> list[str]:
    """Numbers with equal decimals, as few as tell them apart."""
    decimals = next(
        (
            n
            for n in range(9)
            if all(abs(tick - round(tick, n)) <= 1e-9 * max(1e-9, abs(tick)) + 1e-12 for tick in marks)
        ),
        9,
    )
    return [f"{tick + 0.0:.{decimals}f}".replace("-", "\N{MINUS SIGN}") for tick in marks]


def limits(arrays: Sequence[Floats], margin: float = 0.06) -> tuple[float, float]:
    """Range of all finite values with a margin; never empty."""
    known = [array[np.isfinite(array)] for array in arrays]
    ends = [(float(values.min()), float(values.max())) for values in known if values.size]
    if not ends:
        return 0.0, 1.0
    low, high = min(first for first, _ in ends), max(last for _, last in ends)
    span = high - low if high - low > 1e-9 * max(abs(low), abs(high)) else 0.0  # not what is mere round-off
    added = margin * span or 0.05 * abs(high) or 1.0
    return low - added, high + added
