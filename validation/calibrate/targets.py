"""What a calibration's runs must attain: numbers of the last cycle, or a 3D reference over it."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import xarray as xr

from cases.arrays import Floats
from cases.fields import FIELDS
from cases.quantities import reads
from cases.reading.calibration_file import Calibration, Place, ReferenceTarget, Target
from cases.sections.case import Case
from solver.case.model import grid_of
from solver.model.parameters import Model
from solver.runs.result import CellHistory, cell_dataset
from validation.errors import ValidationError
from validation.mapping.rays import rays
from validation.metrics.quantities import CYCLE_QUANTITIES
from validation.reference.kinds import kind_of
from validation.runs.cache import Cache
from validation.runs.cached import cached_reference
from validation.runs.reduced_model import run_times
from validation.runs.variants import Watch

INSTANTS = 400  # of the last cycle among which extremes are looked for: systole may be a narrow peak


@dataclass(frozen=True)
class Observed:
    """Numbers to attain, and how a run's are found.

    Attributes
    ----------
    names : tuple of str
        What each number is, for people.
    quantities : tuple of str
        Of each, a name of `cases.fields.FIELDS`.
    values : ndarray (m,)
        SI.
    scales : ndarray (m,)
        What differences are divided by: standard deviations where the calibration states them, else the
        values' own size.
    uncertain : bool
        Whether the scales are standard deviations.
    times : ndarray (n,)
        Output times of a run, s.
    measure : callable (Model, CellHistory) -> ndarray (m,)
        The same numbers of a run.
    """

    names: tuple[str, ...]
    quantities: tuple[str, ...]
    values: Floats
    scales: Floats
    uncertain: bool
    times: Floats
    measure: Callable[[Model, CellHistory], Floats]


def observed(calibration: Calibration, watch: Watch, cache: Cache | None) -> Observed:
    """Find what a calibration's runs must attain.

    Raises
    ------
    ValidationError, FebioError
        If the reference cannot be read, or has nothing at the places wanted.
    """
    if calibration.reference is None:
        return _of_targets(calibration.case, calibration.targets)
    return _of_reference(calibration, calibration.reference, watch, cache)


def words_of(place: Place) -> str:
    """Words for a place."""
    return f"x = {place * 1e3:g} mm" if isinstance(place, float) else place


def _of_targets(case: Case, targets: tuple[Target, ...]) -> Observed:
    period, cycles = case.inlet.period, case.solver.cycles
    last = np.linspace((cycles - 1) * period, cycles * period, INSTANTS + 1)
    values = np.array([target.value for target in targets])
    uncertainties = [target.uncertainty for target in targets]
    stated = [each for each in uncertainties if each is not None]
    quantities = tuple(target.quantity for target in targets)
    needed = {name for quantity in quantities for name in reads(quantity)}

    def measure(model: Model, cells: CellHistory) -> Floats:
        cycle = cell_dataset(model, cells, needed).isel(time=slice(-last.size, None))
        return np.array([CYCLE_QUANTITIES[target.quantity](at_place(cycle, target.at)) for target in targets])

    return Observed(
        names=tuple(f"{FIELDS[target.quantity].label}, {words_of(target.at)}" for target in targets),
        quantities=quantities,
        values=values,
        scales=np.array(stated) if stated else np.abs(values),
        uncertain=bool(stated),
        times=run_times(case, last),
        measure=measure,
    )


def at_place(fields: xr.Dataset, place: Place) -> xr.Dataset:
    """Fields at a place along the artery, all of them for ``artery``.

    Between two sections linear; an end is its first or last section.
    """
    if place == "artery":
        return fields
    x = fields["x"].to_numpy()
    position = {"inlet": x[0], "outlet": x[-1]}.get(str(place), place)
    return fields.interp(x=float(np.clip(float(position), x[0], x[-1])))


def _of_reference(
    calibration: Calibration, target: ReferenceTarget, watch: Watch, cache: Cache | None
) -> Observed:
    case, quantity = calibration.case, target.quantity
    kind, grid = kind_of(calibration.variant, case), grid_of(case)
    alignment = kind.align(case)
    with watch.step("3D onto cells") as progress:
        reference = cached_reference(
            cache, kind, case, rays(grid.x, grid.phi), progress, alignment, watch.remarks.append
        )
    theirs = _over_time(reference.fields, quantity, target.at)
    known = np.isfinite(theirs)
    if not np.any(known):
        raise ValidationError(f"{calibration.path}: the reference states no {quantity} at these places")

    def measure(model: Model, cells: CellHistory) -> Floats:
        dataset = cell_dataset(model, cells, {quantity}).sel(time=alignment.rom_times)
        return _over_time(dataset, quantity, target.at)[known]

    places = ", ".join(words_of(place) for place in target.at)
    name = f"{FIELDS[quantity].label} over time, {places}"
    values = theirs[known]
    return Observed(
        names=(name,) * values.size,
        quantities=(quantity,) * values.size,
        values=values,
        scales=np.full(values.size, float(np.sqrt(np.mean(values**2)))),
        uncertain=False,
        times=run_times(case, alignment.rom_times),
        measure=measure,
    )


def _over_time(fields: xr.Dataset, quantity: str, places: tuple[Place, ...]) -> Floats:
    """Values of a quantity at places, averaged over φ, one place after the other."""
    found = [at_place(fields[[quantity]], place)[quantity] for place in places]
    means = [each.mean("phi", skipna=False) if "phi" in each.dims else each for each in found]
    return np.concatenate([each.to_numpy() for each in means])
