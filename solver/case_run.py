"""Run a checked case in memory, with whichever scheme it names."""

import xarray as xr
from numpy.typing import ArrayLike

from cases.schema import Case
from solver.from_case import error_tolerance, initial_state, model_of
from solver.godunov_case import run_godunov
from solver.locality import wall_locality_error, widest
from solver.result import to_dataset
from solver.simulate import Progress, simulate


def run_case(case: Case, times: ArrayLike, progress: Progress | None = None) -> xr.Dataset:
    """Run a case through ``times`` (s, from 0); see :func:`solver.result.cell_dataset`.

    Raises
    ------
    SolverError
        As the scheme raises it.
    """
    if case.solver.scheme == "godunov":
        return run_godunov(case, times, progress)
    model = model_of(case)
    start = initial_state(case, model)
    trajectory = simulate(model, times, case.solver.time_step, start, progress, error_tolerance(case))
    dataset = to_dataset(trajectory)
    error = wall_locality_error(case, model.section_wall, widest(trajectory.pressure))
    return dataset if error is None else dataset.assign_attrs(wall_locality_error=error)
