"""What the reduced model's grid and time step leave open, from runs coarser and finer than its own."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr

from cases.arrays import Floats
from cases.fields import FIELDS
from cases.quantities import reads
from cases.sections.case import Case
from solver.case.run import run_case
from validation.compare.budget.discretization import Estimate, of_middle_level
from validation.compare.budget.judged import judged_quantities
from validation.converge.refinement import STUDIES, levels
from validation.metrics.quantities import values_of
from validation.metrics.statistics import relative_error, rms
from validation.reference.alignment import Alignment
from validation.reference.kind import Progress
from validation.runs.reduced_model import COMPARED, run_times

OF_SECTORS = ("sector_flow_rate",)  # sums over a cell's angle, not means

Changes = dict[str, dict[str, tuple[float, float]]]


@dataclass(frozen=True)
class Numerical:
    """What grid and step leave open of one quantity; an ``uncertainty`` is relative."""

    grid: Estimate
    step: Estimate

    @property
    def uncertainty(self) -> float:
        """Root of the sum of both squares."""
        return float(np.hypot(self.grid.uncertainty, self.step.uncertainty))


def last_cycle(case: Case, alignment: Alignment, progress: Progress | None = None) -> xr.Dataset:
    """Compared fields of a run at the instants of a reference, ``time`` counted from the cycle's start.

    Raises
    ------
    SolverError
        As the solver raises it.
    """
    dataset = run_case(case, run_times(case, alignment.rom_times), progress)
    kept = dataset[[name for name in COMPARED if name in dataset]].sel(time=alignment.rom_times)
    return kept.assign_coords(time=alignment.cycle_times)


def ladder_changes(
    case: Case, own: xr.Dataset, alignment: Alignment, progress: Progress | None = None
) -> Changes:
    """Root-mean-square changes of all quantities from coarse to own and from own to fine, by study.

    Parameters
    ----------
    case : Case
    own : xarray.Dataset
        Fields of its run at the instants of ``alignment``.
    alignment : Alignment
    progress : callable, optional

    Raises
    ------
    SolverError, ValidationError
        As the solver raises it, and for a grid that cannot be halved.
    """
    found: Changes = {}
    for study in STUDIES:
        coarse, _, fine = levels(case, study)
        runs = (last_cycle(coarse, alignment, progress), own, last_cycle(fine, alignment, progress))
        found[study] = dict(_changes(*runs))
    return found


def _changes(coarse: xr.Dataset, own: xr.Dataset, fine: xr.Dataset) -> dict[str, tuple[float, float]]:
    changes = {}
    for quantity in judged_quantities():
        if not all(name in coarse for name in reads(quantity)):
            continue  # profiles of two modes have no exponent
        first = relative_error(values_of(quantity, coarse), on_cells_of(coarse, quantity, own))
        second = relative_error(on_cells_of(own, quantity, fine), values_of(quantity, own))
        if first is not None and second is not None:
            changes[quantity] = (rms(first), rms(second))
    return changes


def on_cells_of(coarse: xr.Dataset, quantity: str, fine: xr.Dataset) -> Floats:
    """Values of a quantity, averaged over the cells of a finer grid that make one of a coarser grid's."""
    values = values_of(quantity, fine)
    for axis, name in enumerate(FIELDS[quantity].dims):
        each = fine.sizes[name] // coarse.sizes[name]
        if each > 1:
            shape = (*values.shape[:axis], coarse.sizes[name], each, *values.shape[axis + 1 :])
            values = values.reshape(shape).mean(axis=axis + 1)
            values = each * values if name == "phi" and quantity in OF_SECTORS else values
    return values


def numerical_uncertainty(changes: Changes) -> Mapping[str, Numerical]:
    """Uncertainty of each quantity that has changes in grid and step."""
    grid, step = (changes[study] for study in STUDIES)
    return {
        quantity: Numerical(of_middle_level(*grid[quantity]), of_middle_level(*step[quantity]))
        for quantity in grid
        if quantity in step
    }
