"""Functions that compute the compared quantities which are no fields themselves, from one model's fields.

`cases.fields` says of each what it is called, which fields it reads, and what is made of it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from cases.arrays import Floats
from validation.reference.alignment import WHOLE

if TYPE_CHECKING:
    import xarray as xr


def _largest(model: xr.Dataset, name: str) -> float:
    return float(np.fmax.reduce(model.variables[name].to_numpy(), axis=None))


def _least(model: xr.Dataset, name: str) -> float:
    return float(np.fmin.reduce(model.variables[name].to_numpy(), axis=None))


def _widest_range(model: xr.Dataset, name: str) -> float:
    """Largest difference of values at one instant."""
    values = model.variables[name].transpose("time", ...)
    each = values.to_numpy().reshape(values.sizes["time"], -1)
    return float(np.fmax.reduce(np.fmax.reduce(each, axis=1) - np.fmin.reduce(each, axis=1)))


#: numbers of the cycle, SI
CYCLE_QUANTITIES: dict[str, Callable[[xr.Dataset], float]] = {
    "systolic_pressure": lambda model: _largest(model, "section_pressure"),
    "diastolic_pressure": lambda model: _least(model, "section_pressure"),
    "pulse_pressure": lambda model: _largest(model, "section_pressure") - _least(model, "section_pressure"),
    "largest_radius": lambda model: _largest(model, "radius"),
    "least_radius": lambda model: _least(model, "radius"),
    "largest_pressure_difference": lambda model: _widest_range(model, "section_pressure"),
    "largest_radius_variation": lambda model: _widest_range(model, "radius"),
}


def sector_share(model: xr.Dataset) -> Floats:
    """Flow rate through each sector over its section's mean, (n_t, n_x, n_phi); NaN where that is zero."""
    sector, section = (model[name].to_numpy() for name in ("sector_flow_rate", "section_flow_rate"))
    mean = section[..., None].astype(float) / sector.shape[-1]
    share: Floats = np.full(sector.shape, np.nan)
    np.divide(sector, mean, out=share, where=mean != 0)
    return share


def radius_change(model: xr.Dataset) -> Floats:
    """Mean radius of each section over its least of the cycle, (n_t, n_x), unless it is stated itself."""
    if "radius_change" in model:
        return np.asarray(model["radius_change"].to_numpy(), dtype=float)
    radius = model["radius"].mean("phi")
    return np.asarray((radius - radius.min("time")).to_numpy(), dtype=float)


#: values over the cycle, on the dimensions of their field
DERIVED_QUANTITIES: dict[str, Callable[[xr.Dataset], Floats]] = {
    "sector_flow_share": sector_share,
    "radius_change": radius_change,
}


LARGEST_LAG = 0.1  # share of a cycle searched for a lag


def phase_lag(rom: xr.Dataset, reference: xr.Dataset, period: float) -> float | None:
    """Lag of the reduced model's outlet flow behind the reference's, s.

    The shift of the reference's periodic spline that, scaled, fits the reduced model best; None where the
    states do not cover a cycle.
    """
    from scipy.interpolate import CubicSpline
    from scipy.optimize import minimize_scalar

    times = reference["time"].to_numpy()
    if times[-1] - times[0] < WHOLE * period:
        return None
    ours = rom["section_flow_rate"].isel(x=-1).to_numpy()
    theirs = reference["section_flow_rate"].isel(x=-1).to_numpy()
    knots = np.append(times[:-1], times[0] + period)
    spline = CubicSpline(knots, np.append(theirs[:-1], theirs[0]), bc_type="periodic")

    def misfit(lag: float) -> float:
        shifted = spline(times - lag)
        scale = (ours @ shifted) / (shifted @ shifted)
        return float(np.sum((ours - scale * shifted) ** 2))

    bound = LARGEST_LAG * period
    best = minimize_scalar(misfit, bounds=(-bound, bound), method="bounded", options={"xatol": 1e-7 * period})
    return float(best.x)


def values_of(quantity: str, model: xr.Dataset) -> Floats:
    """Values of a compared quantity in one model, float64, on its dimensions; (1,) for one of the cycle."""
    if quantity in CYCLE_QUANTITIES:
        return np.array([CYCLE_QUANTITIES[quantity](model)])
    if quantity in DERIVED_QUANTITIES:
        return DERIVED_QUANTITIES[quantity](model)
    return np.asarray(model.variables[quantity].to_numpy(), dtype=float)
