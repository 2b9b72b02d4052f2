"""The models' lumen wall over the cycle, with the cells' values, for ParaView: a VTKHDF file each."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray as xr

from cases.arrays import Floats, Integers
from cases.fields import CELL, FIELDS
from cases.quantities import tabulated
from cases.results.comparison_file import CALCIFIED, REFERENCE, WALL_STIFFNESS, variable
from validation.compare.surfaces_file import write_surfaces

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
    """Corners of the cells on the wall, (n_t, (n_x + 1) n_phi, 3): radii are means of the cells around.

    Parameters
    ----------
    x : ndarray (n_x,)
        Centres of the cells, m.
    phi : ndarray (n_phi,)
        rad.
    radius : ndarray (n_t, n_x, n_phi)
        Of the cells, m.
    """
    ends = np.concatenate([radius[:, :1], 0.5 * (radius[:, 1:] + radius[:, :-1]), radius[:, -1:]], axis=1)
    corners = 0.5 * (ends + np.roll(ends, 1, axis=2))
    around = edges(phi)[:-1]
    points = np.empty((*corners.shape, 3))
    points[..., 0] = edges(x)[:, None]
    points[..., 1] = corners * np.cos(around)
    points[..., 2] = corners * np.sin(around)
    return points.reshape(len(radius), -1, 3)


def _write_wall(path: Path, model: str, stiffness: str, both: xr.Dataset) -> None:
    """Write one model's wall with the values of its cells; ``stiffness`` is a wall's variable."""
    axes = both["x"].to_numpy(), both["phi"].to_numpy()
    cells = [name for name in tabulated() if FIELDS[name].dims == CELL]
    fields = {name: both[variable(model, name)].to_numpy() for name in cells}
    still = {
        WALL_STIFFNESS: both[stiffness].to_numpy().astype(np.float32),
        CALCIFIED: both[CALCIFIED].to_numpy(),
    }
    if axes[1].size == 1:
        axes = axes[0], 2 * np.pi * (np.arange(DRAWN) + 0.5) / DRAWN
        fields = {name: np.repeat(values, DRAWN, axis=-1) for name, values in fields.items()}
        still = {name: np.repeat(values, DRAWN, axis=-1) for name, values in still.items()}
    times = both["time"].to_numpy()
    values = {name: field.astype(np.float32).reshape(times.size, -1) for name, field in fields.items()}
    write_surfaces(
        path,
        times,
        quadrilaterals(*(axis.size for axis in axes)),
        wall_points(*axes, fields["radius"]),
        values | {name: constant.ravel() for name, constant in still.items()},
    )


def write_walls(directory: Path, variant: str, models: Sequence[str], both: xr.Dataset) -> None:
    """Write ``<model>_<variant>.vtkhdf`` and ``reference_<variant>.vtkhdf``; one without radii is left out.

    Raises
    ------
    ValidationError
        If a file cannot be written.
    """
    for model, of in (*zip(models, models, strict=True), (REFERENCE, models[0])):
        if not np.any(np.isnan(both[variable(model, "radius")])):
            _write_wall(directory / f"{model}_{variant}.vtkhdf", model, variable(of, WALL_STIFFNESS), both)
