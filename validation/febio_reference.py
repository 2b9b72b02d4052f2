"""``reference.kind: febio``: a FEBio plot file on the cells of the reduced model."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from cases.schema import Case, FebioReference
from febio_io.xplt import Plot, open_plot
from solver.from_case import inlet_signal
from validation.alignment import Alignment, align
from validation.derived import derived_fields
from validation.errors import UnusableReferenceError
from validation.febio_log import account_of_log
from validation.febio_records import account_of_record
from validation.frame import Frame, frame
from validation.mapping import MappedState, Mapper
from validation.mesh import LumenMesh, lumen_mesh
from validation.plane_section import lumen_grid, plane_flow_rate
from validation.plot_file import (
    DISPLACEMENT,
    VELOCITY,
    blocks,
    choose_domains,
    nodal_vectors,
    pressure_reader,
    require,
)
from validation.provenance import shown_path
from validation.rays import Rays
from validation.reference import Progress, Reference

RADIUS_TOLERANCE = 1e-2  # and the mean radius of its unloaded interface by this share
LENGTH_TOLERANCE = 1e-3  # the mesh's length may differ from the case's by this share


def read_febio(case: Case, rays: Rays, progress: Progress | None = None) -> Reference:
    """Map the last cycle of a FEBio run.

    Parameters
    ----------
    case : Case
        With ``reference.kind: febio``.
    rays : Rays
        Where to.
    progress : callable, optional
        Called with (states done, states).

    Raises
    ------
    FebioError
        If the plot file, the log or a data record cannot be read.
    UnusableReferenceError
        If it lacks what the mapping needs, or does not fit the case; if the log or a data record is that of
        another run.
    """
    stated = case.reference
    if not isinstance(stated, FebioReference):
        raise UnusableReferenceError("the case states no FEBio reference")
    try:
        with open_plot(stated.plot_file) as plot:
            return _read(plot, stated, case, rays, progress)
    except UnusableReferenceError as error:
        if str(stated.plot_file) in str(error):
            raise
        raise UnusableReferenceError(f"{stated.plot_file}: {error}") from error


def _read(plot: Plot, stated: FebioReference, case: Case, rays: Rays, progress: Progress | None) -> Reference:
    require(plot)
    domains = choose_domains(plot, stated)
    place = frame(stated.axis, stated.phi_zero, stated.origin)
    coordinates = place.points(plot.mesh.coordinates)
    mesh = lumen_mesh(coordinates, blocks(plot, domains.lumen), blocks(plot, domains.wall))
    _check_length(plot, mesh, case)
    _check_radius(plot, mesh, case)
    run = _beside(plot, stated)
    alignment = align(plot.times, stated.time_offset, case.inlet.period, case.solver.cycles)
    pressure = pressure_reader(plot, domains.lumen, mesh.lumen, coordinates)
    mapper, mapped = Mapper(mesh, rays), []
    for done, state in enumerate(alignment.states, start=1):
        displacement = nodal_vectors(plot, DISPLACEMENT, int(state), place)
        velocity = nodal_vectors(plot, VELOCITY, int(state), place)
        nodal_pressure = pressure(int(state))
        for name, values in (
            ("velocity", velocity),
            ("displacement", displacement),
            ("pressure", nodal_pressure),
        ):
            if not np.all(np.isfinite(values)):
                raise UnusableReferenceError(
                    f"{plot.path}: {name} of state {state + 1} is not finite everywhere"
                )
        mapped.append(mapper.map_state(displacement, velocity, nodal_pressure))
        if progress:
            progress(done, len(alignment.states))
    _check_direction(plot, mapped, alignment, case)
    return Reference(
        fields=derived_fields(mapped, rays, alignment.cycle_times),
        checks=_checks(plot, place, mesh, mapped, alignment, case, rays),
        alignment=alignment,
        description=_description(plot, alignment) | run.facts,
        notes=(*plot.warnings, *domains.notes, *run.notes),
        warnings=run.warnings,
    )


@dataclass(frozen=True)
class _Beside:
    """What the files beside the plot file tell of its run."""

    facts: dict[str, Any]
    notes: tuple[str, ...]
    warnings: tuple[str, ...]


def _beside(plot: Plot, stated: FebioReference) -> _Beside:
    """Read the log and the data records, as far as the case states them."""
    log = None if stated.log is None else account_of_log(stated.log, plot)
    records = [account_of_record(record, plot) for record in stated.data_records]
    facts: dict[str, Any] = {} if log is None else {"cost": log.cost}
    if records:
        facts["data_records"] = [record.facts for record in records]
    return _Beside(
        facts,
        notes=tuple(note for record in records for note in record.notes),
        warnings=(
            *(() if log is None else log.warnings),
            *(warning for record in records for warning in record.warnings),
        ),
    )


def _check_direction(plot: Plot, mapped: list[MappedState], alignment: Alignment, case: Case) -> None:
    """Refuse a reference whose blood flows against the prescribed inflow."""
    if case.inlet.kind == "pressure":
        return
    prescribed = float(np.mean(inlet_signal(case)(alignment.cycle_times)))
    inflow = float(np.mean(_each(mapped, "inflow")))
    if prescribed * inflow < 0:
        raise UnusableReferenceError(
            f"{plot.path}: blood flows against the inflow of the case ({inflow:.3g} m³/s on average at "
            "reference.origin): reference.axis and origin must follow the flow"
        )


def _check_length(plot: Plot, mesh: LumenMesh, case: Case) -> None:
    first = float(mesh.coordinates[mesh.inlet, 0].min())
    tolerance = LENGTH_TOLERANCE * case.geometry.length
    if abs(mesh.length - case.geometry.length) > tolerance or abs(first) > tolerance:
        raise UnusableReferenceError(
            f"{plot.path}: the lumen runs from x = {first:.6g} m over {mesh.length:.6g} m; the case's artery "
            f"starts at reference.origin and is {case.geometry.length:.6g} m long (geometry.length)"
        )


def _check_radius(plot: Plot, mesh: LumenMesh, case: Case) -> None:
    """Compare the unloaded interface with the case's unloaded radius."""
    across = mesh.coordinates[mesh.interface_nodes, 1:]
    radius = float(np.mean(np.hypot(across[:, 0], across[:, 1])))
    if abs(radius - case.geometry.radius) > RADIUS_TOLERANCE * case.geometry.radius:
        raise UnusableReferenceError(
            f"{plot.path}: the unloaded lumen's radius is {radius:.6g} m on average about reference.origin; "
            f"the case's is {case.geometry.radius:.6g} m (geometry.radius)"
        )


def _checks(
    plot: Plot,
    place: Frame,
    mesh: LumenMesh,
    mapped: list[MappedState],
    alignment: Alignment,
    case: Case,
    rays: Rays,
) -> xr.Dataset:
    """Flow rates by surface integral: through the inlet at all states, through planes at a few."""
    sections = np.array(case.compare.cells.i) - 1
    few = np.unique(np.linspace(0, len(mapped) - 1, 5).astype(int))
    grid = lumen_grid(mesh.lumen)
    planes = np.empty((few.size, sections.size))
    for row, state in enumerate(alignment.states[few]):
        points = mesh.coordinates + nodal_vectors(plot, DISPLACEMENT, int(state), place)
        velocity = nodal_vectors(plot, VELOCITY, int(state), place)
        planes[row] = [plane_flow_rate(grid, points, velocity, float(x)) for x in rays.x[sections]]
    return xr.Dataset(
        {
            "inlet_flow_rate": ("time", _each(mapped, "inflow")),
            "inlet_area": ("time", _each(mapped, "inlet_area")),
            "plane_flow_rate": (("check_time", "check_x"), planes),
        },
        coords={
            "time": alignment.cycle_times,
            "check_time": alignment.cycle_times[few],
            "check_x": rays.x[sections],
        },
    )


def _each(mapped: list[MappedState], name: str) -> NDArray[np.float64]:
    return np.array([getattr(state, name) for state in mapped])


def _description(plot: Plot, alignment: Alignment) -> dict[str, Any]:
    return {
        "kind": "febio",
        "file": shown_path(plot.path),
        "software": plot.software,
        "version": f"{plot.version:#06x}",
        "nodes": len(plot.mesh.coordinates),
        "elements": plot.mesh.n_elements,
        "states": plot.n_states,
        "states_compared": len(alignment.states),
        "coverage": round(alignment.coverage, 6),
        "first_time_s": float(plot.times[alignment.states[0]]),
        "last_time_s": float(plot.times[alignment.states[-1]]),
    }
