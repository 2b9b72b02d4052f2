"""A wall with a smooth calcified patch for the Godunov scheme: β and ∂_xβ in cells and on both ends."""

from dataclasses import dataclass

import numpy as np

from cases.arrays import Floats
from solver.errors import ModelError
from solver.geometry.calcification import Patch, distance_around
from solver.geometry.grid import Grid


@dataclass(frozen=True)
class SmoothWall:
    """Wall stiffness on the columns inlet, cells 1 … n_x, outlet.

    Attributes
    ----------
    stiffness : ndarray (n_x + 2, n_phi)
        β, Pa m.
    slope : ndarray (n_x + 2, n_phi)
        ∂_xβ, Pa.
    """

    stiffness: Floats
    slope: Floats


def column_places(grid: Grid) -> Floats:
    """Places x of the columns, m, (n_x + 2,): the inlet, the cells' centres, the outlet."""
    return np.concatenate(([0.0], grid.x, [grid.length]))


def smooth_wall(grid: Grid, patch: Patch | None, healthy: float, calcified: float) -> SmoothWall:
    """β of a patch and its derivative ∂_xβ = (x − x_m)/((ξ^x)² d) · π(β_H − β_C)/2 · sin(πd) (2.2.60–61).

    Parameters
    ----------
    grid : Grid
    patch : Patch or None
        None for a uniform wall.
    healthy, calcified : float
        β_H and β_C, Pa m.

    Raises
    ------
    ModelError
        For a patch with a sharp edge, whose ∂_xβ this scheme cannot represent.
    """
    x = column_places(grid)
    if patch is None:
        uniform = np.full((x.size, grid.n_phi), float(healthy))
        return SmoothWall(uniform, np.zeros_like(uniform))
    if patch.x_transition is None or (patch.phi is not None and patch.phi_transition is None):
        raise ModelError(
            "scheme godunov needs a smooth calcification (its source holds ∂β/∂x): give transition lengths"
        )
    offset = (x - np.clip(x, *patch.x)) / patch.x_transition
    distance = np.hypot(offset[:, None], _distance_around(grid, patch)[None, :])
    near = (distance > 0) & (distance < 1)
    direction = np.divide(offset[:, None], distance, out=np.zeros_like(distance), where=near)
    slope = direction / patch.x_transition * np.pi * (healthy - calcified) / 2 * np.sin(np.pi * distance)
    share = 0.5 - 0.5 * np.cos(np.pi * np.minimum(distance, 1.0))
    return SmoothWall(calcified + (healthy - calcified) * share, slope)


def _distance_around(grid: Grid, patch: Patch) -> Floats:
    """Scaled distance of each row to the patch, periodic, (n_phi,)."""
    if patch.phi is None or patch.phi_transition is None:
        return np.zeros(grid.n_phi)
    return distance_around(grid.phi, *patch.phi) / patch.phi_transition
