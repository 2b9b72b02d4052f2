"""How far a 3D run is from periodic: what changes over the cycle that is compared.

Before it is periodic, a run differs from the reduced model by its start, which is no error of any model.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import xarray as xr

from cases.arrays import Floats, Integers
from validation.mapping.state import MappedState, Mapper
from validation.reference.alignment import SLACK
from validation.reference.mesh.series import MeshState

PERIODIC = 1e-2  # relative change over a cycle from which a run is not periodic


class CycleChange(NamedTuple):
    """What changes most between two states at one phase of the cycle.

    Attributes
    ----------
    quantity : str
        In words.
    amount : float
        Its largest change over its largest magnitude in the cycle.
    times : tuple of float
        Of the two states, s.
    """

    quantity: str
    amount: float
    times: tuple[float, float]


def cycle_change(
    times: Floats,
    states: Integers,
    period: float,
    read: Callable[[int], MeshState],
    mapper: Mapper,
    fields: xr.Dataset,
) -> CycleChange | None:
    """Change over a cycle of pressure, flow rate or lumen volume, whichever changes most.

    Parameters
    ----------
    times : ndarray (n_states,)
        Of all states of the run, s.
    states : ndarray (n,)
        Numbers of those that are compared, increasing in time.
    period : float
        s.
    read : callable
        Number of a state → its nodal values in the artery's frame.
    mapper : Mapper
    fields : xarray.Dataset
        Of all compared states: their largest pressure and flow rate are what changes are relative to.

    Returns
    -------
    CycleChange or None
        None where no compared state has one a cycle earlier.
    """
    pair = a_cycle_apart(times, states, period)
    if pair is None:
        return None
    earlier, later = (_watched(mapper.map_state(*read(number)), mapper) for number in pair)
    largest = {name: float(np.abs(fields[name]).max()) for name in ("pressure", "section_flow_rate")}
    scales = (*largest.values(), float(later[2]))
    amounts = {
        name: float(np.max(np.abs(after - before))) / scale
        for name, before, after, scale in zip(WATCHED, earlier, later, scales, strict=True)
        if scale > 0
    }
    quantity = max(amounts, key=lambda name: amounts[name])
    return CycleChange(quantity, amounts[quantity], (float(times[pair[0]]), float(times[pair[1]])))


def a_cycle_apart(times: Floats, states: Integers, period: float) -> tuple[int, int] | None:
    """Numbers of the last compared state that the run has a cycle earlier too, after that of the earlier one.

    They are the ends of the cycle that is compared, or one phase in two cycles; None where there are none.
    """
    for later in states[::-1].tolist():
        off = np.abs(times[later] - period - times)
        earlier = int(np.argmin(off))
        if off[earlier] <= SLACK * period:
            return earlier, later
    return None


WATCHED = ("pressure", "flow rate", "lumen volume")


def _watched(state: MappedState, mapper: Mapper) -> tuple[Floats, Floats, Floats]:
    """Pressure of cells, Pa, flow rate of sections, m³/s, and Σ R² of cells, m², which goes as the volume."""
    sectors = mapper.rays.mean(state.velocity[..., 0]) * state.sector_area
    flow: Floats = 0.5 * mapper.rays.dphi * sectors.sum(axis=-1)
    return state.pressure, flow, np.asarray(np.sum(state.sector_area))


def periodicity_doubts(change: CycleChange | None) -> tuple[str, ...]:
    """Say that a run is not periodic; empty where it is, or where that cannot be told."""
    if change is None or change.amount <= PERIODIC:
        return ()
    earlier, later = change.times
    said = (
        f"3D is not periodic yet: its {change.quantity} at {later:.6g} s is {change.amount:.1%} of the "
        f"cycle's largest off that a cycle earlier, at {earlier:.6g} s"
    )
    return (said,)
