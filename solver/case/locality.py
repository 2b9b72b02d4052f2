"""The error of taking a section of a membrane or a solid to answer its own pressure alone, after a run."""

import numpy as np

from cases.arrays import Floats
from cases.sections.case import Case
from solver.case.stiffness import wall_on_grid
from solver.case.wall import has_section_pressure, whole_wall_of
from solver.geometry.grid import Grid
from solver.wall.sections import SectionWall

LARGEST = 1e-3  # share of the radius beyond which the assumption fails


def widest(pressure: Floats) -> Floats:
    """Section pressures (n_x,) at the instant at which they vary most along the artery.

    Parameters
    ----------
    pressure : ndarray (n_times, n_x, n_phi)
        Pa.
    """
    sections = pressure[..., 0]
    return np.asarray(sections[int(np.argmax(np.ptp(sections, axis=1)))])


def wall_locality_error(case: Case, tables: SectionWall | None, pressure: Floats) -> float | None:
    """Largest relative error of R in a state, (n_x,) section pressures in Pa; None where nothing is assumed.

    Tables reach below P₀ by continuation only: a state there is not judged.
    """
    grid = Grid(case.geometry.length, case.solver.n_x, case.solver.n_phi)
    own = wall_on_grid(case, grid)
    whole = whole_wall_of(case, grid, own)
    if whole is None or tables is None or not has_section_pressure(case):
        return None
    if np.min(pressure) <= own.reference_pressure:
        return None
    return tables.locality_error(whole.radii(pressure - own.reference_pressure), pressure)


def locality_warning(error: float | None) -> str | None:
    """Say that the assumption fails; None where it holds."""
    if error is None or error <= LARGEST:
        return None
    return (
        f"the wall's radius is off by up to {error:.2%}: the pressure varies too much along the artery "
        "for a section's shape to follow from its own pressure alone (docs/coupled_model.md)"
    )
