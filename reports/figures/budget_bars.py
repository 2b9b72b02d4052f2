"""Parts of an error as bars, a group a variant, with the interval that holds the model's error."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib import style
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from reports.figures.canvas import STYLE, WIDTH, legend_above, svg_text

_COLOURS = ("#1a1a1a", "#b8480b", "#0072b2", "#e69f00", "#cc79a7", "#009e73")
_LEFT, _RIGHT, _TOP, _BOTTOM = 1.2, 0.2, 0.32, 0.40
_BAR, _BAR_OF_MANY, _MANY, _GAP = 0.12, 0.065, 4, 0.12  # inches


@dataclass(frozen=True)
class BudgetBars:
    """Bars of one variant, in percent; NaN for a part that is not known.

    Attributes
    ----------
    name : str
    parts : tuple of float
        From top to bottom.
    model : tuple of float
        Least and largest error of the model.
    """

    name: str
    parts: tuple[float, ...]
    model: tuple[float, float]


def budget_bars(words: Sequence[str], variants: Sequence[BudgetBars]) -> str:
    """Draw the bars; ``words`` name the parts. The interval stands below the bars of its variant."""
    with style.context(STYLE):
        count = len(words) + 1
        bar = _BAR if len(variants) < _MANY else _BAR_OF_MANY
        group = count * bar + _GAP
        height = _TOP + len(variants) * group + _BOTTOM
        figure = Figure(figsize=(WIDTH, height))
        FigureCanvasSVG(figure)
        axis = figure.add_axes(
            (
                _LEFT / WIDTH,
                _BOTTOM / height,
                (WIDTH - _LEFT - _RIGHT) / WIDTH,
                len(variants) * group / height,
            )
        )
        for number, variant in enumerate(variants):
            places = number * group + bar * (np.arange(count) + 0.5)
            colours = _COLOURS[: len(words)]
            axis.barh(places[:-1], np.nan_to_num(variant.parts), height=0.9 * bar, color=colours)
            low, high = variant.model
            axis.plot([low, high], [places[-1]] * 2, "|-", color=_COLOURS[0], linewidth=1.2, markersize=5.0)
        axis.set_ylim(len(variants) * group, 0.0)
        axis.set_xlim(left=0.0)
        axis.set_yticks(
            [number * group + 0.5 * count * bar for number in range(len(variants))],
            [variant.name for variant in variants],
        )
        axis.spines[["top", "right"]].set_visible(False)
        axis.set_xlabel("share of the 3D value (%); line: interval in which the error of the model lies")
        handles = [Patch(facecolor=colour, label=text) for colour, text in zip(_COLOURS, words, strict=False)]
        legend_above(figure, handles, 0.05)
        return svg_text(figure)
