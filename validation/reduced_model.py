"""The reduced model's last cycle at the reference's instants, on the same rays."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from cases.schema import Case
from solver.case_run import run_case
from solver.profiles import axis_ratio, shape
from validation.alignment import Alignment
from validation.derived import as_dataset
from validation.rays import Rays
from validation.reference import Progress

COMPARED = (
    "pressure",
    "radius",
    "mean_velocity",
    "profile_exponent",
    "sector_flow_rate",
    "section_flow_rate",
    "section_pressure",
    "mass_defect",
)


@dataclass(frozen=True)
class ReducedModelRun:
    """Fields of one run and what to say of it.

    ``fields`` as those of a reference, where the reduced model has them; ``cycle_change`` is the
    largest relative change of pressure and flow rate over the last cycle, 0 for a periodic run.
    """

    fields: xr.Dataset
    stiffness: xr.DataArray
    cycle_change: float
    description: dict[str, Any]


def run_reduced_model(
    case: Case, alignment: Alignment, rays: Rays, progress: Progress | None = None
) -> ReducedModelRun:
    """Simulate all cycles of a case; keep the states at the reference's instants.

    Steps end on each of these instants, so that nothing is interpolated in time.

    Raises
    ------
    SolverError
        As the solver raises it.
    """
    period, cycles = case.inlet.period, case.solver.cycles
    begin, end = (cycles - 1) * period, cycles * period
    milestones = np.linspace(0.0, begin, 10 * (cycles - 1) + 1)
    times = np.unique(np.concatenate([milestones, alignment.rom_times, [end]]))
    dataset = run_case(case, times, progress)
    kept = dataset.sel(time=alignment.rom_times)
    values = {name: kept[name].to_numpy() for name in COMPARED}
    u, gamma = values["mean_velocity"], values["profile_exponent"]
    axial = u[..., None] * shape(rays.y, gamma[..., None])
    axis = u * axis_ratio(gamma)
    values["axial_velocity"] = axial.astype(np.float32)
    values["section_pressure_range"] = np.ptp(values["pressure"], axis=-1)
    values["axis_velocity_spread"] = np.ptp(axis, axis=-1) / np.abs(axis).mean(axis=-1)
    first, last = dataset.sel(time=begin), dataset.sel(time=end)
    change = max(_relative_change(first[name], last[name]) for name in ("pressure", "section_flow_rate"))
    return ReducedModelRun(
        fields=as_dataset(values, rays, alignment.cycle_times),
        stiffness=dataset["wall_stiffness"],
        cycle_change=change,
        description=_description(case, dataset) | {"cycle_change": change},
    )


def _relative_change(first: xr.DataArray, last: xr.DataArray) -> float:
    return float(np.max(np.abs(last - first)) / np.max(np.abs(first)))


def _description(case: Case, dataset: xr.Dataset) -> dict[str, Any]:
    return {
        "scheme": case.solver.scheme,
        "n_x": case.solver.n_x,
        "n_phi": case.solver.n_phi,
        "time_step_s": dataset.attrs["time_step_s"],
        "steps": dataset.attrs["steps"],
        "cycles": case.solver.cycles,
        "wall_law": case.wall.law,
        "closure": case.solver.closure,
        "viscosity_Pa_s": case.blood.viscosity,
    }
