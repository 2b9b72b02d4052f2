"""Scales of colours for maps, and their bars on the sheet."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, Colormap, LinearSegmentedColormap, ListedColormap, Normalize
from matplotlib.image import AxesImage

from cases.arrays import Flags, Floats
from reports.figures.colours import HATCH, MISSING
from reports.figures.sheet import Panel, across_panels, frames, line, numerals, ticks, upright

BAR = 0.08  # inches; a bar's width
_BEYOND = 0.22  # of the limit: how far the bar reaches beyond it
_STEPS = ("#e3eef9", "#a9cdea", "#f7a04b", "#e0560a", "#7a2404")  # light inside, dark outside
_STEP_ENDS = (0.5, 1.0, 2.0, 5.0)  # of the limit


@dataclass(frozen=True, eq=False)
class Scale:
    """Colours of values.

    Attributes
    ----------
    norm, colours : Normalize, Colormap
        From values to shares to colours.
    ends : (float, float)
        Of the bar, as values.
    marks : sequence of (float, str), optional
        Places (values) and words beside the bar; by default round numbers.
    limit : float, optional
        Beyond ± this the colours are hatched.
    """

    norm: Normalize
    colours: Colormap
    ends: tuple[float, float]
    marks: tuple[tuple[float, str], ...] = ()
    limit: float | None = None


def scale_of(panels: Sequence[Floats], difference: bool, limits: tuple[float, float] | None = None) -> Scale:
    """Scale over all finite values (or given limits): perceptually uniform, or diverging around zero."""
    values = np.concatenate([np.empty(0), *(panel.ravel() for panel in panels)])
    values = values[np.isfinite(values)]
    low, high = limits or ((float(values.min()), float(values.max())) if values.size else (0.0, 1.0))
    if difference:
        high = max(abs(low), abs(high))
        low = -high
    if high - low <= 1e-9 * max(abs(low), abs(high)):  # mere round-off is not spread over all colours
        margin = 0.05 * abs(high) or 1.0
        low, high = low - margin, high + margin
    colours = colormaps["RdBu_r" if difference else "viridis"].with_extremes(bad=MISSING)
    return Scale(Normalize(low, high), colours, (low, high))


def within_limit(limit: float) -> Scale:
    """Scale centred on zero from −limit to +limit; what is beyond has two colours of its own, hatched."""
    inner = colormaps["RdBu_r"](np.linspace(0.2, 0.8, 64))
    colours = LinearSegmentedColormap.from_list("limit", inner, 256).with_extremes(
        under="#08306b", over="#7f0000", bad=MISSING
    )
    reach = (1 + _BEYOND) * limit
    marks = [(sign * limit, f"{'−+'[sign > 0]}{limit:g}") for sign in (-1, 1)]
    return Scale(Normalize(-limit, limit), colours, (-reach, reach), (marks[0], (0.0, "0"), marks[1]), limit)


def in_or_out() -> Scale:
    """Scale of an error over its limit, in five steps: two blue ones inside, three orange ones outside.

    The steps stand at the values 0.5, 1, 2 and 5, evenly along the bar.
    """
    colours = ListedColormap(_STEPS).with_extremes(bad=MISSING)
    # a step beyond both ends, so that every value has a colour of its step
    norm = BoundaryNorm((-np.inf, *_STEP_ENDS, np.inf), len(_STEPS))
    marks = tuple((k + 1.0, f"{end:g}") for k, end in enumerate(_STEP_ENDS))
    return Scale(norm, colours, (0.0, float(len(_STEPS))), marks)


def bar(axis: Axes, place: tuple[float, float, float], scale: Scale, label: str) -> None:
    """Draw the bar of a scale at (left, bottom, height), inches, with its numbers and label on the right."""
    left, bottom, height = place
    low, high = scale.ends
    panel = Panel(left, bottom, BAR, height, (0.0, 1.0), scale.ends)
    if isinstance(scale.norm, BoundaryNorm):
        values = np.array([0.0, *_STEP_ENDS]) + 1e-9
        cells(axis, panel, np.arange(2.0), np.linspace(low, high, values.size + 1), values[None], scale)
    else:
        values = np.linspace(low, high, 256)
        cells(axis, panel, np.arange(2.0), np.linspace(low, high, 257), values[None], scale)
        if scale.limit is not None:
            hatch(axis, panel, np.arange(2.0), np.linspace(low, high, 257), values[None], scale.limit)
    frames(axis, [panel], closed=True)
    numbers = ticks(low, high, 3)
    marks = scale.marks or tuple(zip(numbers, numerals(numbers), strict=True))
    beside = Panel(left + BAR, bottom, 0.03, height, (0.0, 1.0), scale.ends)
    across_panels(axis, [beside], [value for value, _ in marks], color="#000000", linewidth=0.5)
    for value, words in marks:
        axis.text(left + BAR + 0.05, float(panel.up(value)), words, va="center", fontsize=6.5)
    longest = max((len(words) for _, words in marks), default=0)
    upright(axis, left + BAR + 0.15 + 0.055 * longest, bottom + height / 2, label)


def cells(axis: Axes, panel: Panel, x: Floats, y: Floats, values: Floats, scale: Scale) -> None:
    """Draw values of shape (x, y) between the edges x, y as an image within the vectors."""
    image = axis.pcolorfast(
        panel.across(x), panel.up(y), np.ma.masked_invalid(values.T), norm=scale.norm, cmap=scale.colours
    )
    image.set_zorder(0.3)
    if isinstance(image, AxesImage):
        image.set_interpolation("none")  # a pixel a cell, whatever the drawing's size


def hatch(axis: Axes, panel: Panel, x: Floats, y: Floats, values: Floats, limit: float) -> None:
    """Hatch the cells beyond +limit upwards and those beyond −limit downwards, in white."""
    with np.errstate(invalid="ignore"):
        for inside, slope in ((values > limit, 1.0), (values < -limit, -1.0)):
            if inside.any():
                across, up = _strokes(panel, x, y, inside, slope)
                line(axis, across, up, color=HATCH, linewidth=0.45, zorder=0.4, solid_capstyle="butt")


def _strokes(panel: Panel, x: Floats, y: Floats, inside: Flags, slope: float) -> tuple[Floats, Floats]:
    """Parallel lines over a panel, only where they run through cells that are inside; inches."""
    spacing, fine = 0.055, 0.0125
    along = np.arange(panel.left, panel.left + panel.width, fine)
    starts = np.arange(-panel.width, panel.height + panel.width, spacing)
    across = np.broadcast_to(along, (starts.size, along.size))
    up = panel.bottom + starts[:, None] + slope * (across - panel.left)
    i = np.searchsorted(panel.across(x), across, side="right") - 1
    j = np.searchsorted(panel.up(y), up, side="right") - 1
    valid = (i >= 0) & (i < inside.shape[0]) & (j >= 0) & (j < inside.shape[1])
    shown = valid & inside[np.clip(i, 0, inside.shape[0] - 1), np.clip(j, 0, inside.shape[1] - 1)]
    shown = np.pad(shown, ((0, 0), (0, 1)))  # a gap between two strokes
    pad = np.pad(across, ((0, 0), (0, 1)), mode="edge"), np.pad(up, ((0, 0), (0, 1)), mode="edge")
    middle = shown & np.roll(shown, 1, axis=1) & np.roll(shown, -1, axis=1)
    kept = ~middle  # ends and gaps suffice
    return tuple(np.where(shown, values, np.nan)[kept] for values in pad)
