"""A(P) of a solid wall: followed from rest to one pressure after the other, kept on disk.

As for a membrane a section's shape is taken as the wall's answer to its own pressure everywhere.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

from cases.arrays import Floats
from solver.errors import ModelError
from solver.geometry.grid import Grid
from solver.kept import kept_array
from solver.wall.sections import SectionWall, from_radii
from solver.wall.solid import Solid, equilibrium, lumen_radius

PRESSURES = 12  # that the wall is solved for, above P₀
VERSION = "1"  # of what is kept: part of its key
EXTRAPOLATION = ((1.0,), (2.0, -1.0), (3.0, -3.0, 1.0), (4.0, -6.0, 4.0, -1.0))  # of the last displacements


@dataclass(frozen=True)
class SolidWall:
    """A solid wall around the grid of the flow.

    Attributes
    ----------
    grid : Grid
    solid : Solid
    reference_pressure : float
        P₀, Pa.
    highest_load : float
        Largest p = P − P₀ to tabulate, Pa, if the wall is stable so far.
    """

    grid: Grid
    solid: Solid
    reference_pressure: float
    highest_load: float


def _followed(solid: Solid, loads: Iterable[Floats]) -> Iterator[Floats]:
    """Displacements under loads (n_stacks,) that grow from rest by equal steps, while the wall is stable."""
    last = [np.zeros((solid.nodes.size, 2))]
    for load in loads:
        weights = EXTRAPOLATION[len(last) - 1]
        start = np.add.reduce([weight * moved for weight, moved in zip(weights, last, strict=True)])
        moved = equilibrium(solid, load, start)
        last = [moved, *last[: len(EXTRAPOLATION) - 1]]
        yield moved


def radii(wall: SolidWall, load: Floats) -> Floats:
    """R of every cell at spatial angles under a load p for each section (n_x,), m, (n_x, n_phi).

    Raises
    ------
    ModelError
        Where the wall buckles, runs away or folds.
    """
    places = wall.solid.places
    own = np.interp(0.5 * (places[1:] + places[:-1]), wall.grid.x, load)
    *_, moved = _followed(wall.solid, (0.5 * own, own))
    return lumen_radius(wall.solid, moved, wall.grid.x, wall.grid.phi)


def section_wall(wall: SolidWall, folder: Path | None = None) -> SectionWall:
    """Tables of a solid wall, from disk if they are there; R goes on linearly below P₀.

    Parameters
    ----------
    wall : SolidWall
    folder : Path, optional
        Where tables are kept; default: the user's cache.

    Raises
    ------
    ModelError
        Where the wall is stable at no pressure of interest, or a section does not grow with pressure.
    """
    solid, grid = wall.solid, wall.grid
    sizes = (solid.length, solid.radius, solid.thickness, solid.poisson_ratio, solid.n_layers)
    numbers = np.array([*sizes, grid.length, grid.n_x, grid.n_phi, wall.highest_load])
    found = kept_array("solid", (VERSION, numbers, solid.moduli), lambda: _solved(wall), folder)
    step = wall.highest_load / PRESSURES
    loads = step * np.arange(len(found))
    spline = CubicSpline(loads, found)
    slopes = spline(loads, 1)
    below = found[0] - step * slopes[0]
    pressures = wall.reference_pressure + np.concatenate([[-step], loads])
    columns = np.concatenate([below[None], found]), np.concatenate([slopes[:1], slopes])
    return from_radii(pressures, *(np.moveaxis(column, 0, 1) for column in columns))


def _solved(wall: SolidWall) -> Floats:
    """R of every cell at equidistant loads from 0 on, (n, n_x, n_phi), m, as far as the wall is stable."""
    solid, grid = wall.solid, wall.grid
    found = [np.full((grid.n_x, grid.n_phi), solid.radius)]
    loads = wall.highest_load / PRESSURES * np.arange(1, PRESSURES + 1)
    states = _followed(solid, (np.full(len(solid.moduli), load) for load in loads))
    try:  # what is found before the wall runs away stays
        found.extend(lumen_radius(solid, moved, grid.x, grid.phi) for moved in states)
    except ModelError:
        if len(found) < len(EXTRAPOLATION):
            raise
    return np.stack(found)
