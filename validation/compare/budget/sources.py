"""The further runs of a variant that its budget is made of, from the cache where nothing has changed."""

import threading
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import xarray as xr

from cases.sections.case import Case
from cases.sections.references.base import ReferenceSection
from solver.case.model import grid_of
from solver.errors import SolverError
from validation.compare.budget.discretization import Estimate
from validation.compare.budget.levels import Level, mesh_estimates, refined_enough, refinement_told
from validation.compare.budget.numerical import (
    Numerical,
    ladder_changes,
    last_cycle,
    numerical_uncertainty,
)
from validation.errors import ValidationError
from validation.mapping.rays import Rays, rays
from validation.reference.alignment import Alignment
from validation.reference.kind import Progress, Reference
from validation.reference.kinds import kind_of
from validation.runs.cache import Cache
from validation.runs.cached import (
    Numbers,
    cached_numbers,
    cached_reference,
    cached_rom,
    reference_key,
    rom_key,
)
from validation.runs.keys import key_of
from validation.runs.matched_inflow import with_inflow_of
from validation.runs.reduced_model import ReducedModelRun

Remark = Callable[[str], None]


@dataclass(frozen=True)
class Sources:
    """What is known of where a variant's errors come from.

    Attributes
    ----------
    matched : ReducedModelRun or None
        The reduced model with the inflow of the 3D reference; None where that was not asked for.
    numerical : mapping of str to Numerical
        By quantity, what the reduced model's grid and step leave open; empty where that is not known.
    mesh : mapping of str to Estimate or None
        By quantity, what the reference's mesh leaves open; None with one mesh only.
    notes : tuple of str
        How they were found.
    warnings : tuple of str
        What casts doubt on the reference's coarser meshes.
    """

    matched: ReducedModelRun | None
    numerical: Mapping[str, Numerical]
    mesh: Mapping[str, Estimate] | None
    notes: tuple[str, ...]
    warnings: tuple[str, ...] = ()

    def without_fields(self) -> "Sources":
        """Return what describes them."""
        if self.matched is None:
            return self
        return replace(self, matched=replace(self.matched, fields=xr.Dataset()))


@dataclass(frozen=True)
class CoarserMeshes:
    """References of a variant on coarser meshes, which all its reduced models are compared with.

    They are read once, when the first model asks for them; others wait for that.
    """

    _found: list[Reference] = field(default_factory=list)
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def read(self, each: Callable[[], list[Reference]]) -> list[Reference]:
        """Return the references; ``each`` reads them if they are not there yet."""
        with self._lock:
            if not self._found:
                self._found.extend(each())
            return self._found


@dataclass(frozen=True)
class _Variant:
    """One variant with both its models, and where results are kept."""

    name: str
    case: Case
    alignment: Alignment
    meshes: CoarserMeshes
    store: Cache | None
    progress: Progress
    remark: Remark

    @property
    def points(self) -> Rays:
        grid = grid_of(self.case)
        return rays(grid.x, grid.phi)


def sources_of(
    name: str,
    case: Case,
    models: tuple[ReducedModelRun, Reference],
    meshes: CoarserMeshes,
    store: Cache | None,
    progress: Progress,
    remark: Remark,
) -> Sources:
    """Run a variant with the reference's inflow, on coarser and finer grids, and against coarser meshes.

    Parameters
    ----------
    name : str
        Of the variant.
    case : Case
    models : (ReducedModelRun, Reference)
        What is compared.
    meshes : CoarserMeshes
        Of the variant.
    store : Cache or None
    progress, remark : callable

    Raises
    ------
    SolverError, FebioError, ValidationError
        As the solver and the kind of reference raise, but for grids that cannot be run: what they would
        tell is then not known, which a note says.
    """
    rom, reference = models
    variant = _Variant(name, case, reference.alignment, meshes, store, progress, remark)
    numerical, notes = _numerical(variant, rom)
    coarser = () if case.reference is None else case.reference.coarser
    if not (case.compare.matched_inflow or coarser):
        return Sources(None, numerical, None, tuple(notes))
    driven = with_inflow_of(case, reference)
    matched = cached_rom(store, driven, variant.alignment, variant.points, progress, remark, along_rays=False)
    mesh: Mapping[str, Estimate] | None = None
    warnings: tuple[str, ...] = ()
    if coarser:
        mesh, told, warnings = _mesh(variant, coarser, matched, reference)
        notes.append(f"{name}: {told}")
    return Sources(matched, numerical, mesh, tuple(notes), warnings)


def _numerical(variant: _Variant, rom: ReducedModelRun) -> tuple[Mapping[str, Numerical], list[str]]:
    """What grid and step leave open, with a note where that cannot be told."""
    case, alignment = variant.case, variant.alignment

    def key() -> str:
        return key_of("budget", {"ladder of": rom_key(case, alignment, variant.points)})

    def compute() -> Numbers:
        return Numbers(dict(ladder_changes(case, rom.fields, alignment, variant.progress)))

    try:
        found = cached_numbers(variant.store, key, compute, variant.remark)
    except (SolverError, ValidationError) as error:
        return {}, [f"{variant.name}: what the 2D grid and time step leave open is not known: {error}"]
    return numerical_uncertainty(found.values), []


def _mesh(
    variant: _Variant,
    coarser: tuple[ReferenceSection, ...],
    matched: ReducedModelRun,
    reference: Reference,
) -> tuple[Mapping[str, Estimate], str, tuple[str, ...]]:
    """What the reference's mesh leaves open, in words how that was found, and what casts doubt on it."""
    case, alignment, points = variant.case, variant.alignment, variant.points
    cases = [case.model_copy(update={"reference": section}) for section in coarser]

    def key() -> str:
        keys = [reference_key(each, alignment, points) for each in (*cases, case)]
        return key_of("budget", {"levels of": rom_key(case, alignment, points), "meshes": keys})

    def compute() -> Numbers:
        read = variant.meshes.read(lambda: [_reference(variant, each) for each in cases])
        levels = [_level(variant, *each) for each in zip(cases, read, strict=True)]
        levels.append(Level(_elements(reference), matched.fields, reference.fields))
        sizes = [level.elements for level in levels]
        if not refined_enough(levels):
            raise ValidationError(
                f"variant {variant.name}: reference.levels: meshes of {', '.join(map(str, sizes))} lumen "
                "elements (plot_file last); allowed: from the coarsest on, each finer than the one before"
            )
        estimates = mesh_estimates(levels, case.inlet.period)
        values = {quantity: asdict(estimate) for quantity, estimate in estimates.items()}
        said = [warning for level in levels for warning in level.warnings]
        return Numbers({"estimates": values, "sizes": sizes, "warnings": said})

    found = cached_numbers(variant.store, key, compute, variant.remark).values
    mesh = {quantity: Estimate(**stated) for quantity, stated in found["estimates"].items()}
    return mesh, refinement_told(found["sizes"], mesh), tuple(found["warnings"])


def _reference(variant: _Variant, case: Case) -> Reference:
    """One coarser mesh, without fields along rays."""
    kind = kind_of(variant.name, case)
    return cached_reference(
        variant.store,
        kind,
        case,
        variant.points,
        variant.progress,
        kind.align(case),
        variant.remark,
        along_rays=False,
    )


def _level(variant: _Variant, case: Case, reference: Reference) -> Level:
    """One coarser mesh and the reduced model with its inflow."""
    rom = last_cycle(with_inflow_of(case, reference), reference.alignment, variant.progress)
    named = case.reference and case.reference.files[0].name
    said = tuple(f"reference.levels: {named}: {warning}" for warning in reference.warnings)
    return Level(_elements(reference), rom, reference.fields, said)


def _elements(reference: Reference) -> int:
    counted: Any = reference.description.get("lumen_elements")
    if counted is None:
        raise ValidationError("reference.levels: the reference does not tell its elements of the lumen")
    return int(counted)
