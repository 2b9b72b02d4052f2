"""What is what in files of a 3D result, by names and values: a proposal, which the user has to judge."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cases.arrays import Flags, Floats, Integers
from validation.reference.grid.contents import Grid
from validation.reference.mesh.units import OF_LENGTH, OF_PRESSURE

USUAL_RADIUS, USUAL_PRESSURE = 3e-3, 12e3  # of arteries, m and Pa
FEW = 16  # values up to which an array of cells tells domains
FAST = 0.2  # share of the fastest domain's speed from which a domain is blood
ON_PLANE = 1e-6  # share of the length within which nodes lie in an end's plane
VELOCITY, PRESSURE, DISPLACEMENT = ("veloc", "u"), ("pressure", "p"), ("displacement", "disp")


class Domains(NamedTuple):
    """An array of cells that tells domains, its values, and those of blood and of wall."""

    array: str
    values: Floats
    lumen: list[float]
    wall: list[float]


class Ends(NamedTuple):
    """Axis by name, coordinates of the ends' centres (2, 3), and how many nodes lie in each plane."""

    axis: str
    centres: Floats
    nodes: tuple[int, int]
    length: float
    radius: float
    forward: bool


def named(arrays: Mapping[str, NDArray[Any]], words: tuple[str, str], components: int) -> list[str]:
    """Names of arrays that a quantity may have, the likeliest first: whole, at the start, within."""
    part, alone = words
    found = [n for n, values in arrays.items() if (1 if values.ndim == 1 else values.shape[1]) == components]
    likely = [n for n in found if part in n.lower() or n.lower() == alone]
    ranks = [(name.lower() != alone, not name.lower().startswith(part), len(name)) for name in likely]
    return [name for _, name in sorted(zip(ranks, likely, strict=True))]


def displacement_of(grid: Grid) -> str | None:
    """Name of the displacement: of several the smallest, for that of the blood grows without end."""
    names = named(grid.of_points, DISPLACEMENT, 3)
    return min(names, key=lambda name: float(np.nanmax(np.abs(grid.of_points[name]))), default=None)


def cell_speed(grid: Grid, name: str) -> Floats:
    """Speed in each cell, (n_cells,)."""
    if name in grid.of_cells:
        return np.asarray(np.linalg.norm(np.nan_to_num(grid.of_cells[name]), axis=1))
    nodal = np.linalg.norm(np.nan_to_num(grid.of_points[name]), axis=1)
    sums = np.add.reduceat(nodal[grid.nodes], grid.starts[:-1])
    return np.asarray(sums / np.diff(grid.starts))


def domains_of(grid: Grid, last: Grid, velocity: str) -> Domains | None:
    """Array that tells most domains, blood by its speed; None where there is none."""
    speed = cell_speed(last, velocity)
    best: Domains | None = None
    for name, values in grid.of_cells.items():
        if values.ndim != 1 or not np.all(np.isfinite(values)) or np.any(values != np.round(values)):
            continue
        known = np.unique(values)
        if 2 <= known.size <= FEW and (best is None or known.size > best.values.size):
            mean = np.array([speed[values == value].mean() for value in known])
            fast = mean > FAST * mean.max()
            best = Domains(name, known, known[fast].tolist(), known[~fast].tolist())
    return best


def nodes_of(grid: Grid, cells: Flags) -> Integers:
    """Nodes of some cells."""
    return np.unique(grid.nodes[np.repeat(cells, np.diff(grid.starts))])


def ends_of(grid: Grid, last: Grid, lumen: Flags, velocity: str) -> Ends:
    """Axis along the lumen's longest extent, in the direction of the flow, and its ends."""
    nodes = nodes_of(grid, lumen)
    points = np.asarray(grid.points[nodes], dtype=float)
    size = np.ptp(points, axis=0)
    k = int(np.argmax(size))
    along = points[:, k]
    near = ON_PLANE * size[k]
    ends = [np.abs(along - at) <= near for at in (along.min(), along.max())]
    if velocity in last.of_points:
        mean = float(np.nanmean(last.of_points[velocity][nodes, k]))
    else:
        mean = float(np.nanmean(last.of_cells[velocity][lumen, k]))
    centres = np.array([0.5 * (points[end].min(axis=0) + points[end].max(axis=0)) for end in ends])
    radius = 0.5 * float(np.delete(size, k).mean())
    counts = (int(ends[0].sum()), int(ends[1].sum()))
    return Ends("xyz"[k], centres, counts, float(size[k]), radius, mean >= 0)


def length_unit(radius: float) -> str:
    """Unit in which a radius is nearest to an artery's."""
    return _nearest(radius, USUAL_RADIUS, {name: OF_LENGTH[name] for name in ("m", "cm", "mm")})


def pressure_unit(pressure: float) -> str:
    """Unit in which a pressure is nearest to blood's."""
    return _nearest(pressure, USUAL_PRESSURE, OF_PRESSURE)


def _nearest(size: float, usual: float, units: Mapping[str, float]) -> str:
    if not size > 0:
        return min(units, key=lambda name: abs(math.log(units[name])))
    return min(units, key=lambda name: abs(math.log(units[name] * size / usual)))
