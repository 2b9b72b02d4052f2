"""The wall of a checked case on the grid: β in every cell, and a table for a nonlinear law."""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator

from cases.arrays import Floats
from cases.sections.calcification import AxialTransition, LocalCalcification, Part, PatchTransition
from cases.sections.case import Case
from cases.sections.wall import HomogeneousWall, LayeredWall, TableWall, row_wall
from solver.errors import ModelError
from solver.geometry.calcification import Patch, calcified_stiffness, scaled_distance
from solver.geometry.grid import Grid
from solver.wall.finite_strain import inflation_curve
from solver.wall.layers import Layer, layered_wall_stiffness
from solver.wall.stiffness import WALL_LAWS, thick_wall_stiffness, wall_stiffness
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


def modulus_on_grid(case: Case, grid: Grid, healthy: float) -> Floats:
    """Young's modulus of a calcifying material in every cell, Pa; of several parts the largest change.

    Raises
    ------
    ModelError
        If a calcified part changes no cell.
    """
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


def healthy_and_calcified(case: Case) -> tuple[float, float]:
    """β of the healthy and of the calcified wall of law thin or thick, Pa m; equal without calcification.

    Raises
    ------
    ModelError
        For another law, or several calcified parts.
    """
    wall, geometry, parts = case.wall, case.geometry, case.calcification.parts
    if len(parts) > 1:
        raise ModelError(f"{len(parts)} calcified patches; allowed here: one")
    if not isinstance(wall, HomogeneousWall) or wall.law not in WALL_LAWS:
        raise ModelError(f"wall law {wall.law!r}; allowed here: {', '.join(WALL_LAWS)}")
    calcified = parts[0].youngs_modulus if parts else wall.youngs_modulus
    moduli = np.array([wall.youngs_modulus, calcified])
    betas = wall_stiffness(wall.law, moduli, geometry.radius, geometry.wall_thickness, wall.poisson_ratio)
    return float(betas[0]), float(betas[1])


def wall_on_grid(case: Case, grid: Grid) -> WallOnGrid:
    """Wall of a case, row by row; of a membrane its base.

    Raises
    ------
    ModelError
        If the law is known for no pressure of interest.
    """
    wall, geometry = row_wall(case.wall), case.geometry
    if isinstance(wall, LayeredWall):
        layers = [
            Layer(
                layer.thickness,
                modulus_on_grid(case, grid, layer.youngs_modulus)
                if layer.calcifies
                else layer.youngs_modulus,
            )
            for layer in wall.layers
        ]
        stiffness = layered_wall_stiffness(layers, geometry.radius, wall.poisson_ratio)
        return WallOnGrid(np.broadcast_to(stiffness, (grid.n_x, grid.n_phi)).copy(), wall.reference_pressure)
    modulus = modulus_on_grid(case, grid, wall.youngs_modulus)
    if isinstance(wall, TableWall):
        return _tabulated(case, wall, modulus)
    if wall.law in WALL_LAWS:
        stiffness = wall_stiffness(
            wall.law, modulus, geometry.radius, geometry.wall_thickness, wall.poisson_ratio
        )
        return WallOnGrid(stiffness, wall.reference_pressure)
    return _finite_strain(case, wall, modulus)


def _finite_strain(case: Case, wall: HomogeneousWall, modulus: Floats) -> WallOnGrid:
    geometry, healthy = case.geometry, wall.youngs_modulus
    sizes = (wall.poisson_ratio, geometry.radius, geometry.wall_thickness)
    low, high = LOWEST_LOAD * healthy, HIGHEST_LOAD * healthy
    curve = inflation_curve(wall.law, healthy, *sizes, low, high)
    stiffness = thick_wall_stiffness(modulus, geometry.radius, geometry.wall_thickness, wall.poisson_ratio)
    start = wall.reference_pressure
    table = wall_table(curve, modulus / healthy, start, start + low, start + high)
    return WallOnGrid(stiffness, start, table)


def _tabulated(case: Case, wall: TableWall, modulus: Floats) -> WallOnGrid:
    """User's P(R), its loads scaled by E; P₀ is its pressure at the unloaded radius."""
    radius = case.geometry.radius
    pressure_of = PchipInterpolator(wall.table.radii, wall.table.pressures)
    start = float(pressure_of(radius))
    relative = modulus / wall.youngs_modulus
    loads = wall.table.pressures - start
    radius_of = PchipInterpolator(loads, wall.table.radii)
    curve = MasterCurve(loads, wall.table.radii, radius_of.derivative()(loads))
    stiffness = relative * radius**2 / float(radius_of.derivative()(0.0))
    table = wall_table(curve, relative, start, start + float(loads[0]), start + float(loads[-1]))
    return WallOnGrid(stiffness, start, table)
