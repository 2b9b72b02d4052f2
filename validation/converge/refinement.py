"""The reduced model on three grids or with three time steps, and the numbers that are watched."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from cases.fields import FIELDS
from cases.sections.case import Case
from solver.case.model import grid_of
from solver.case.run import run_case
from validation.converge.convergence import Convergence, convergence
from validation.errors import ValidationError
from validation.metrics.quantities import CYCLE_QUANTITIES
from validation.reference.kind import Progress
from validation.runs.instants import wanted_instants

FACTORS = (0.5, 1.0, 2.0)  # of the case's own grid, or of its steps per cycle
STUDIES = ("grid", "time step")
STATES = 40  # instants of the last cycle among which extremes are looked for
WATCHED = ("section_flow_rate", "section_pressure", "radius")


@dataclass(frozen=True)
class Refined:
    """One number on three levels.

    ``where``: instant and section, or "cycle"; ``values`` from coarse to fine, in SI.
    """

    variant: str
    study: str
    quantity: str
    where: str
    values: tuple[float, float, float]
    found: Convergence

    def record(self) -> dict[str, Any]:
        """Return the number as a row of data."""
        coarse, own, fine = self.values
        limit = self.found.extrapolate
        return {
            "variant": self.variant,
            "study": self.study,
            "quantity": self.quantity,
            "where": self.where,
            "unit": FIELDS[self.quantity].unit,
            "coarse": coarse,
            "own": own,
            "fine": fine,
            "order": self.found.order,
            "extrapolate": limit,
            "error_of_own": own / limit - 1.0 if limit else None,
            "convergence_index": self.found.index,
            "monotone": self.found.monotone,
        }


def levels(case: Case, study: str) -> list[Case]:
    """Return the case coarser, as it is, and finer.

    Raises
    ------
    ValidationError
        If its grid cannot be halved.
    """
    settings = case.solver
    found = []
    for factor in FACTORS:
        if study == "time step":
            changes: dict[str, float | int] = {"time_step": settings.time_step / factor}
        else:
            around = 1 if settings.n_phi == 1 else int(factor * settings.n_phi)
            changes = {"n_x": int(factor * settings.n_x), "n_phi": around}
        found.append(case.model_copy(update={"solver": settings.model_copy(update=changes)}))
    if study == "grid" and (settings.n_x % 2 or (settings.n_phi > 1 and settings.n_phi % 2)):
        raise ValidationError(
            f"solver.n_x {settings.n_x}, n_phi {settings.n_phi}: to be halved both must be even (or n_phi 1)"
        )
    return found


def refined(name: str, case: Case, study: str, progress: Progress | None = None) -> list[Refined]:
    """Run a case on three levels and judge every watched number."""
    numbers = [dict(_numbers(case, each, progress)) for each in levels(case, study)]
    return [
        Refined(name, study, quantity, where, values, convergence(*values))
        for quantity, where in numbers[0]
        for values in (
            (numbers[0][quantity, where], numbers[1][quantity, where], numbers[2][quantity, where]),
        )
    ]


def _numbers(case: Case, level: Case, progress: Progress | None) -> Iterator[tuple[tuple[str, str], float]]:
    """Watched numbers of one run: of the cycle, and at the case's own sections and instants."""
    period, cycles = case.inlet.period, case.solver.cycles
    begin = (cycles - 1) * period
    instants = wanted_instants(case)
    within = np.unique(np.concatenate([np.linspace(0.0, period, STATES + 1), list(instants.values())]))
    times = np.unique(np.concatenate([np.linspace(0.0, begin, 10 * (cycles - 1) + 1), begin + within]))
    last = run_case(level, times, progress).sel(time=begin + within, method="nearest")
    for quantity, measure in CYCLE_QUANTITIES.items():
        yield (quantity, "cycle"), measure(last)
    sections = np.array(case.compare.cells.i)
    places = grid_of(case).x[sections - 1]
    for quantity in WATCHED:
        for instant, t in instants.items():
            along = _around(last[quantity].sel(time=begin + t, method="nearest"))
            for i, value in zip(sections, np.interp(places, along["x"], along), strict=True):
                yield (quantity, f"{instant}, i = {i}"), float(value)


def _around(values: xr.DataArray) -> xr.DataArray:
    """Mean around the artery, which does not depend on how cells fall on angles."""
    return values.mean("phi") if "phi" in values.dims else values
