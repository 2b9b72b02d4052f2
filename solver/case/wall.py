"""From a checked case to the wall that the flow sees: rows or sections, springs, a membrane or a solid."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np

from cases.arrays import Floats
from cases.sections.case import Case
from cases.sections.solver import SemiImplicitSolver
from cases.sections.wall import MembraneWall, SolidWall, row_wall
from solver.case.stiffness import WallOnGrid, moduli_on_grid, wall_on_grid
from solver.geometry.grid import Grid
from solver.wall.sections import SectionWall, linear_section_wall, row_table, tabulated_section_wall
from solver.wall.table import WallTable

NONLINEAR_GROWTH = 0.25  # R/R₀ − 1 of the softest row of a nonlinear base at the highest pressure


class WholeWall(NamedTuple):
    """A wall that answers as a whole: tables of its sections, and R, m, under section loads P − P₀, Pa."""

    section_wall: Callable[[], SectionWall]
    radii: Callable[[Floats], Floats]


@dataclass(frozen=True)
class Walls:
    """β of the row law in every cell, Pa m, P₀, Pa, and tables: of rows, or of sections."""

    stiffness: Floats
    reference_pressure: float
    of_rows: WallTable | None = None
    of_sections: SectionWall | None = None


def has_section_pressure(case: Case) -> bool:
    """Whether a case asks for one pressure a section."""
    return isinstance(case.solver, SemiImplicitSolver) and case.solver.pressure == "section"


def walls_of(case: Case, grid: Grid) -> Walls:
    """Wall of a case.

    Raises
    ------
    ModelError
        If the law is known for no pressure of interest, or a wall buckles, runs away or folds.
    """
    own = wall_on_grid(case, grid)
    whole = whole_wall_of(case, grid, own)
    known = own.stiffness, own.reference_pressure
    if whole is not None:
        table = whole.section_wall()
        if has_section_pressure(case):
            return Walls(*known, of_sections=table)
        return Walls(*known, of_rows=row_table(table))
    if not has_section_pressure(case):
        return Walls(*known, of_rows=own.table)
    if own.table is not None:
        return Walls(*known, of_sections=tabulated_section_wall(own.table))
    table = linear_section_wall(own.stiffness, case.geometry.radius, own.reference_pressure)
    return Walls(*known, of_sections=table)


def whole_wall_of(case: Case, grid: Grid, own: WallOnGrid) -> WholeWall | None:
    """Return the membrane or solid of a case whose rows by themselves are ``own``; None for another wall."""
    if isinstance(case.wall, MembraneWall):
        return _membrane(case, case.wall, grid, own)
    if isinstance(case.wall, SolidWall):
        return _solid(case, case.wall, grid, own)
    return None


def _highest_load(case: Case, own: WallOnGrid) -> float:
    """Largest load to tabulate by the growth of the softest row at small strain, Pa."""
    from solver.wall import membrane_tables

    return membrane_tables.HIGHEST_GROWTH * float(np.min(own.stiffness)) / case.geometry.radius


def _solid(case: Case, wall: SolidWall, grid: Grid, own: WallOnGrid) -> WholeWall:
    from solver.wall import solid_tables
    from solver.wall.solid import Solid

    around, layers, along = wall.elements
    (moduli,) = moduli_on_grid(case, Grid(grid.length, along, around))
    geometry = case.geometry
    solid = Solid(
        geometry.length, geometry.radius, geometry.wall_thickness, moduli, wall.poisson_ratio, layers
    )
    whole = solid_tables.SolidWall(grid, solid, own.reference_pressure, _highest_load(case, own))
    return WholeWall(partial(solid_tables.section_wall, whole), partial(solid_tables.radii, whole))


def _membrane(case: Case, wall: MembraneWall, grid: Grid, own: WallOnGrid) -> WholeWall:
    from solver.wall import membrane_tables

    radius, thickness = case.geometry.radius, case.geometry.wall_thickness
    highest = _highest_load(case, own)
    if own.table is not None:
        highest = min(highest, _load_of_growth(own.table, radius, own.reference_pressure))

    def secant_stiffness(load: float) -> Floats:
        if own.table is None:
            return own.stiffness
        pressure = np.full(own.stiffness.shape, own.reference_pressure + load)
        return np.asarray(load * radius**2 / (np.sqrt(own.table.area(pressure)) - radius))

    whole = membrane_tables.MembraneWall(
        grid=grid,
        radius=radius,
        reference_pressure=own.reference_pressure,
        stiffness=secant_stiffness,
        shear=row_wall(wall).shear_stiffness(moduli_on_grid(case, grid), thickness, wall.poisson_ratio),
        supports=wall.supports,
        highest_load=highest,
    )
    return WholeWall(partial(membrane_tables.section_wall, whole), partial(membrane_tables.radii, whole))


def _load_of_growth(table: WallTable, radius: float, reference_pressure: float) -> float:
    """Largest tabulated load up to which every row's radius grows moderately, Pa; beyond it may run away."""
    pressures = table.start + table.step * np.arange(table.values.shape[2])
    moderate = np.max(table.values[..., 0], axis=(0, 1)) <= (1 + NONLINEAR_GROWTH) * radius
    return float(np.max(pressures[moderate]) - reference_pressure)
