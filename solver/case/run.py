"""Run a checked case with whichever scheme it names."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from cases.arrays import Floats
from cases.sections.case import Case
from solver.case.godunov import walk_godunov
from solver.case.locality import wall_locality_error, widest
from solver.case.model import model_of
from solver.case.semi_implicit import walk_semi_implicit
from solver.marching.semi_implicit import Progress, checked_times
from solver.marching.walk import Kept, Stop, history_of
from solver.model.parameters import Model
from solver.runs.result import cell_dataset

if TYPE_CHECKING:
    import xarray as xr

SCHEMES = {"godunov": walk_godunov, "semi_implicit": walk_semi_implicit}


def walk(case: Case, model: Model, times: Floats, kept: Kept | None = None) -> Iterator[Stop]:
    """Run a case through ``times`` (s) with its scheme.

    The first stop is the start, or where ``kept`` was left: from there the run goes on to the same bits as
    one that was not interrupted.

    Raises
    ------
    SolverError
        As the scheme raises it.
    """
    return SCHEMES[case.solver.scheme](case, model, times, kept)


def counts(case: Case, steps: int, sweeps: int, longest_step: float) -> dict[str, Any]:
    """Global attributes that say how a result was computed."""
    found: dict[str, Any] = {"scheme": case.solver.scheme, "time_step_s": longest_step, "steps": steps}
    return found if case.solver.scheme == "godunov" else found | {"iteration_sweeps": sweeps}


def run_case(case: Case, times: ArrayLike, progress: Progress | None = None) -> xr.Dataset:
    """Run a case in memory through ``times`` (s, from 0); see :func:`solver.runs.result.cell_dataset`.

    Raises
    ------
    SolverError
        As the scheme raises it.
    """
    model, wanted = model_of(case), checked_times(times, case.solver.time_step)
    stops = []
    for stop in walk(case, model, wanted):
        stops.append(stop)
        if progress:
            progress(stop.time, float(wanted[-1]))
    longest = max(stop.longest_step for stop in stops)
    found = counts(case, stops[-1].steps, stops[-1].sweeps, longest)
    history = history_of(stops)
    error = wall_locality_error(case, model.section_wall, widest(history.pressure))
    if error is not None:
        found["wall_locality_error"] = error
    return cell_dataset(model, history).assign_attrs(found)
