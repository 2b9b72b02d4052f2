"""The wall of a checked case on the grid: β in every cell, and a table for a nonlinear law."""

from dataclasses import dataclass

import numpy as np

from cases.arrays import Floats
from cases.sections.calcification import AxialTransition, LocalCalcification, Part, PatchTransition
from cases.sections.case import Case
from cases.sections.wall import row_wall
from cases.sections.wall_laws import LAWS
from cases.sections.wall_laws.hyperelastic import HyperelasticWall
from cases.sections.wall_laws.law import CurveWall, HomogeneousWall
from solver.errors import ModelError
from solver.geometry.calcification import Patch, calcified_stiffness, scaled_distance
from solver.geometry.grid import Grid
from solver.wall.finite_strain import inflation_curve
from solver.wall.incompressible import incompressible_curve
from solver.wall.table import MasterCurve, WallTable, wall_table

# loads that a nonlinear wall is tabulated for, as shares of the healthy Young's modulus
LOWEST_LOAD, HIGHEST_LOAD = -0.04, 0.12


@dataclass(frozen=True)
class WallOnGrid:
    """β in every cell (n_x, n_phi), Pa m, P₀, Pa, and the table of a nonlinear law."""

    stiffness: Floats
    reference_pressure: float
    table: WallTable | None = None


def patch_of(stated: Part) -> Patch:
    """Rectangle of one calcified part of a case."""
    transition = stated.transition
    return Patch(
        x=stated.x,
        phi=stated.phi if isinstance(stated, LocalCalcification) else None,
        x_transition=transition.x if isinstance(transition, AxialTransition | PatchTransition) else None,
        phi_transition=transition.phi if isinstance(transition, PatchTransition) else None,
    )


def _modulus_on_grid(case: Case, grid: Grid, healthy: float) -> Floats:
    """Young's modulus of a calcifying material in every cell, Pa; of several parts the largest change."""
    modulus = np.full((grid.n_x, grid.n_phi), healthy)
    for part in case.calcification.parts:
        distance = scaled_distance(grid, patch_of(part))
        if not np.any(distance < 1):
            raise ModelError(
                f"calcification: the {part.pattern} one from x = {part.x[0]:g} m holds no centre of a cell; "
                f"allowed: one that does on {grid.n_x} x {grid.n_phi} cells"
            )
        own = calcified_stiffness(healthy, part.youngs_modulus, distance)
        modulus = np.where(np.abs(own - healthy) > np.abs(modulus - healthy), own, modulus)
    return modulus


def moduli_on_grid(case: Case, grid: Grid) -> list[Floats]:
    """Young's modulus of each layer of a case's wall in every cell, Pa.

    Raises
    ------
    ModelError
        If a calcified part changes no cell.
    """
    return [
        _modulus_on_grid(case, grid, layer.youngs_modulus)
        if layer.calcifies
        else np.full((grid.n_x, grid.n_phi), layer.youngs_modulus)
        for layer in row_wall(case.wall).layers_within(case.geometry.wall_thickness)
    ]


def healthy_and_calcified(case: Case) -> tuple[float, float]:
    """β of the healthy and of the calcified wall of one linear material, Pa m; equal without calcification.

    Raises
    ------
    ModelError
        For another law, or several calcified parts.
    """
    wall, geometry, parts = case.wall, case.geometry, case.calcification.parts
    if len(parts) > 1:
        raise ModelError(f"{len(parts)} calcified patches; allowed here: one")
    if not isinstance(wall, HomogeneousWall) or not wall.linear:
        allowed = [name for name, law in LAWS.items() if law.linear and issubclass(law, HomogeneousWall)]
        raise ModelError(f"wall law {wall.law!r}; allowed here: {', '.join(allowed)}")
    calcified = parts[0].youngs_modulus if parts else wall.youngs_modulus
    moduli = np.array([wall.youngs_modulus, calcified])
    betas = wall.stiffness([moduli], geometry.radius, geometry.wall_thickness)
    return float(betas[0]), float(betas[1])


def wall_on_grid(case: Case, grid: Grid) -> WallOnGrid:
    """Wall of a case, row by row; of a membrane its base.

    Raises
    ------
    ModelError
        If the law is known for no pressure of interest.
    """
    wall, sizes = row_wall(case.wall), (case.geometry.radius, case.geometry.wall_thickness)
    moduli = moduli_on_grid(case, grid)
    stiffness, start = wall.stiffness(moduli, *sizes), wall.unloaded_pressure(sizes[0])
    if not isinstance(wall, HyperelasticWall | CurveWall):
        return WallOnGrid(stiffness, start)
    curve, lowest, highest = _load_curve(wall, *sizes)
    relative = moduli[0] / wall.layers_within(sizes[1])[0].youngs_modulus
    return WallOnGrid(stiffness, start, wall_table(curve, relative, start, start + lowest, start + highest))


def _load_curve(
    wall: HyperelasticWall | CurveWall, radius: float, thickness: float
) -> tuple[MasterCurve, float, float]:
    """Curve of a nonlinear law's healthy wall, and the loads from and to which it is tabulated, Pa."""
    if isinstance(wall, HyperelasticWall):
        healthy = wall.youngs_modulus
        ends = LOWEST_LOAD * healthy, HIGHEST_LOAD * healthy
        if wall.poisson_ratio == 0.5:
            return incompressible_curve(wall.stresses, healthy, radius, thickness, *ends), *ends
        sizes = wall.poisson_ratio, radius, thickness
        return inflation_curve(wall.stresses, healthy, *sizes, *ends), *ends
    curve = MasterCurve(*wall.load_curve(radius))
    return curve, float(curve.loads[0]), float(curve.loads[-1])
