"""A series of states of a mesh on the cells of the reduced model."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field
from typing import Any, TypeVar

import numpy as np
import xarray as xr

from cases.arrays import Floats, Indices
from cases.sections.case import Case
from cases.sections.references.base import MeshReference
from validation.errors import UnusableReferenceError
from validation.mapping.derived import derived_fields
from validation.mapping.nodal_shares import RINGS
from validation.mapping.rays import Rays
from validation.mapping.state import MappedState, Mapper
from validation.reference.alignment import Alignment, align
from validation.reference.kind import HowToMake, Progress, Reference, ReferenceKind, nothing_to_make
from validation.reference.mesh.calcified_extent import described, doubts, extent
from validation.reference.mesh.checks import (
    check_inflow,
    check_length,
    check_radius,
    check_times,
    plane_checks,
)
from validation.reference.mesh.model import MeshModel, mesh_model
from validation.reference.mesh.motion import WallMotion, check_spread
from validation.reference.mesh.periodicity import cycle_change, periodicity_doubts
from validation.reference.mesh.series import MeshSeries
from validation.reference.mesh.units import check_length_unit, pressure_doubts

S = TypeVar("S", bound=MeshReference)
RIGID = "the reference's wall does not move: its radius is that of its mesh at all instants"


@dataclass
class _Kept:
    """Of each state: flow rate and area of the inlet, and rings of nodes at the tabulated cells."""

    cells: tuple[Indices, ...]
    inlet: list[tuple[float, float]] = field(default_factory=list)
    rings: list[Floats] = field(default_factory=list)


def mesh_kind(
    section: type[S],
    open_series: Callable[[S], AbstractContextManager[MeshSeries]],
    how_to_make: HowToMake = nothing_to_make,
) -> ReferenceKind:
    """Kind of reference whose files hold states of a mesh.

    Parameters
    ----------
    section : type
        Section of the case file that states it.
    open_series : callable
        Opens what a section states; the series is closed when its context is left.
    how_to_make : callable, optional
        See :class:`ReferenceKind`.
    """

    @contextmanager
    def opened(case: Case) -> Iterator[tuple[MeshSeries, S]]:
        stated = case.reference
        if not isinstance(stated, section):
            raise UnusableReferenceError(f"the case states no reference of {section.__name__}")
        with open_series(stated) as series, _naming(series.name):
            yield series, stated

    def align_case(case: Case) -> Alignment:
        with opened(case) as (series, stated):
            return _alignment(series, stated, case)

    def read_case(
        case: Case, rays: Rays, progress: Progress | None = None, alignment: Alignment | None = None
    ) -> Reference:
        with opened(case) as (series, stated):
            return _read(series, stated, case, rays, progress, alignment)

    return ReferenceKind(align_case, read_case, how_to_make)


@contextmanager
def _naming(name: str) -> Iterator[None]:
    """Name the file in what is raised."""
    try:
        yield
    except UnusableReferenceError as error:
        if name in str(error):
            raise
        raise UnusableReferenceError(f"{name}: {error}") from error


def _alignment(series: MeshSeries, stated: MeshReference, case: Case) -> Alignment:
    check_times(series.times)
    return align(series.times, stated.time_offset, case.inlet.period, case.solver.cycles)


def _read(
    series: MeshSeries,
    stated: MeshReference,
    case: Case,
    rays: Rays,
    progress: Progress | None,
    alignment: Alignment | None,
) -> Reference:
    model = mesh_model(series, stated)
    if alignment is None:
        alignment = _alignment(series, stated, case)
    check_length_unit(model.mesh, case, stated.length_unit)
    check_length(model.mesh, case)
    if model.unloaded:
        check_radius(model.mesh, case)
    account = series.account()
    motion = WallMotion(model.mesh)
    kept = _Kept(np.ix_(np.array(case.compare.cells.i) - 1, np.array(case.compare.cells.j) - 1))
    mapper = Mapper(model.mesh, rays)
    mapped = _mapped(model, mapper, alignment, progress, kept, motion)
    fields = derived_fields(mapped, rays, alignment.cycle_times)
    fields = fields.assign({RINGS: _rings(kept, rays)})
    change = cycle_change(series.times, alignment.states, case.inlet.period, model.read, mapper, fields)
    inflow, inlet_area = np.array(kept.inlet).T
    check_inflow(inflow, inlet_area, alignment, case)
    pressure = float(fields["section_pressure"][:, -1].mean())
    unlike = pressure_doubts(pressure, float(inflow.mean()), case, stated.pressure_unit)
    unlike += motion.doubts() if model.nodal_velocity else []
    checks = plane_checks(model, alignment, case, rays)
    unlike += [] if model.calcified is None else doubts(case, model.mesh.coordinates, model.calcified)
    rigid = (RIGID,) if motion.still and not model.unloaded else ()
    return Reference(
        fields=fields,
        checks=checks.assign(inlet_flow_rate=("time", inflow), inlet_area=("time", inlet_area)),
        alignment=alignment,
        description={
            "kind": stated.kind,
            **account.facts,
            **_facts(series, alignment, model),
            "cycle_change": change and change.amount,
        },
        notes=(*model.notes, *account.notes, *rigid),
        warnings=(*periodicity_doubts(change), *unlike, *account.warnings),
    )


def _facts(series: MeshSeries, alignment: Alignment, model: MeshModel) -> dict[str, Any]:
    """Facts of the states and of where the mesh is calcified, for provenance."""
    place = model.calcified and described(*extent(model.mesh.coordinates, model.calcified))
    return {
        "states": len(series.times),
        "states_compared": len(alignment.states),
        "coverage": round(alignment.coverage, 6),
        "first_time_s": float(series.times[alignment.states[0]]),
        "last_time_s": float(series.times[alignment.states[-1]]),
        "lumen_elements": len(model.mesh.lumen.kinds),
        **({"calcified": place} if place else {}),
    }


def _mapped(
    model: MeshModel,
    mapper: Mapper,
    alignment: Alignment,
    progress: Progress | None,
    kept: _Kept,
    motion: WallMotion,
) -> Iterator[MappedState]:
    """Map state after state; keep what is not a field on all cells."""
    for done, state in enumerate(alignment.states.tolist(), start=1):
        values = model.read(state)
        check_spread(values, model.mesh, state)
        motion.add(float(alignment.cycle_times[done - 1]), values)
        mapped = mapper.map_state(*values)
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
