"""The artery from the side, to scale: inlet, outlet, calcification, and where the numbered places are."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.patches import Ellipse

from cases.arrays import Flags, Floats
from reports.figures import sheet
from reports.figures.canvas import STYLE, WIDTH, svg_text
from reports.figures.colours import QUIET, REFERENCE
from reports.figures.lumen_cells import cell_borders, edges_of, runs
from reports.figures.sheet import Panel

_LEFT, _RIGHT, _TOP, _BOTTOM = 0.95, 0.75, 0.34, 0.38
_MOST_HEIGHT = 1.7  # inches; a short artery is drawn narrower, not taller
_TINTS = ("#f0e2c4", "#d3b078", "#a97f45")  # one a pattern, the largest lightest
_FAR = "#767676"
_SIZE = 0.15  # inches; of a place's circle
_ROUND = 0.10  # inches; of the ends, which a view from the side has not, so that it reads as a tube


@dataclass(frozen=True)
class Place:
    """A numbered place on the wall: x (mm) from the inlet and the angle φ (degrees)."""

    number: int
    x: float
    phi: float


def artery_sketch(
    x: Floats,
    phi: Floats,
    radius: float,
    patterns: Sequence[tuple[str, Flags]],
    places: Sequence[Place],
    seen_from: float,
) -> str:
    """Draw the artery from the side with the calcified cells of each pattern and the places.

    Parameters
    ----------
    x, phi : ndarray
        Centres of the cells (mm, degrees).
    radius : float
        Of the lumen (mm).
    patterns : sequence of (str, ndarray of bool of shape (x, phi))
        Name and calcified cells of each variant; one without any is left out.
    places : sequence of Place
        Those on the far side are drawn in grey.
    seen_from : float
        Angle φ (degrees) of the side that faces the reader.

    Returns
    -------
    str
        SVG; the same text for the same input.
    """
    with style.context(STYLE):
        edges = edges_of(x)
        length = float(edges[-1] - edges[0])
        inches = min((WIDTH - _LEFT - _RIGHT) / length, _MOST_HEIGHT / (2 * radius))
        height = 2 * radius * inches
        total = _TOP + height + _BOTTOM
        figure, axis = sheet.sheet(total)
        ends = (float(edges[0]), float(edges[-1]))
        tube = Panel(_LEFT, _BOTTOM, length * inches, height, ends, (-1.0, 1.0))
        shown = sorted((p for p in patterns if p[1].any()), key=lambda p: -int(p[1].sum()))
        for tint, (_, flags) in zip(_TINTS, shown, strict=False):
            _calcification(axis, tube, edges, phi, flags, seen_from, tint)
        _wall(axis, tube, seen_from)
        sheet.abscissas(axis, [tube], "distance from the inlet $x$ (mm)", most=6)
        hidden = [_far(place.phi, seen_from) for place in places]
        _numbers(axis, tube, places, hidden, seen_from)
        keys = [
            sheet.Key(f"calcified in {name}", fill=tint)
            for tint, (name, _) in zip(_TINTS, shown, strict=False)
        ]
        if any(hidden):
            keys.append(sheet.Key("numbered place on the far side", _FAR))
        sheet.legend(axis, keys, _LEFT, total - 0.12)
        return svg_text(figure)


def _height(phi: Floats | float, seen_from: float) -> Floats:
    """Height over the radius at which an angle (degrees) is seen."""
    return np.sin(np.radians(seen_from - np.asarray(phi)))


def _far(phi: float, seen_from: float) -> bool:
    return bool(np.cos(np.radians(phi - seen_from)) < -1e-9)


def _calcification(
    axis: Axes, tube: Panel, x: Floats, phi: Floats, flags: Flags, seen_from: float, tint: str
) -> None:
    """Fill and border the calcified cells of the near side."""
    fine = np.linspace(-90.0, 90.0, 181)  # degrees from the middle of the near side
    middle = (fine[1:] + fine[:-1]) / 2 + seen_from
    row = np.abs((middle[:, None] - phi + 180) % 360 - 180).argmin(axis=1)
    heights = tube.up(_height(fine + seen_from, seen_from))
    inside = flags[:, row]
    alike = np.flatnonzero(np.diff(inside, axis=1).any(axis=0)) + 1
    steps = np.concatenate([[0], alike, [row.size]])  # rows that are alike are one box, without seams
    corners = [
        (float(tube.across(x[i])), float(tube.across(x[k])), float(heights[b]), float(heights[a]))
        for a, b in pairwise(steps)
        for i, k in runs(inside[:, a])
    ]
    sheet.boxes(axis, corners, tint)
    borders = cell_borders(x, fine, inside)
    across = tube.across(borders[..., 0])
    up = tube.up(_height(borders[..., 1] + seen_from, seen_from))
    lines = [np.pad(v, ((0, 0), (0, 1)), constant_values=np.nan).ravel() for v in (across, up)]
    sheet.line(axis, *lines, color=QUIET, linewidth=0.7, solid_capstyle="projecting")


def _wall(axis: Axes, tube: Panel, seen_from: float) -> None:
    """Draw the wall and the ends, what flows where, and the angles of what is seen."""
    right, middle = tube.left + tube.width, tube.bottom + tube.height / 2
    for up in (tube.bottom, tube.top):
        sheet.line(axis, [tube.left, right], [up, up], color="#000000", linewidth=1.2)
    for across in (tube.left, right):
        end = Ellipse((across, middle), _ROUND, tube.height, facecolor="#ffffff", edgecolor="#000000")
        end.set(linewidth=0.8, zorder=1.5)
        axis.add_patch(end)
    for across, word in ((tube.left - 0.62, "inlet"), (right + 0.32, "outlet")):
        axis.annotate(
            "",
            (across + 0.20, middle),
            (across - 0.20, middle),
            arrowprops={"arrowstyle": "-|>", "linewidth": 1.0, "color": "#000000", "mutation_scale": 9},
        )
        axis.text(across, middle + 0.10, word, ha="center", va="bottom", fontsize=sheet.LABEL_SIZE)
    for up, turned in ((tube.top, -90.0), (middle, 0.0), (tube.bottom, 90.0)):
        angle = f"$φ$ = {(seen_from + turned) % 360:.0f}°" if turned else f"{seen_from % 360:.0f}°"
        axis.text(tube.left - 0.09, up, angle, ha="right", va="center", fontsize=sheet.SMALL)


def _numbers(
    axis: Axes, tube: Panel, places: Sequence[Place], hidden: Sequence[bool], seen_from: float
) -> None:
    """Draw the places; one that would cover another moves aside."""
    taken: list[tuple[float, float]] = []
    for place, far in zip(places, hidden, strict=True):
        across, up = float(tube.across(place.x)), float(tube.up(_height(place.phi, seen_from)))
        while any(abs(across - a) < _SIZE and abs(up - b) < _SIZE for a, b in taken):
            across += _SIZE
        taken.append((across, up))
        colour = _FAR if far else REFERENCE
        circle = Ellipse((across, up), _SIZE, _SIZE, facecolor="#ffffff", edgecolor=colour)
        circle.set(linewidth=0.8, zorder=3)
        axis.add_patch(circle)
        number = str(place.number)
        axis.text(across, up - 0.005, number, color=colour, ha="center", va="center", fontsize=6.0, zorder=4)
