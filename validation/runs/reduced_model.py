"""The reduced model's last cycle at the reference's instants, on the same rays."""

from dataclasses import dataclass
from time import perf_counter
from typing import Any

import numpy as np
import xarray as xr

from cases.arrays import Floats
from cases.sections.case import Case
from cases.sections.solver import SemiImplicitSolver
from cases.sections.wall import MembraneWall
from solver.case.model import two_modes_of
from solver.case.periodicity import cycle_change
from solver.case.run import run_case
from solver.case.wall import has_section_pressure
from solver.model.cross_flow import azimuthal_velocity, radial_velocity
from solver.model.profiles import AVERAGE_EXPONENT, axis_ratio, shape
from validation.mapping.derived import as_dataset, dominance
from validation.mapping.meshed_profiles import closest_meshed_profile
from validation.mapping.nodal_shares import TwoRings
from validation.mapping.rays import Rays
from validation.reference.alignment import Alignment
from validation.reference.kind import Progress

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


def run_times(case: Case, instants: Floats) -> Floats:
    """Return the times through which a run goes to stop at instants of its last cycle, s.

    Parameters
    ----------
    case : Case
        The case.
    instants : ndarray (n,)
        Times within the last cycle, counted from the start of the run, s.
    """
    period, cycles = case.inlet.period, case.solver.cycles
    begin, end = (cycles - 1) * period, cycles * period
    milestones = np.linspace(0.0, begin, 10 * (cycles - 1) + 1)
    return np.unique(np.concatenate([milestones, instants, [end]]))


def compile_kernels(case: Case) -> None:
    """Take one step of a case, so that compiling what is new is no part of a run that is timed.

    Raises
    ------
    SolverError
        As the solver raises it.
    """
    run_case(case, np.array([0.0, case.solver.time_step]))


def run_reduced_model(
    case: Case,
    alignment: Alignment,
    rays: Rays,
    progress: Progress | None = None,
    along_rays: bool = True,
) -> ReducedModelRun:
    """Simulate all cycles of a case; keep the states at the reference's instants.

    Velocities along rays, and what is derived of them, are left out where they are not asked for.

    Steps end on each of these instants, so that nothing is interpolated in time.

    Raises
    ------
    SolverError
        As the solver raises it.
    """
    start = perf_counter()
    dataset = run_case(case, run_times(case, alignment.rom_times), progress)
    took = {"simulation_wall_time_s": round(perf_counter() - start, 3)}
    kept = dataset.sel(time=alignment.rom_times)
    values = {name: kept[name].to_numpy() for name in COMPARED if name in kept}
    values |= _power(values, rays) if "profile_exponent" in values else _two_modes(case, kept, rays)
    if along_rays:
        values |= _across(values, kept.get("azimuthal_flux"), rays)
    values["section_pressure_range"] = np.ptp(values["pressure"], axis=-1)
    change = change_of(case, dataset)
    return ReducedModelRun(
        fields=as_dataset(values, rays, alignment.cycle_times),
        stiffness=dataset["wall_stiffness"],
        cycle_change=change,
        description=_description(case, dataset) | {"cycle_change": change} | _locality(dataset) | took,
    )


def _power(values: dict[str, Floats], rays: Rays) -> dict[str, Floats]:
    """v_x and D of profiles with one exponent."""
    u, gamma = values["mean_velocity"], values["profile_exponent"]
    axial = u[..., None] * shape(rays.y, gamma[..., None])
    axis = u * axis_ratio(gamma)
    return {
        "axial_velocity": axial.astype(np.float32),
        "axis_velocity": axis.mean(axis=-1),
        "axis_velocity_spread": np.ptp(axis, axis=-1) / np.abs(axis).mean(axis=-1),
    }


def _two_modes(case: Case, kept: xr.Dataset, rays: Rays) -> dict[str, Floats]:
    """v_x, D and B of profiles of two modes, and the exponent of the closest profile that has one."""
    modes = two_modes_of(case.solver)
    if modes is None:
        raise ValueError("a run without exponents of a case without two modes")
    d, bend = kept["axis_velocity"].to_numpy(), kept["profile_bend"].to_numpy()
    axial = modes.velocity(rays.y, np.broadcast_to(d[..., None], bend.shape), bend)
    flat = axial.reshape(-1, rays.y.size)
    points = np.broadcast_to(rays.y, flat.shape).copy()
    own = closest_meshed_profile(flat, rays.y, TwoRings(points, points, np.zeros(flat.shape)))
    return {
        "axial_velocity": axial.astype(np.float32),
        "axis_velocity": d,
        "axis_velocity_spread": np.zeros(d.shape),
        "profile_bend": bend,
        "profile_exponent": own.exponent.reshape(bend.shape),
    }


def _across(values: dict[str, Floats], flux: xr.DataArray | None, rays: Rays) -> dict[str, Floats]:
    """v_r, and v_φ where rows exchange blood, with their ratios to v_x.

    Beside two modes both are given the shapes of Poiseuille's profile.
    """
    radius, u, gamma = (values[name] for name in ("radius", "mean_velocity", "profile_exponent"))
    if "profile_bend" in values:
        gamma = np.full(gamma.shape, AVERAGE_EXPONENT)
    crossing = None if flux is None else flux.to_numpy()
    spacing = float(rays.x[1] - rays.x[0]), rays.dphi
    radial = radial_velocity(radius, u, gamma, crossing, spacing, rays.y)
    axial = values["axial_velocity"]
    found: dict[str, Floats] = {
        "radial_velocity": np.asarray(radial, dtype=np.float32),
        "axial_dominance_radial": dominance(axial, radial).max(axis=0),
    }
    if crossing is None:
        return found
    azimuthal = azimuthal_velocity(radius, gamma, crossing, rays.y)
    return found | {
        "azimuthal_flux": crossing,
        "azimuthal_velocity": np.asarray(azimuthal, dtype=np.float32),
        "axial_dominance_azimuthal": dominance(axial, azimuthal).max(axis=0),
    }


def change_of(case: Case, dataset: xr.Dataset) -> float:
    """Return the change over the last cycle of a run through :func:`run_times`, which have both its ends."""
    change = cycle_change(case, dataset)
    if change is None:
        raise ValueError("a run without the ends of its last cycle")
    return change


def _locality(dataset: xr.Dataset) -> dict[str, float]:
    """Error of taking a membrane's section by itself, where the run tells one."""
    name = "wall_locality_error"
    return {name: float(dataset.attrs[name])} if name in dataset.attrs else {}


def wall_words(case: Case) -> str:
    """Wall law of a case; of a membrane with its base."""
    return f"membrane on {case.wall.base}" if isinstance(case.wall, MembraneWall) else case.wall.law


def pressure_of(case: Case) -> str:
    """Tell what has a pressure of its own in a case: each row or each section."""
    return "section" if has_section_pressure(case) else "row"


def profile_of(case: Case) -> str:
    """Name the family of a case's velocity profiles."""
    return case.solver.profile if isinstance(case.solver, SemiImplicitSolver) else "power"


def _description(case: Case, dataset: xr.Dataset) -> dict[str, Any]:
    return {
        "scheme": case.solver.scheme,
        "n_x": case.solver.n_x,
        "n_phi": case.solver.n_phi,
        "time_step_s": dataset.attrs["time_step_s"],
        "steps": dataset.attrs["steps"],
        "cycles": case.solver.cycles,
        "wall_law": wall_words(case),
        "pressure": pressure_of(case),
        "profile": profile_of(case),
        "closure": case.solver.closure,
        "viscosity_Pa_s": case.blood.viscosity,
    }
