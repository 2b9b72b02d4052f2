"""The budget of one variant: its error E = S − D, what is uncertain of it, and what is left to the model.

After ASME V&V 20-2009: u_val² = u_num² + u_input² + u_D², and E ± u_val holds the error of the model. What
is not known does not count, and is said. Fields are judged by root mean squares over all cells and states,
numbers of the cycle by their size; all are relative.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr

from cases.results.metric_row import MetricRow
from cases.statistics import BUDGET_PARTS
from validation.compare.budget.judged import apart, judged_quantities
from validation.compare.budget.sources import Sources
from validation.metrics.rows import Models
from validation.metrics.statistics import rms


@dataclass(frozen=True)
class Budget:
    """Parts of the error of one quantity; None is not known.

    Attributes
    ----------
    error : float
        |E| with the prescribed inflow, relative as all others.
    inflow : float or None
        What the other inflow of the 3D mesh changes in the reduced model.
    matched : float or None
        |E| with the inflow of the 3D mesh.
    mesh, grid, inputs : float or None
        Uncertainty of the 3D mesh, of the 2D grid and time step, of inputs that the models do not share.
    shared_inputs : float or None
        Uncertainty of inputs that both models share, which is no part of their difference.
    mesh_order, mesh_safety : float or None
        Observed order on three 3D meshes or more, and the factor of safety that counted.
    grid_order, step_order : float or None
        Observed orders of the 2D grid and time step.
    extrapolated : float or None
        Error in the limit of fine 3D meshes.
    """

    error: float
    inflow: float | None = None
    matched: float | None = None
    mesh: float | None = None
    grid: float | None = None
    inputs: float | None = None
    shared_inputs: float | None = None
    mesh_order: float | None = None
    mesh_safety: float | None = None
    grid_order: float | None = None
    step_order: float | None = None
    extrapolated: float | None = None

    @property
    def uncertainty(self) -> float | None:
        """Root of the sum of squares of what is known; None where nothing is."""
        known = [part for part in (self.mesh, self.grid, self.inputs) if part is not None]
        return math.hypot(*known) if known else None

    @property
    def compared(self) -> float:
        """Error that the model answers for: with the same inflow, where that is known."""
        return self.error if self.matched is None else self.matched

    @property
    def model_low(self) -> float:
        """Least error of the model that uncertainty allows."""
        return max(0.0, self.compared - (self.uncertainty or 0.0))

    @property
    def model_high(self) -> float:
        """Largest error of the model that uncertainty allows."""
        return self.compared + (self.uncertainty or 0.0)


def budgets_of(
    models: Models,
    sources: Sources,
    inputs: Mapping[str, float] | None = None,
    shared: bool = True,
) -> dict[str, Budget]:
    """Budget of each quantity whose relative error has a meaning.

    Parameters
    ----------
    models : Models
        With the prescribed inflow.
    sources : Sources
    inputs : mapping of str to float, optional
        By quantity, root mean square of the relative standard deviation that uncertain inputs give it.
    shared : bool, optional
        Whether the reference was computed with the same inputs.
    """
    found = {}
    part = "shared_inputs" if shared else "inputs"
    for quantity in judged_quantities():
        error = apart(quantity, models.rom, models.reference)
        if error is None:
            continue
        numerical, mesh = sources.numerical.get(quantity), (sources.mesh or {}).get(quantity)
        found[quantity] = Budget(
            rms(error),
            **_matched(quantity, models, sources),
            mesh=None if mesh is None else mesh.uncertainty,
            grid=None if numerical is None else numerical.uncertainty,
            **{part: None if inputs is None else inputs.get(quantity)},
            mesh_order=None if mesh is None else mesh.observed,
            mesh_safety=None if mesh is None else mesh.safety,
            grid_order=None if numerical is None else numerical.grid.observed,
            step_order=None if numerical is None else numerical.step.observed,
            extrapolated=None if mesh is None else mesh.extrapolated,
        )
    return found


def _matched(quantity: str, models: Models, sources: Sources) -> dict[str, float | None]:
    """What the inflow changes, and the error with that of the 3D mesh."""
    if sources.matched is None:
        return {}
    changed = apart(quantity, models.rom, sources.matched.fields)
    error = apart(quantity, sources.matched.fields, models.reference)
    return {
        "inflow": None if changed is None else rms(changed),
        "matched": None if error is None else rms(error),
    }


def budget_rows(models: Models, budgets: Mapping[str, Budget]) -> Iterator[MetricRow]:
    """One row for each part of each budget; without an error where it is not known."""
    for quantity, budget in budgets.items():
        for part in BUDGET_PARTS:
            yield models.row(quantity, f"budget_{part}", error=getattr(budget, part))


def budget_array(budgets: Mapping[str, Budget]) -> xr.DataArray:
    """All budgets on (quantity, part), NaN for what is not known."""
    names, parts = list(judged_quantities()), list(BUDGET_PARTS)
    values = np.full((len(names), len(parts)), np.nan)
    for quantity, budget in budgets.items():
        stated = [getattr(budget, part) for part in parts]
        values[names.index(quantity)] = [np.nan if part is None else part for part in stated]
    return xr.DataArray(
        values,
        dims=("quantity", "part"),
        coords={"quantity": names, "part": parts},
        attrs={"units": "1", "long_name": "parts of the error of the reduced model, relative"},
    )
