"""What a sample is judged against: the coupled model of the same sample, or the 3D reference of its case."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
import xarray as xr

from cases.arrays import Floats
from cases.fields import FIELDS
from cases.quantities import reads
from cases.sections.case import Case
from cases.sections.compare import Band
from solver.case.model import grid_of
from validation.ablation.ladder import coupled_model
from validation.errors import ValidationError
from validation.mapping.rays import rays
from validation.metrics.bands import judged_value
from validation.metrics.rows import Models
from validation.reference.kind import Progress
from validation.reference.kinds import kind_of
from validation.runs.cache import Cache
from validation.runs.cached import cached_reference

Against = Literal["none", "coupled", "reference"]

STATES = 100  # instants of the last cycle in which extremes are looked for
ALWAYS = ("radius", "section_flow_rate", "sector_flow_rate", "pressure")  # told also without a band
UNJUDGED = np.inf  # limit of what no band limits
# numbers that a 3D run has too: it says nothing of samples with others
OF_THE_REFERENCE = (
    "geometry.length",
    "solver.n_x",
    "solver.n_phi",
    "solver.cycles",
    "inlet.period",
    "inlet.fourier.period",
)


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


def unfit_for_judging(against: Against, case: Case, varied: Sequence[str]) -> str:
    """Say why a case cannot be judged as a study asks; empty where it can."""
    if against == "coupled":
        try:
            if coupled_model(case) == case:
                return "the case is the coupled model itself"
        except ValidationError as error:
            return str(error)
    if against == "reference":
        if case.reference is None:
            return "the case states no reference"
        taken = [name for name in varied if name in OF_THE_REFERENCE]
        if taken:
            return f"{taken[0]} is the reference's own; allowed: other parameters"
    return ""


def judged_bands(cases: Mapping[str, Case], against: Against) -> list[tuple[Band, ...]]:
    """Return what is judged: the bands of each quantity and statistic, and some that no band limits.

    Bands of quantities on rays are left out: samples keep no velocities across the section.
    """
    if against == "none":
        return []
    told = {(name, "rms_error"): (_unlimited(name),) for name in ALWAYS}
    declared: dict[tuple[str, str], list[Band]] = {}
    for name, case in cases.items():
        for band in case.compare.bands:
            applies = band.variants is None or name in band.variants
            seen = declared.setdefault((band.quantity, band.statistic), [])
            if applies and "y" not in FIELDS[band.quantity].dims and band not in seen:
                seen.append(band)
    return list((told | {key: tuple(bands) for key, bands in declared.items() if bands}).values())


def _unlimited(quantity: str) -> Band:
    return Band.model_construct(
        None, quantity=quantity, statistic="rms_error", limit=UNJUDGED, reason="", variants=None
    )


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
