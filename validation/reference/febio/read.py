"""``reference.kind: febio``: a FEBio plot file on the cells of the reduced model."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import xarray as xr

from cases.arrays import Floats, Indices
from cases.sections.case import Case, FebioReference
from febio_io.xplt import Plot, open_plot
from solver.case.model import inlet_signal
from validation.errors import UnusableReferenceError
from validation.mapping.derived import derived_fields
from validation.mapping.mesh import LumenMesh
from validation.mapping.nodal_shares import RINGS
from validation.mapping.plane_section import lumen_grid, plane_flow_rate
from validation.mapping.rays import Rays
from validation.mapping.state import MappedState, Mapper
from validation.reference.alignment import Alignment, align
from validation.reference.calcified_extent import described, doubts, extent
from validation.reference.febio.plot_model import PlotModel, plot_model
from validation.reference.febio.run import account_of_run
from validation.reference.kind import Progress, Reference
from validation.runs.provenance import shown_path

RADIUS_TOLERANCE = 1e-2  # and the mean radius of its unloaded interface by this share
LENGTH_TOLERANCE = 1e-3  # the mesh's length may differ from the case's by this share


@dataclass
class _Kept:
    """Of each state: flow rate and area of the inlet, and rings of nodes at the tabulated cells."""

    cells: tuple[Indices, ...]
    inlet: list[tuple[float, float]] = field(default_factory=list)
    rings: list[Floats] = field(default_factory=list)


def align_febio(case: Case) -> Alignment:
    """States of a FEBio run within its last cycle.

    Raises
    ------
    FebioError
        If the plot file cannot be read.
    UnusableReferenceError
        If it has too few states.
    """
    stated = _stated(case)
    with _naming(stated), open_plot(stated.plot_file) as plot:
        return _alignment(plot, stated, case)


def read_febio(
    case: Case, rays: Rays, progress: Progress | None = None, alignment: Alignment | None = None
) -> Reference:
    """Map the last cycle of a FEBio run.

    Parameters
    ----------
    case : Case
        With ``reference.kind: febio``.
    rays : Rays
        Where to.
    progress : callable, optional
        Called with (states done, states).
    alignment : Alignment, optional
        States to map; default :func:`align_febio`.

    Raises
    ------
    FebioError
        If the plot file, the log or a data record cannot be read.
    UnusableReferenceError
        If it lacks what the mapping needs, or does not fit the case; if the log or a data record is that of
        another run.
    """
    stated = _stated(case)
    with _naming(stated), open_plot(stated.plot_file) as plot:
        return _read(plot, stated, case, rays, progress, alignment)


def _stated(case: Case) -> FebioReference:
    if not isinstance(case.reference, FebioReference):
        raise UnusableReferenceError("the case states no FEBio reference")
    return case.reference


@contextmanager
def _naming(stated: FebioReference) -> Iterator[None]:
    """Name the plot file in what is raised."""
    try:
        yield
    except UnusableReferenceError as error:
        if str(stated.plot_file) in str(error):
            raise
        raise UnusableReferenceError(f"{stated.plot_file}: {error}") from error


def _read(
    plot: Plot,
    stated: FebioReference,
    case: Case,
    rays: Rays,
    progress: Progress | None,
    alignment: Alignment | None,
) -> Reference:
    model = plot_model(plot, stated)
    _check_length(plot, model.mesh, case)
    _check_radius(plot, model.mesh, case)
    run = account_of_run(plot, stated)
    if alignment is None:
        alignment = _alignment(plot, stated, case)
    kept = _Kept(np.ix_(np.array(case.compare.cells.i) - 1, np.array(case.compare.cells.j) - 1))
    mapped = _mapped(model, Mapper(model.mesh, rays), alignment, progress, kept)
    fields = derived_fields(mapped, rays, alignment.cycle_times)
    fields = fields.assign({RINGS: _rings(kept, rays)})
    inflow, inlet_area = np.array(kept.inlet).T
    _check_direction(plot, inflow, alignment, case)
    checks = _plane_checks(model, alignment, case, rays)
    return Reference(
        fields=fields,
        checks=checks.assign(inlet_flow_rate=("time", inflow), inlet_area=("time", inlet_area)),
        alignment=alignment,
        description=_description(plot, alignment) | _calcified(model) | run.facts,
        notes=(*plot.warnings, *model.notes, *run.notes),
        warnings=(*_doubts(stated, case, model), *run.warnings),
    )


def _alignment(plot: Plot, stated: FebioReference, case: Case) -> Alignment:
    times = plot.times * stated.time_unit
    return align(times, stated.time_offset, case.inlet.period, case.solver.cycles)


def _calcified(model: PlotModel) -> dict[str, str]:
    """Extent of the calcified elements, for provenance."""
    if not model.calcified:
        return {}
    return {"calcified": described(*extent(model.mesh.coordinates, model.calcified))}


def _doubts(stated: FebioReference, case: Case, model: PlotModel) -> list[str]:
    """Compare the calcified domains with the case's calcification, if the case names them."""
    if stated.calcified is None:
        return []
    return doubts(case, model.mesh.coordinates, model.calcified)


def _mapped(
    model: PlotModel,
    mapper: Mapper,
    alignment: Alignment,
    progress: Progress | None,
    kept: _Kept,
) -> Iterator[MappedState]:
    """Map state after state; keep what is not a field on all cells."""
    for done, state in enumerate(alignment.states.tolist(), start=1):
        mapped = mapper.map_state(*model.read(state))
        kept.inlet.append((mapped.inflow, mapped.inlet_area))
        kept.rings.append(np.stack([part[kept.cells] for part in mapped.rings], axis=-1))
        yield mapped
        if progress:
            progress(done, len(alignment.states))


def _rings(kept: _Kept, rays: Rays) -> xr.DataArray:
    """Rings of nodes around the points of the tabulated cells' rays."""
    i, j = (index.ravel() for index in kept.cells)
    return xr.DataArray(
        np.array(kept.rings),
        dims=("time", "compare_x", "compare_phi", "y", "ring"),
        coords={
            "compare_x": ("compare_x", rays.x[i], {"units": "m"}),
            "compare_phi": ("compare_phi", rays.phi[j], {"units": "rad"}),
            "ring": ("ring", np.arange(3), {"flag_meanings": "inner outer weight_of_outer"}),
        },
        attrs={"units": "1", "long_name": "r/R of the mesh's nodes around a point, as two rings"},
    )


def _check_direction(plot: Plot, inflow: Floats, alignment: Alignment, case: Case) -> None:
    """Refuse a reference whose blood flows against the prescribed inflow."""
    if case.inlet.kind == "pressure":
        return
    prescribed = float(np.mean(inlet_signal(case)(alignment.cycle_times)))
    mean = float(np.mean(inflow))
    if prescribed * mean < 0:
        raise UnusableReferenceError(
            f"{plot.path}: blood flows against the inflow of the case ({mean:.3g} m³/s on average at "
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


def _plane_checks(model: PlotModel, alignment: Alignment, case: Case, rays: Rays) -> xr.Dataset:
    """Flow rates through planes at a few states, by surface integral."""
    sections = np.array(case.compare.cells.i) - 1
    few = np.unique(np.linspace(0, len(alignment.states) - 1, 5).astype(int))
    grid = lumen_grid(model.mesh.lumen)
    planes = np.empty((few.size, sections.size))
    for row, state in enumerate(alignment.states[few].tolist()):
        displacement, velocity, _ = model.read(state)
        points = model.mesh.coordinates + displacement
        planes[row] = [plane_flow_rate(grid, points, velocity, float(x)) for x in rays.x[sections]]
    return xr.Dataset(
        {"plane_flow_rate": (("check_time", "check_x"), planes)},
        coords={
            "time": alignment.cycle_times,
            "check_time": alignment.cycle_times[few],
            "check_x": rays.x[sections],
        },
    )


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
