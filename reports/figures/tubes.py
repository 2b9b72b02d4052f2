"""The lumen in space as a still picture: projected and painted from back to front, without OpenGL."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib import colormaps, style
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from cases.arrays import Flags, Floats
from reports.figures.canvas import STYLE, WIDTH, svg_text
from reports.figures.heat_maps import colour_bar
from reports.figures.lumen_cells import cell_borders, edges_of

_LEFT, _RIGHT, _TOP, _BOTTOM = 0.25, 0.75, 0.22, 0.30
_HEIGHT, _BAR = 1.12, 0.08
_UPSTREAM = -0.45 / 1.55  # how far upstream the eye stands, over how far sideways


@dataclass(frozen=True)
class Tube:
    """One lumen.

    Attributes
    ----------
    drawn : ndarray, shape (x, phi)
        Radius to draw (mm).
    shade : ndarray, shape (x, phi)
        What colours it, in display units.
    calcified : ndarray of bool, shape (x, phi)
        Cells to outline.
    """

    drawn: Floats
    shade: Floats
    calcified: Flags


def tubes(
    x: Floats,
    phi: Floats,
    seen_from: float,
    columns: Sequence[str],
    rows: Sequence[tuple[str, Sequence[Tube]]],
    label: str,
) -> str:
    """Draw rows of lumens in one colour scale.

    Parameters
    ----------
    x, phi : ndarray
        Centres of the cells (mm, rad).
    seen_from : float
        Angle φ of the side that faces the reader (rad).
    columns : sequence of str
        Headings.
    rows : sequence of (str, sequence of Tube)
        Each with its label, from top to bottom.
    label : str
        Of the colour bar, with unit.

    Returns
    -------
    str
        SVG; the same text for the same input.
    """
    shades = np.concatenate([tube.shade.ravel() for _, line in rows for tube in line])
    norm = Normalize(float(shades.min()), float(shades.max()))
    if np.ptp(shades) <= 1e-9 * np.abs(shades).max():
        norm = Normalize(0.95 * float(shades.min()), 1.05 * float(shades.max()))
    with style.context(STYLE):
        total = _TOP + _BOTTOM + _HEIGHT * len(rows)
        figure = Figure(figsize=(WIDTH, total))
        width = (WIDTH - _LEFT - _RIGHT) / len(columns)
        view = _view(seen_from)
        most = max(float(tube.drawn.max()) for _, line in rows for tube in line)
        across = _across(x, most, view)
        for number, (name, line) in enumerate(rows):
            bottom = total - _TOP - (number + 1) * _HEIGHT
            for column, tube in enumerate(line):
                axis = figure.add_axes(
                    ((_LEFT + column * width) / WIDTH, bottom / total, width / WIDTH, _HEIGHT / total)
                )
                axis.set_axis_off()
                _paint(axis, x, phi, tube, view, norm)
                axis.set_xlim(*across)
                axis.set_ylim(-1.1 * most, 1.1 * most)
                axis.set_aspect("equal")
                if number == 0:
                    axis.set_title(columns[column], fontsize=7.5, pad=2.0)
                if number == len(rows) - 1 and column == 0:
                    _scale(axis, x[0], view)
            figure.text(
                0.06 / WIDTH,
                (bottom + _HEIGHT / 2) / total,
                name,
                rotation=90,
                va="center",
                fontsize=7.5,
                parse_math=False,
            )
        place = (WIDTH - _RIGHT + 0.08, _BOTTOM / total, _HEIGHT * len(rows) / total)
        colour_bar(figure, place, norm, colormaps["viridis"], label)
        return svg_text(figure)


def _view(seen_from: float) -> Floats:
    """Rows: the directions to the right, up and towards the eye, flow from left to right."""
    eye = np.array([_UPSTREAM, np.cos(seen_from), np.sin(seen_from)])
    eye /= np.linalg.norm(eye)
    up = np.array([0.0, np.sin(seen_from), -np.cos(seen_from)])
    right = np.cross(up, eye)
    return np.stack([right, np.cross(eye, right), eye])


def _across(x: Floats, radius: float, view: Floats) -> tuple[float, float]:
    """Leftmost and rightmost point of a tube of this radius."""
    ends = np.array([x[0], x[-1]]) * view[0, 0]
    aside = radius * float(np.hypot(view[0, 1], view[0, 2]))
    return float(ends.min()) - aside, float(ends.max()) + aside


def _points(x: Floats, phi: Floats, radius: Floats) -> Floats:
    """Points of the wall, shape (x, phi, 3)."""
    return np.stack(
        [np.broadcast_to(x[:, None], radius.shape), radius * np.cos(phi), radius * np.sin(phi)], axis=-1
    )


def _paint(axis: Axes, x: Floats, phi: Floats, tube: Tube, view: Floats, norm: Normalize) -> None:
    """Paint facets between neighbouring centres, the farthest first; facets that face the eye are lighter."""
    at = _points(x, phi, tube.drawn) @ view.T
    corners = np.stack(
        [at[:-1], at[1:], np.roll(at, -1, axis=1)[1:], np.roll(at, -1, axis=1)[:-1]], axis=2
    ).reshape(-1, 4, 3)
    shade = (tube.shade[:-1] + tube.shade[1:]) / 2
    shade = ((shade + np.roll(shade, -1, axis=1)) / 2).ravel()
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    facing = -normal[:, 2] / np.linalg.norm(normal, axis=1)
    order = np.argsort(corners[:, :, 2].mean(axis=1))
    facets: Any = corners[order, :, :2]  # an array is drawn faster than the list that is declared
    colours = colormaps["viridis"](norm(shade))
    colours[:, :3] *= (0.62 + 0.38 * np.abs(facing))[:, None] * np.where(facing > 0, 1.0, 0.75)[:, None]
    axis.add_collection(
        PolyCollection(
            facets,
            facecolors=colours[order],
            edgecolors=colours[order],
            linewidths=0.3,
            rasterized=True,
        )
    )
    _outline(axis, x, phi, tube, view)


def _outline(axis: Axes, x: Floats, phi: Floats, tube: Tube, view: Floats) -> None:
    """Outline the calcified cells where they face the eye."""
    edges = (edges_of(x), edges_of(phi))
    borders = cell_borders(*edges, tube.calcified)
    i = np.abs(edges[0][:, None] - borders[..., 0].ravel()).argmin(axis=0)
    j = np.abs(edges[1][:, None] - borders[..., 1].ravel()).argmin(axis=0)
    radius = 1.002 * _at_corners(tube.drawn)[i, j].reshape(borders.shape[:2])
    angle = borders[..., 1]
    at = np.stack([borders[..., 0], radius * np.cos(angle), radius * np.sin(angle)], axis=-1) @ view.T
    middle = angle.mean(axis=1)
    visible = np.cos(middle) * view[2, 1] + np.sin(middle) * view[2, 2] > 0
    ends = np.pad(at[visible, :, :2], ((0, 0), (0, 1), (0, 0)), constant_values=np.nan).reshape(-1, 2)
    for colour, width in (("#ffffff", 1.6), ("#000000", 0.7)):
        axis.plot(*ends.T, color=colour, linewidth=width, solid_capstyle="projecting")


def _at_corners(radius: Floats) -> Floats:
    """Radius at the cells' corners, shape (n_x + 1, n_phi + 1): the mean of the cells that meet there."""
    along = np.pad(radius, ((1, 1), (0, 0)), mode="edge")
    along = (along[1:] + along[:-1]) / 2
    around = np.pad(along, ((0, 0), (1, 1)), mode="wrap")
    return np.asarray((around[:, 1:] + around[:, :-1]) / 2)


def _scale(axis: Axes, start: float, view: Floats) -> None:
    """Draw a bar along the axis of the artery, in millimetres as drawn, below the lumen."""
    left, right = start * view[0, 0], (start + 5.0) * view[0, 0]
    low = axis.get_ylim()[0]
    axis.plot([left, right], [low, low], color="#000000", linewidth=1.0, clip_on=False)
    axis.annotate(
        "5 mm along the axis; flow from left to right",
        (right, low),
        xytext=(4, 0),
        textcoords="offset points",
        va="center",
        fontsize=6.5,
        annotation_clip=False,
    )
