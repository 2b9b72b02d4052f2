"""The lumen in space as a still picture: projected and painted from back to front, without OpenGL."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh

from cases.arrays import Flags, Floats
from reports.figures import sheet
from reports.figures.canvas import STYLE, WIDTH, svg_text
from reports.figures.colour_scale import Scale, bar, scale_of
from reports.figures.lumen_cells import cell_borders, edges_of

_LEFT, _RIGHT, _TOP, _BOTTOM = 0.25, 0.75, 0.22, 0.30
_HEIGHT, _MARGIN = 1.12, 0.04
_UPSTREAM = -0.45 / 1.55  # how far upstream the eye stands, over how far sideways
_DPI = 240  # the facets are not smoothed, for that would show their borders


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


@dataclass(frozen=True)
class _Eye:
    """From millimetres in space to inches on the sheet: rows to the right, up and towards the eye."""

    view: Floats
    scale: float
    centre: tuple[float, float]

    def project(self, points: Floats) -> Floats:
        """Points of shape (..., 3) as seen, (..., 3): inches across and up, and depth."""
        seen = self.scale * (points @ self.view.T)
        return np.asarray(seen + np.array([*self.centre, 0.0]))


def tubes(
    x: Floats,
    phi: Floats,
    seen_from: float,
    columns: Sequence[str],
    rows: Sequence[tuple[str, Sequence[Tube]]],
    label: str,
    change: bool = False,
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
    change : bool
        Whether what colours the lumens is a change, in a diverging scale centred on zero.

    Returns
    -------
    str
        SVG; the same text for the same input.
    """
    with style.context(STYLE):
        drawn = [tube for _, line in rows for tube in line]
        scale = scale_of([tube.shade for tube in drawn], change)
        width = (WIDTH - _LEFT - _RIGHT) / len(columns)
        view = _view(seen_from)
        most = max(float(tube.drawn.max()) for tube in drawn)
        ends = _across(x, most, view)
        inches = min((width - 2 * _MARGIN) / (ends[1] - ends[0]), (_HEIGHT - 2 * _MARGIN) / (2 * most))
        height = 2 * most * inches + 2 * _MARGIN
        total = _TOP + _BOTTOM + height * len(rows)
        figure, axis = sheet.sheet(total)
        for number, (name, line) in enumerate(rows):
            middle = total - _TOP - (number + 0.5) * height
            for column, tube in enumerate(line):
                left = _LEFT + column * width + (width - inches * (ends[1] - ends[0])) / 2
                eye = _Eye(view, inches, (left - inches * ends[0], middle))
                _paint(axis, x, phi, tube, eye, scale)
                if number == 0:
                    across = left + inches * (ends[1] - ends[0]) / 2
                    axis.text(across, total - _TOP + 0.05, columns[column], ha="center", fontsize=7.5)
                if number == len(rows) - 1 and column == 0:
                    _length(axis, x[0], eye)
            axis.text(0.06, middle, name, rotation=90, va="center", fontsize=7.5, parse_math=False)
        bar(axis, (WIDTH - _RIGHT + 0.08, _BOTTOM, height * len(rows)), scale, label)
        return svg_text(figure, _DPI)


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


def _paint(axis: Axes, x: Floats, phi: Floats, tube: Tube, eye: _Eye, scale: Scale) -> None:
    """Paint the far side, then the near one; facets that face the eye are lighter."""
    toward = np.cos(phi) * eye.view[2, 1] + np.sin(phi) * eye.view[2, 2]
    start = int(toward.argmin())
    order = np.roll(np.arange(phi.size), -start)
    around = np.append(order, order[0])  # from the far side around to it
    points = _points(x, phi, tube.drawn)
    near = np.flatnonzero(toward[around] > 0)
    first, last = (int(near[0]), int(near[-1])) if near.size else (0, 0)
    for columns in (around[: first + 1], around[last:], around[first : last + 1]):
        if columns.size > 1:
            _facets(axis, eye.project(points[:, columns]), tube.shade[:, columns], scale)
    _outline(axis, x, phi, tube, eye)


def _facets(axis: Axes, at: Floats, shade: Floats, scale: Scale) -> None:
    """Fill the facets between neighbouring points (x, φ, 3) with the mean colour of their corners."""
    normal = np.cross(at[1:, 1:] - at[:-1, :-1], at[:-1, 1:] - at[1:, :-1])
    facing = -normal[..., 2] / np.maximum(np.linalg.norm(normal, axis=-1), 1e-300)
    middle = (shade[1:, 1:] + shade[:-1, :-1] + shade[:-1, 1:] + shade[1:, :-1]) / 4
    colours = scale.colours(scale.norm(middle))
    colours[..., :3] *= (0.62 + 0.38 * np.abs(facing))[..., None] * np.where(facing > 0, 1.0, 0.75)[..., None]
    mesh = QuadMesh(at[::-1, :, :2], rasterized=True, antialiased=False)  # the eye stands upstream
    mesh.set_facecolor(colours[::-1].reshape(-1, 4))
    axis.add_collection(mesh, autolim=False)


def _outline(axis: Axes, x: Floats, phi: Floats, tube: Tube, eye: _Eye) -> None:
    """Outline the calcified cells where they face the eye."""
    edges = (edges_of(x), edges_of(phi))
    borders = cell_borders(*edges, tube.calcified)
    i = np.abs(edges[0][:, None] - borders[..., 0].ravel()).argmin(axis=0)
    j = np.abs(edges[1][:, None] - borders[..., 1].ravel()).argmin(axis=0)
    radius = 1.002 * _at_corners(tube.drawn)[i, j].reshape(borders.shape[:2])
    angle = borders[..., 1]
    at = eye.project(np.stack([borders[..., 0], radius * np.cos(angle), radius * np.sin(angle)], axis=-1))
    middle = angle.mean(axis=1)
    visible = np.cos(middle) * eye.view[2, 1] + np.sin(middle) * eye.view[2, 2] > 0
    ends = np.pad(at[visible, :, :2], ((0, 0), (0, 1), (0, 0)), constant_values=np.nan).reshape(-1, 2)
    for colour, width in (("#ffffff", 1.6), ("#000000", 0.7)):
        sheet.line(axis, *ends.T, color=colour, linewidth=width, solid_capstyle="projecting")


def _at_corners(radius: Floats) -> Floats:
    """Radius at the cells' corners, shape (n_x + 1, n_phi + 1): the mean of the cells that meet there."""
    along = np.pad(radius, ((1, 1), (0, 0)), mode="edge")
    along = (along[1:] + along[:-1]) / 2
    around = np.pad(along, ((0, 0), (1, 1)), mode="wrap")
    return np.asarray((around[:, 1:] + around[:, :-1]) / 2)


def _length(axis: Axes, start: float, eye: _Eye) -> None:
    """Draw a bar along the axis of the artery, in millimetres as drawn, below the lumens."""
    left = float(eye.project(np.array([start, 0.0, 0.0]))[0])
    right = float(eye.project(np.array([start + 5.0, 0.0, 0.0]))[0])
    sheet.line(axis, [left, right], [_BOTTOM / 2] * 2, color="#000000", linewidth=1.0)
    axis.text(
        right + 0.06, _BOTTOM / 2, "5 mm along the axis; flow from left to right", va="center", fontsize=6.5
    )
