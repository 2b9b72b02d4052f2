"""Stops of a run, alike for both schemes: what is saved there, and what the run needs to go on."""

from collections.abc import Sequence
from dataclasses import fields
from typing import Any, NamedTuple, TypeVar

import numpy as np

from cases.arrays import Floats
from solver.errors import NoAdmissibleProfile
from solver.model.diagnostics import Columns, Diagnostics, by_name
from solver.runs.result import CellHistory

Kept = dict[str, Floats]


S = TypeVar("S")


def kept_of(state: Any) -> Kept:
    """Parts of a scheme's state, a dataclass, by name; not those that it has none of."""
    return {name: np.asarray(part) for name, part in vars(state).items() if part is not None}


def state_of(scheme: type[S], kept: Kept) -> S:
    """State of a scheme, whose class it is, from its parts; those without axes are numbers."""
    names = [part.name for part in fields(scheme)]  # type: ignore[arg-type]
    parts = {name: kept[name] for name in names if name in kept}
    return scheme(**{name: values if values.ndim else float(values) for name, values in parts.items()})


class Stop(NamedTuple):
    """One saved state of a run.

    Attributes
    ----------
    time : float
        s.
    columns : Columns
        The state on inlet, cells and outlet.
    diagnostics : Diagnostics
    steps, sweeps : int
        Time steps since the run began or was resumed, and sweeps of their iterations.
    longest_step : float
        Longest Δt since the stop before, s.
    kept : dict of ndarray
        What the scheme needs to go on from here, by name.
    azimuthal_flux : ndarray (n_x, n_phi) or None
        W of the cells where rows exchange blood, m²/s.
    """

    time: float
    columns: Columns
    diagnostics: Diagnostics
    steps: int
    sweeps: int
    longest_step: float
    kept: Kept
    azimuthal_flux: Floats | None = None


def require_exponents(times: Floats, exponent: Floats) -> None:
    """Refuse states, at times (n,), s, of which a cell has no exponent; (n, n_x, n_phi), NaN where none is.

    Raises
    ------
    NoAdmissibleProfile
        With the first such state and cell.
    """
    known = np.isfinite(exponent)
    if not np.all(known):
        n, i, j = (int(k) for k in np.argwhere(~known)[0])
        raise NoAdmissibleProfile(float(times[n]), i + 1, j + 1)


def history_of(stops: Sequence[Stop]) -> CellHistory:
    """States of the cells at stops.

    Raises
    ------
    NoAdmissibleProfile
        Where a cell has no exponent γ > 0.
    """
    times = np.array([stop.time for stop in stops])
    columns = [stop.columns for stop in stops]
    exponent = _joined([each.exponent[1:-1] for each in columns])
    require_exponents(times, exponent)
    axis = [each.axis_velocity[1:-1] for each in columns if each.axis_velocity is not None]
    crossing = [stop.azimuthal_flux for stop in stops if stop.azimuthal_flux is not None]
    return CellHistory(
        times=times,
        area=_joined([each.area[1:-1] for each in columns]),
        flow=_joined([each.flow[1:-1] for each in columns]),
        pressure=_joined([each.pressure[1:-1] for each in columns]),
        exponent=exponent,
        diagnostics=by_name([stop.diagnostics for stop in stops]),
        azimuthal_flux=_joined(crossing) if crossing else None,
        axis_velocity=_joined(axis) if axis else None,
    )


def _joined(parts: list[Floats]) -> Floats:
    """Arrays of one shape along a new first axis; for small ones faster than NumPy's own way."""
    return np.concatenate(parts).reshape(len(parts), *parts[0].shape)
