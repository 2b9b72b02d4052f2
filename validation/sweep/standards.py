"""What samples are judged by when they are run: the reference read once, or the sample's own coupled run."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np
import xarray as xr

from cases.arrays import Floats
from cases.quantities import reads
from cases.sections.case import Case
from cases.sections.compare import Band
from solver.case.model import grid_of
from validation.mapping.rays import rays
from validation.metrics.bands import judged_value
from validation.metrics.rows import Models
from validation.reference.kind import Progress
from validation.reference.kinds import kind_of
from validation.runs.cache import Cache
from validation.runs.cached import cached_reference
from validation.sweep.judging import STATES, Against


@dataclass(frozen=True)
class Standard:
    """What the samples of one variant are judged against.

    Attributes
    ----------
    against : str
        ``none``, ``coupled`` or ``reference``.
    variant : str
        The variant.
    rom_times : ndarray (n,) or None
        Instants of the reference in the last cycle of a run, s; None where each sample has its own.
    fields : xarray.Dataset or None
        What is judged, of the reference.
    sparse : bool
        Whether the reference states a part only.
    stated : mapping of str to float
        Numbers of the cycle that the reference states.
    """

    against: Against
    variant: str
    rom_times: Floats | None = None
    fields: xr.Dataset | None = None
    sparse: bool = False
    stated: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Watcher:
    """Whom to tell how far reading is, and what is remarkable."""

    progress: Progress
    remark: Callable[[str], None]


def standards(
    cases: Mapping[str, Case], against: Against, bands: Iterable[Band], cache: Cache | None, watch: Watcher
) -> dict[str, Standard]:
    """Return what each variant's samples are judged against; references are read here, once."""
    if against != "reference":
        return {name: Standard(against, name) for name in cases}
    quantities = {band.quantity for band in bands}
    return {name: _of_reference(name, case, quantities, cache, watch) for name, case in cases.items()}


def _of_reference(
    name: str, case: Case, quantities: set[str], cache: Cache | None, watch: Watcher
) -> Standard:
    kind, grid = kind_of(name, case), grid_of(case)
    alignment, points = kind.align(case), rays(grid.x, grid.phi)
    found = cached_reference(cache, kind, case, points, watch.progress, alignment, watch.remark)
    for warning in found.warnings:
        watch.remark(f"{name}: {warning}")
    needed = {name for quantity in quantities for name in reads(quantity)}
    kept = [name for name in sorted(needed) if name in found.fields]
    fields = found.fields[kept].load()
    return Standard("reference", name, alignment.rom_times, fields, found.sparse, found.cycle)


def instants_of(standard: Standard, case: Case) -> Floats:
    """Instants of the last cycle at which a sample is looked at, s from the start of its run."""
    if standard.rom_times is not None:
        return standard.rom_times
    period = case.inlet.period
    return np.asarray((case.solver.cycles - 1) * period + np.linspace(0.0, period, STATES + 1))


def judged_values(
    standard: Standard, case: Case, last: xr.Dataset, other: xr.Dataset | None, bands: Iterable[Band]
) -> list[float | None]:
    """Return what bands judge of one sample; None where it has no meaning.

    Parameters
    ----------
    standard : Standard
    case : Case
        The sample.
    last : xarray.Dataset
        Its last cycle.
    other : xarray.Dataset or None
        The last cycle of its coupled model, where that judges.
    bands : iterable of Band
        What is judged.
    """
    reference = standard.fields if other is None else other
    if reference is None:
        return [None for _ in bands]
    period = case.inlet.period
    models = Models("", standard.variant, last, reference, period, standard.sparse, standard.stated)
    return [judged_value(models, band) for band in bands]
