"""What the mesh of the 3D reference leaves open, from the same run on coarser meshes.

Compared is the relative error e = S/D − 1 of the reduced model S, driven by each mesh's own inflow, against
that mesh's D: so the inflow, whose part is told apart, is not counted once more.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import xarray as xr

from cases.arrays import Floats, Integers
from validation.compare.budget.discretization import Estimate, of_finest_level
from validation.compare.budget.judged import apart, judged_quantities
from validation.metrics.statistics import rms
from validation.runs.instants import common_states


@dataclass(frozen=True)
class Level:
    """One mesh of the reference and the reduced model with its inflow, on the same cells.

    Attributes
    ----------
    elements : int
        Of the lumen.
    rom, reference : xarray.Dataset
        Fields; ``time`` is counted from the cycle's start.
    warnings : tuple of str
        What casts doubt on the reference.
    """

    elements: int
    rom: xr.Dataset
    reference: xr.Dataset
    warnings: tuple[str, ...] = ()


def mesh_estimates(levels: list[Level], period: float) -> dict[str, Estimate]:
    """Uncertainty of each quantity on the finest mesh, with the size of its error in the limit.

    Parameters
    ----------
    levels : list of Level
        From coarse to fine; the last one is that which is compared.
    period : float
        Of the cycle, s.

    Raises
    ------
    ValidationError
        If they share too few instants.
    """
    states = common_states([level.reference["time"].to_numpy() for level in levels], period)
    shared = [_at(level, chosen) for level, chosen in zip(levels, states, strict=True)]
    sizes = [level.elements ** (-1.0 / 3.0) for level in levels]
    ratios = [coarse / fine for coarse, fine in pairwise(sizes)]
    found = {}
    for quantity in judged_quantities():
        errors = [apart(quantity, level.rom, level.reference) for level in shared]
        known = [error for error in errors if error is not None]
        if len(known) == len(errors):
            found[quantity] = _estimate(known, ratios)
    return found


def _at(level: Level, states: Integers) -> Level:
    return replace(level, rom=level.rom.isel(time=states), reference=level.reference.isel(time=states))


def _estimate(errors: list[Floats], ratios: list[float]) -> Estimate:
    """Estimate from errors on meshes from coarse to fine."""
    steps = [fine - coarse for coarse, fine in pairwise(errors)]
    estimate = of_finest_level([rms(step) for step in steps], ratios)
    limit = errors[-1] + steps[-1] / (ratios[-1] ** estimate.order - 1.0)
    return replace(estimate, extrapolated=rms(limit))


def refinement_told(levels: list[int], estimates: Mapping[str, Estimate]) -> str:
    """Say on how many meshes, of how many elements, and how sure what was found is."""
    sizes = ", ".join(map(str, levels))
    sure = sum(estimate.safety < 2.0 for estimate in estimates.values())
    if len(levels) == 2:
        how = "no order can be observed on two: the formal order 2 and a factor of safety of 3 count"
    else:
        how = (
            f"orders are observed, {sure} of {len(estimates)} near the formal order 2 (factor of safety "
            "1.25, else 3)"
        )
    return f"{len(levels)} 3D meshes ({sizes} elements of the lumen): {how}"


def refined_enough(levels: list[Level]) -> bool:
    """Whether each mesh has more elements than the one before."""
    return bool(np.all(np.diff([level.elements for level in levels]) > 0))
