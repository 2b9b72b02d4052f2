"""A(P) of a membrane wall: solved for a dozen pressures, interpolated by a polynomial, kept on disk.

The pressure varies little along an artery, so a section's shape is taken as the membrane's answer to its own
pressure everywhere; :func:`locality_error` measures what that neglects.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import gcd
from pathlib import Path

import numpy as np
from numpy.polynomial import chebyshev

from cases.arrays import Floats
from solver.geometry.grid import Grid
from solver.geometry.spatial_angle import radius_at_angles
from solver.kept import kept_array
from solver.wall.membrane import Membrane, displacement
from solver.wall.sections import SectionWall, from_radii

PRESSURES = 12  # that the membrane is solved for
KNOTS = 40  # of the table above p = 0
KNOTS_BELOW = 4  # and below, where R is continued linearly
HIGHEST_GROWTH = 0.4  # R/R₀ − 1 of the softest cell's row law at the highest pressure
VERSION = "1"  # of what is kept: part of its key


@dataclass(frozen=True)
class MembraneWall:
    """A membrane on the grid of the flow.

    Attributes
    ----------
    grid : Grid
    radius, reference_pressure : float
        R₀, m, and P₀, Pa.
    stiffness : callable
        Load p = P − P₀, Pa → secant stiffness β = p R₀²/(R − R₀) of the base's row law in every cell
        (n_x, n_phi), Pa m.
    shear : ndarray (n_x, n_phi)
        S = G h, N/m.
    supports : str
        As :class:`solver.wall.membrane.Membrane`.
    highest_load : float
        Largest p to tabulate, Pa.
    """

    grid: Grid
    radius: float
    reference_pressure: float
    stiffness: Callable[[float], Floats]
    shear: Floats
    supports: str
    highest_load: float

    @property
    def refinement(self) -> int:
        """Cells of the membrane around each cell of the grid: their number is a multiple of 4."""
        return 4 // gcd(self.grid.n_phi, 4)

    def on_membrane(self, values: Floats) -> Floats:
        """Values of cells of the grid on the membrane's."""
        return np.repeat(values, self.refinement, axis=1)

    @property
    def membrane(self) -> Membrane:
        """The membrane itself."""
        return Membrane(self.grid.dx, self.radius, self.on_membrane(self.shear), self.supports)


def nodes(highest: float) -> Floats:
    """Chebyshev points between 0 and the highest load, Pa."""
    angles = (np.arange(PRESSURES) + 0.5) / PRESSURES * np.pi
    return np.asarray(0.5 * highest * (1 - np.cos(angles)))


def radii(wall: MembraneWall, load: Floats) -> Floats:
    """R of every cell at spatial angles under a load p for each section (n_x,), m, (n_x, n_phi).

    Raises
    ------
    ModelError
        Where the membrane buckles or folds.
    """
    stiffness = wall.stiffness(float(np.mean(load)))
    moved = displacement(wall.membrane, wall.on_membrane(stiffness), load)
    found = radius_at_angles(wall.radius, *moved)
    shape = (wall.grid.n_x, wall.grid.n_phi, wall.refinement)
    return np.asarray(found.reshape(shape).mean(axis=2))


def section_wall(wall: MembraneWall, folder: Path | None = None) -> SectionWall:
    """Tables of a membrane wall, from disk if they are there.

    Parameters
    ----------
    wall : MembraneWall
    folder : Path, optional
        Where tables are kept; default: the user's cache.

    Raises
    ------
    ModelError
        Where the membrane buckles or folds, or a section does not grow with pressure.
    """
    loads = nodes(wall.highest_load)
    stiffnesses = np.stack([wall.stiffness(float(load)) for load in loads])
    sizes = np.array([wall.radius, wall.grid.length, wall.grid.n_x, wall.grid.n_phi])
    parts = (VERSION, wall.supports, sizes, loads, stiffnesses, wall.shear)

    def compute() -> Floats:
        return np.stack([radii(wall, np.full(wall.grid.n_x, load)) for load in loads])

    return _table(wall, loads, kept_array("membrane", parts, compute, folder))


def _table(wall: MembraneWall, loads: Floats, found: Floats) -> SectionWall:
    """R = R₀ + p c(p) with c the polynomial through the solved pressures, at equidistant pressures."""
    scaled = 2 * loads / wall.highest_load - 1
    compliance = (found - wall.radius) / loads[:, None, None]
    matrix = chebyshev.chebvander(scaled, PRESSURES - 1)
    coefficients = np.linalg.solve(matrix, compliance.reshape(PRESSURES, -1))
    knots = wall.highest_load / KNOTS * np.arange(-KNOTS_BELOW, KNOTS + 1, dtype=float)
    at = np.maximum(2 * knots / wall.highest_load - 1, -1.0)
    value = chebyshev.chebvander(at, PRESSURES - 1) @ coefficients
    derivative = np.zeros_like(coefficients)
    derivative[:-1] = chebyshev.chebder(coefficients) * (2 / wall.highest_load)
    slope = np.where(knots > 0, knots, 0.0)[:, None] * (chebyshev.chebvander(at, PRESSURES - 1) @ derivative)
    shape = (knots.size, wall.grid.n_x, wall.grid.n_phi)
    radius = np.moveaxis((wall.radius + knots[:, None] * value).reshape(shape), 0, 1)
    slopes = np.asarray(np.moveaxis((value + slope).reshape(shape), 0, 1), dtype=float)
    return from_radii(wall.reference_pressure + knots, radius, slopes)
