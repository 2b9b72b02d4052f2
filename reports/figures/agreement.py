"""Agreement of a reduced model with 3D over all cells and states: parity, and Bland and Altman's differences.

Values are counted in boxes of the plane: a hundred thousand points would say the same and take megabytes.
Bland and Altman, Lancet 327 (1986) 307, draw the difference of two methods over their mean, with the mean
difference (bias) and ± 1.96 standard deviations.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, Normalize

from cases.arrays import Floats
from reports.figures import sheet
from reports.figures.canvas import STYLE, WIDTH, svg_text
from reports.figures.colour_scale import Scale, bar, cells
from reports.figures.colours import LIMIT, QUIET, Dashes
from reports.figures.sheet import Panel

_LEFT, _RIGHT, _TOP, _BOTTOM = 0.70, 0.62, 0.46, 0.36
_HEIGHT, _GAP = 0.54, 0.33  # inches
_WORDS = 0.10  # inches; bias and scatter above the differences
_BOXES = (96, 56)
_SCATTER = 1.96  # standard deviations: 19 of 20 of normal values
BIAS = "#b8480b"
_SPREAD: Dashes = (0, (3.2, 1.4))
_DECADES = 4  # of the scale of counts; a box with more has its darkest colour
# The hue tells counts from each other and the brightness hardly: each is seen on white and on dark paper.
_COUNTS = LinearSegmentedColormap.from_list("counts", ["#5693cf", "#7a6fc4", "#b8306f"], 128)
_SCALE = Scale(
    Normalize(0, _DECADES),
    _COUNTS.with_extremes(bad=(0, 0, 0, 0)),
    (0, _DECADES),
    tuple((float(k), f"{10**k}") for k in range(_DECADES + 1)),
)


@dataclass(frozen=True)
class Agreement:
    """One quantity of one model in all variants.

    Attributes
    ----------
    symbol, unit : str
        As in ``"$P$"``, ``"kPa"``.
    reference, model : tuple of ndarray, each of any shape
        Values of 3D and of the model in display units, one array a variant; NaN is not stated.
    limit : float, optional
        Of the difference's size, in percent of 3D.
    """

    symbol: str
    unit: str
    reference: tuple[Floats, ...]
    model: tuple[Floats, ...]
    limit: float | None = None


def agreement(variants: Sequence[str], rows: Sequence[Agreement], model: str, reference: str = "3D") -> str:
    """Draw two rows of panels a quantity: 2D over 3D, and their difference in percent over their mean.

    Parameters
    ----------
    variants : sequence of str
        Headings of the columns.
    rows : sequence of Agreement
        From top to bottom; all panels of a row have one scale.
    model, reference : str
        Names.

    Returns
    -------
    str
        SVG; the same text for the same input.
    """
    with style.context(STYLE):
        both = 2 * (_HEIGHT + _GAP) + _WORDS
        total = _TOP + both * len(rows) - _GAP + _BOTTOM
        figure, axis = sheet.sheet(total)
        bottom = total - _TOP - _HEIGHT
        for number, row in enumerate(rows):
            pairs = [_stated(*pair) for pair in zip(row.reference, row.model, strict=True)]
            upper = _parity(axis, row, pairs, bottom, (reference, model))
            lower = _differences(axis, row, pairs, bottom - both / 2 - _WORDS / 2, (reference, model))
            if number == 0:
                sheet.headings(axis, upper, variants)
                right, foot = WIDTH - _RIGHT + 0.06, lower[0].bottom
                bar(axis, (right, foot, upper[0].top - foot), _SCALE, "cells × states per box")
            bottom -= both
        keys = [
            sheet.Key("equal", QUIET, "-"),
            sheet.Key("bias", BIAS, "-"),
            sheet.Key(f"bias ± {_SCATTER} standard deviations", BIAS, _SPREAD),
        ]
        if any(row.limit is not None for row in rows):
            keys.append(sheet.Key("within the limit", fill=LIMIT))
        sheet.legend(axis, keys, _LEFT, total - 0.12)
        return svg_text(figure)


def _stated(reference: Floats, model: Floats) -> tuple[Floats, Floats]:
    """Values that both state, flat; none at which 3D is zero, for there is no percentage of it."""
    three, two = reference.ravel(), model.ravel()
    known = np.isfinite(three) & np.isfinite(two) & (three != 0)
    return (three, two) if known.all() else (three[known], two[known])


def _row(count: int, bottom: float, x: tuple[float, float], y: tuple[float, float]) -> list[Panel]:
    return sheet.in_a_row(count, (bottom, _HEIGHT), (_LEFT, WIDTH - _RIGHT), x, y)


def _parity(
    axis: Axes,
    row: Agreement,
    pairs: Sequence[tuple[Floats, Floats]],
    bottom: float,
    names: tuple[str, str],
) -> list[Panel]:
    """Draw 2D over 3D."""
    ends = sheet.limits([values for pair in pairs for values in pair], 0.03)
    panels = _row(len(pairs), bottom, ends, ends)
    line = np.linspace(*ends, 60)
    if row.limit is not None:
        share = row.limit / 100
        sides = np.clip([line - share * abs(line), line + share * abs(line)], *ends)
        for panel in panels:
            across = panel.across(np.concatenate([line, line[::-1]]))
            up = panel.up(np.concatenate([sides[0], sides[1][::-1]]))
            axis.fill(across, up, facecolor=LIMIT, linewidth=0, zorder=0.2)
    for panel, pair in zip(panels, pairs, strict=True):
        _boxes(axis, panel, *pair)
    diagonal = [np.array(ends)] * len(panels)
    sheet.curves(axis, panels, diagonal, diagonal, color=QUIET, linewidth=0.6)
    reference, model = names
    sheet.ordinates(axis, panels, f"{row.symbol} {model}\n({row.unit})", 3)
    sheet.abscissas(axis, panels, f"{row.symbol} {reference} ({row.unit})")
    sheet.frames(axis, panels)
    return panels


def _differences(
    axis: Axes,
    row: Agreement,
    pairs: Sequence[tuple[Floats, Floats]],
    bottom: float,
    names: tuple[str, str],
) -> list[Panel]:
    """Draw the differences in percent of 3D over the mean of both models."""
    reference, model = names
    apart = [100 * (two - three) / np.abs(three) for three, two in pairs]
    means = [(three + two) / 2 for three, two in pairs]
    limit = [] if row.limit is None else [np.array([-row.limit, row.limit])]
    shown = sheet.limits([np.zeros(1), *apart, *limit], 0.05)
    panels = _row(len(pairs), bottom, sheet.limits(means, 0.03), shown)
    if row.limit is not None:
        sheet.band(axis, panels, -row.limit, row.limit, LIMIT)
    sheet.across_panels(axis, panels, [0.0], color=QUIET, linewidth=0.6)
    for panel, mean, difference in zip(panels, means, apart, strict=True):
        if not difference.size:
            continue
        _boxes(axis, panel, mean, difference)
        bias, spread = float(difference.mean()), _SCATTER * float(difference.std())
        sheet.across_panels(axis, [panel], [bias], color=BIAS, linewidth=1.0, zorder=2.5)
        for end in (bias - spread, bias + spread):
            sheet.across_panels(
                axis, [panel], [end], color=BIAS, linewidth=0.8, linestyle=_SPREAD, zorder=2.5
            )
        words = f"{bias:+.2f} ± {spread:.2f} %".replace("-", "\N{MINUS SIGN}")
        place = panel.left + panel.width, panel.top + 0.02
        axis.text(*place, words, ha="right", va="bottom", fontsize=sheet.SMALL, color=BIAS)
    sheet.ordinates(axis, panels, f"{model} − {reference}\n(% of {reference})", 3)
    sheet.abscissas(axis, panels, f"mean of both {row.symbol} ({row.unit})")
    sheet.frames(axis, panels)
    return panels


def _boxes(axis: Axes, panel: Panel, x: Floats, y: Floats) -> None:
    """Fill the boxes of a panel by how many points they hold; all points are in it."""
    edges = np.linspace(*panel.x, _BOXES[0] + 1), np.linspace(*panel.y, _BOXES[1] + 1)
    across, up = (
        ((values - ends[0]) * (count / (ends[-1] - ends[0]))).astype(np.intp)
        for values, ends, count in zip((x, y), edges, _BOXES, strict=True)
    )
    counts = np.bincount(across * _BOXES[1] + up, minlength=_BOXES[0] * _BOXES[1]).reshape(_BOXES)
    with np.errstate(divide="ignore"):
        cells(axis, panel, *edges, np.where(counts, np.log10(counts), np.nan), _SCALE)
