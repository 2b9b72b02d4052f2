"""The mesh of one cross-section: a core, and rings around it up to the outer face of the wall."""

from dataclasses import dataclass

import numpy as np

from cases.arrays import Floats, Integers
from febio_io.feb.model import MeshSize, Vessel

SQUARE = 0.5  # half the side of an O-grid's square over the radius


@dataclass(frozen=True, eq=False)
class CrossSection:
    """Points and faces; all numbers count from 1, all faces run counter-clockwise.

    Attributes
    ----------
    points : (n_points, 2) float64 array
        Positions towards φ = 0 and φ = π/2, m.
    core : (n_faces, 3 or 4) int64 array
        Faces at the axis: a wedge for each sector, or the squares of an O-grid.
    rings : (n_rings, n_theta) int64 array
        Points of the rings, from the core's edge outwards, each from φ = 0 on.
    interface : int
        Which of the rings is that between lumen and wall, from 0.
    axis : int
        Point on the axis.
    """

    points: Floats
    core: Integers
    rings: Integers
    interface: int
    axis: int


def cross_section(vessel: Vessel, size: MeshSize) -> CrossSection:
    """Make the mesh of a cross-section.

    Parameters
    ----------
    vessel, size
        Sizes in m, and numbers of elements.
    """
    return _o_grid(vessel, size) if size.core == "o_grid" else _wedges(vessel, size)


def _wedges(vessel: Vessel, size: MeshSize) -> CrossSection:
    """Triangles at the axis; the axis is point 1, then ring by ring."""
    radii = np.concatenate([vessel.radius * _shares(size), _wall_radii(vessel, size)])
    circle = unit_circle(size.n_theta)
    points = np.concatenate([np.zeros((1, 2)), (radii[:, np.newaxis, np.newaxis] * circle).reshape(-1, 2)])
    rings = np.arange(2, len(points) + 1).reshape(len(radii), size.n_theta)
    core = np.column_stack([np.ones_like(rings[0]), rings[0], np.roll(rings[0], -1)])
    return CrossSection(points, core, rings, interface=size.n_r - 1, axis=1)


def _o_grid(vessel: Vessel, size: MeshSize) -> CrossSection:
    """Make squares at the axis, whose edge the rings turn into circles; row by row, then ring by ring."""
    side = size.n_theta // 4
    ticks = SQUARE * vessel.radius * np.linspace(-1.0, 1.0, side + 1)
    ticks[side // 2] = 0.0
    square = np.stack(np.meshgrid(ticks, ticks, indexing="xy"), axis=-1).reshape(-1, 2)
    numbers = np.arange(1, len(square) + 1).reshape(side + 1, side + 1)
    corners = (numbers[:-1, :-1], numbers[:-1, 1:], numbers[1:, 1:], numbers[1:, :-1])
    edge = _around(numbers)
    inner, outer = square[edge - 1], vessel.radius * unit_circle(size.n_theta)
    shares = _shares(size)[:, np.newaxis, np.newaxis]
    lumen = inner + shares * (outer - inner)
    lumen[-1] = outer
    wall = _wall_radii(vessel, size)[:, np.newaxis, np.newaxis] * unit_circle(size.n_theta)
    rings = np.concatenate([lumen, wall])
    new = np.arange(len(square) + 1, len(square) + 1 + rings[..., 0].size).reshape(rings.shape[:2])
    return CrossSection(
        points=np.concatenate([square, rings.reshape(-1, 2)]),
        core=np.column_stack([corner.ravel() for corner in corners]),
        rings=np.concatenate([edge[np.newaxis], new]),
        interface=size.n_r,
        axis=int(numbers[side // 2, side // 2]),
    )


def _around(numbers: Integers) -> Integers:
    """Points on the edge of a square, from the middle of its right side on, counter-clockwise."""
    right, top = numbers[:-1, -1], numbers[-1, :0:-1]
    left, bottom = numbers[:0:-1, 0], numbers[0, :-1]
    return np.roll(np.concatenate([right, top, left, bottom]), -(len(numbers) - 1) // 2)


def _shares(size: MeshSize) -> Floats:
    """How far out the lumen's rings are, from 0 to 1; the widths between them by the bias."""
    widths = np.geomspace(size.bias, 1.0, size.n_r)
    shares: Floats = np.cumsum(widths) / widths.sum()
    shares[-1] = 1.0
    return shares


def _wall_radii(vessel: Vessel, size: MeshSize) -> Floats:
    return np.asarray(vessel.radius + vessel.thickness * np.arange(1, size.n_wall + 1) / size.n_wall)


def unit_circle(n_theta: int) -> Floats:
    """Give points of the unit circle (n_theta, 2); those on the axes lie there exactly."""
    angles = 2.0 * np.pi * np.arange(n_theta) / n_theta
    points = np.column_stack([np.cos(angles), np.sin(angles)])
    quarter = n_theta // 4
    points[[quarter, 3 * quarter], 0] = 0.0
    points[[0, 2 * quarter], 1] = 0.0
    return points
