"""Rows of an artery that others stand for: where all are alike, or one half is the other's mirror image."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from cases.arrays import Floats
from solver.geometry.grid import Grid
from solver.model.parameters import Model

ROUND_OFF = 1e-12  # relative difference of rows that are alike
FEWEST_ROWS = 4  # of a half


def fewer_rows(model: Model) -> Model:
    """Model with one row in place of rows that are alike, or with one half of a symmetric ring.

    A wall that is the same all around keeps flow, pressure and radius so: neither viscous exchange nor the
    continuity condition tells rows apart. One that is symmetric about φ = 0 and π keeps them symmetric. Where
    neither holds, or rows share the pressure of their section, the model stays as it is.
    """
    grid = model.grid
    if grid.n_phi == 1 or grid.mirrored or model.section_wall is not None:
        return model
    if _alike(model, np.zeros(grid.n_phi, dtype=int)):
        return _with_rows(model, Grid(grid.length, grid.n_x, 1))
    half = grid.n_phi // 2
    if grid.n_phi == 2 * half >= 2 * FEWEST_ROWS and _alike(model, np.arange(grid.n_phi)[::-1]):
        return _with_rows(model, Grid(grid.length, grid.n_x, half, mirrored=True))
    return model


def all_rows(values: Floats, n_phi: int) -> Floats:
    """Values (..., rows) of :func:`fewer_rows` in all rows, (..., n_phi)."""
    rows = values.shape[-1]
    if 1 < rows < n_phi:
        return np.concatenate([values, values[..., ::-1]], axis=-1)
    return values if rows == n_phi else np.broadcast_to(values, (*values.shape[:-1], n_phi))


def _alike(model: Model, other: NDArray[np.int_]) -> bool:
    """Whether the wall of each row is that of the row that ``other`` names for it."""
    table = model.wall_table
    walls = [model.stiffness] if table is None else [model.stiffness, table.values]
    return all(np.allclose(wall, wall[:, other], rtol=ROUND_OFF, atol=0) for wall in walls)


def _with_rows(model: Model, grid: Grid) -> Model:
    """Return the model with the first rows only."""
    table, rows = model.wall_table, slice(grid.n_phi)
    if table is not None:
        table = replace(table, values=np.ascontiguousarray(table.values[:, rows]))
    stiffness = np.ascontiguousarray(model.stiffness[:, rows])
    return replace(model, grid=grid, stiffness=stiffness, wall_table=table)
