"""Sobol indices with their intervals as bars."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib import style
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from cases.arrays import Floats
from reports.figures.canvas import STYLE, WIDTH, svg_text
from reports.figures.colours import MODELS
from reports.sweep.scatter import bare, wrapped

_BAR_COLOURS = (MODELS[0].colour, "#e69f00")


@dataclass(frozen=True)
class Bars:
    """Indices of one output: first order and total, a value and half an interval for each parameter."""

    title: str
    first: Floats
    first_half: Floats
    total: Floats
    total_half: Floats


def index_bars(names: Sequence[str], panels: Sequence[Bars]) -> str:
    """Draw Sobol indices with their intervals, a panel an output, a pair of bars a parameter."""
    with style.context(STYLE):
        across = 2
        lines = -(-len(panels) // across)
        height = 0.30 + 0.30 * len(names)
        gap, left, row_gap = 0.25, 1.75, 0.55
        total = 0.62 + 0.40 + lines * height + (lines - 1) * row_gap
        figure = Figure(figsize=(WIDTH, total))
        width = (WIDTH - left - 0.1 - gap * (across - 1)) / across
        places = np.arange(len(names), dtype=float)
        for number, panel in enumerate(panels):
            line, column = divmod(number, across)
            bottom = total - 0.62 - (line + 1) * height - line * row_gap
            axis = figure.add_axes(
                ((left + column * (width + gap)) / WIDTH, bottom / total, width / WIDTH, height / total)
            )
            bare(axis)
            for shift, colour, hatch, values, halves in (
                (-0.19, _BAR_COLOURS[0], "", panel.first, panel.first_half),
                (0.19, _BAR_COLOURS[1], "////", panel.total, panel.total_half),
            ):
                axis.barh(
                    places + shift,
                    values,
                    height=0.36,
                    color=colour,
                    edgecolor="#1a1a1a",
                    linewidth=0.4,
                    hatch=hatch,
                    xerr=halves,
                    error_kw={"elinewidth": 0.8, "capsize": 1.6},
                )
            axis.set_xlim(min(0.0, _least(panel)), max(1.0, _most(panel)))
            axis.invert_yaxis()
            axis.set_yticks(
                places, [wrapped(name, 1.6) for name in names] if column == 0 else [""] * len(names)
            )
            axis.set_title(wrapped(panel.title, width), fontsize=7.0, pad=2.5)
            axis.set_xlabel("Sobol index (–)" if line == lines - 1 else "", fontsize=7.0)
        _index_legend(figure)
        return svg_text(figure)


def _least(panel: Bars) -> float:
    return float(np.nanmin([panel.first - panel.first_half, panel.total - panel.total_half], initial=0.0))


def _most(panel: Bars) -> float:
    return float(np.nanmax([panel.first + panel.first_half, panel.total + panel.total_half], initial=0.0))


def _index_legend(figure: Figure) -> None:
    handles = [
        Line2D([], [], color=colour, linewidth=4.0, label=words)
        for colour, words in zip(_BAR_COLOURS, ("first order S1", "total ST (hatched)"), strict=True)
    ]
    figure.legend(handles=handles, loc="upper left", ncols=2, frameon=False, fontsize=7.5, borderaxespad=0.3)
