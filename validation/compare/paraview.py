"""The models' lumen wall over the cycle, with the cells' values, for ParaView: a VTKHDF file each."""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pyvista as pv
import xarray as xr

from cases.arrays import Floats, Integers
from cases.fields import CELL, FIELDS
from cases.quantities import tabulated
from cases.results.comparison_file import CALCIFIED, REFERENCE, WALL_STIFFNESS, variable
from febio_io.views.vtk_times import write_over_time

DRAWN = 48  # rows with which an artery of one row is drawn round


def edges(centres: Floats) -> Floats:
    """Edges of uniform cells with these centres, (n + 1,)."""
    half = 0.5 * (centres[1] - centres[0])
    return np.append(centres - half, centres[-1] + half)


def quadrilaterals(n_x: int, n_phi: int) -> Integers:
    """Corners of the cells on a closed grid of (n_x + 1) × n_phi points, (n_x n_phi, 4)."""
    i, j = np.divmod(np.arange(n_x * n_phi), n_phi)
    beside = (j + 1) % n_phi
    return np.column_stack([i * n_phi + j, (i + 1) * n_phi + j, (i + 1) * n_phi + beside, i * n_phi + beside])


def wall_points(x: Floats, phi: Floats, radius: Floats) -> Floats:
    """Corners of the cells on the wall, ((n_x + 1) n_phi, 3): radii are means of the cells around.

    Parameters
    ----------
    x : ndarray (n_x,)
        Centres of the cells, m.
    phi : ndarray (n_phi,)
        rad.
    radius : ndarray (n_x, n_phi)
        Of the cells, m.
    """
    ends = np.concatenate([radius[:1], 0.5 * (radius[1:] + radius[:-1]), radius[-1:]])
    corners = 0.5 * (ends + np.roll(ends, 1, axis=1))
    along, around = np.meshgrid(edges(x), edges(phi)[:-1], indexing="ij")
    return np.stack([along, corners * np.cos(around), corners * np.sin(around)], axis=-1).reshape(-1, 3)


def _wall_at(model: str, stiffness: str, both: xr.Dataset) -> Callable[[int], pv.PolyData]:
    """Return what makes the surface of a state, with the values of its cells and a wall's stiffness."""
    axes = both["x"].to_numpy(), both["phi"].to_numpy()
    if axes[1].size == 1:
        both = both.isel(phi=np.zeros(DRAWN, dtype=int))
        axes = axes[0], 2 * np.pi * (np.arange(DRAWN) + 0.5) / DRAWN
    cells = [name for name in tabulated() if FIELDS[name].dims == CELL]
    fields = {name: both[variable(model, name)].to_numpy() for name in cells}
    quads = quadrilaterals(*(axis.size for axis in axes))
    faces = np.column_stack([np.full(len(quads), 4), quads]).ravel()
    still = {
        WALL_STIFFNESS: both[stiffness].to_numpy().astype(np.float32),
        CALCIFIED: both[CALCIFIED].to_numpy(),
    }

    def wall(state: int) -> pv.PolyData:
        points = wall_points(*axes, fields["radius"][state])
        surface = pv.PolyData(points.astype(np.float32), faces=faces)
        for name, values in fields.items():
            surface.cell_data[name] = values[state].ravel().astype(np.float32)
        for name, values in still.items():
            surface.cell_data[name] = values.ravel()
        return surface

    return wall


def write_walls(directory: Path, variant: str, models: Sequence[str], both: xr.Dataset) -> None:
    """Write ``<model>_<variant>.vtkhdf`` and ``reference_<variant>.vtkhdf``; one without radii is left out.

    Raises
    ------
    FebioFileError
        If a file cannot be written.
    """
    times = both["time"].to_numpy().tolist()
    for model, of in (*zip(models, models, strict=True), (REFERENCE, models[0])):
        if not np.any(np.isnan(both[variable(model, "radius")])):
            path = directory / f"{model}_{variant}.vtkhdf"
            write_over_time(path, "vtkPolyData", times, _wall_at(model, variable(of, WALL_STIFFNESS), both))
