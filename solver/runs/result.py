"""A finished run as an xarray dataset with CF-style names and units."""

from __future__ import annotations

from collections.abc import Callable, Collection
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from cases.arrays import Floats
from cases.fields import FIELDS
from solver.model.parameters import Model

if TYPE_CHECKING:
    import xarray as xr

CONVENTIONS = "CF-1.11"
AXES = {  # unit and words
    "time": {"units": "s", "long_name": "time"},
    "x": {"units": "m", "long_name": "distance from the inlet"},
    "phi": {"units": "rad", "long_name": "azimuthal angle"},
}


def words_of(name: str) -> dict[str, str]:
    """Attributes of a field in a result: its unit, and what the table of fields calls it."""
    field = FIELDS[name]
    return {"units": field.unit, "long_name": field.label, "symbol": field.symbol}


def described(name: str, values: Floats) -> xr.Variable:
    """Values as a variable with the dimensions, unit and words of the table of fields."""
    import xarray as xr

    return xr.Variable(FIELDS[name].dims, values, words_of(name))


class CellHistory(NamedTuple):
    """States at cell centres: times (n,), s; A, m², Q, m³/s, P, Pa, γ (n, n_x, n_phi); diagnostics (n,).

    W, m²/s, (n, n_x, n_phi), where rows exchange blood; D, m/s, (n, n_x), which stands for γ with two modes.
    """

    times: Floats
    area: Floats
    flow: Floats
    pressure: Floats
    exponent: Floats
    diagnostics: dict[str, Floats]
    azimuthal_flux: Floats | None = None
    axis_velocity: Floats | None = None


def cell_fields(model: Model, cells: CellHistory, names: Collection[str] | None = None) -> dict[str, Floats]:
    """Fields of a run at cell centres, by name; only those of ``names``, where such are stated.

    Returns
    -------
    dict of ndarray
        pressure, radius, mean_velocity, profile_exponent, sector_flow_rate on (time, x, phi), and
        azimuthal_flux where rows exchange blood; section_flow_rate, section_pressure on (time, x); with two
        modes axis_velocity on (time, x) and profile_bend on (time, x, phi) stand for profile_exponent;
        wall_stiffness on (x, phi); the diagnostics on (time). SI.
    """
    fields: dict[str, Callable[[], Floats]] = {
        "pressure": lambda: cells.pressure,
        "radius": lambda: np.sqrt(cells.area),
        "mean_velocity": lambda: cells.flow / cells.area,
        "sector_flow_rate": lambda: 0.5 * model.grid.dphi * cells.flow,
        "section_flow_rate": lambda: (model.grid.sector * cells.flow).sum(axis=-1),
        "section_pressure": lambda: section_mean(cells.pressure, cells.area),
        "wall_stiffness": lambda: model.stiffness,
        **{name: partial(np.asarray, values) for name, values in cells.diagnostics.items()},
        **_of_profiles(model, cells),
    }
    return {name: make() for name, make in fields.items() if names is None or name in names}


def cell_dataset(model: Model, cells: CellHistory, names: Collection[str] | None = None) -> xr.Dataset:
    """Fields of :func:`cell_fields`, on time (s), x (m) and phi (rad)."""
    import xarray as xr

    places = {"time": cells.times, "x": model.grid.x, "phi": model.grid.phi}
    axes = {name: xr.Variable(name, places[name], words) for name, words in AXES.items()}
    fields = {name: described(name, values) for name, values in cell_fields(model, cells, names).items()}
    return xr.Dataset(axes | fields, attrs={"Conventions": CONVENTIONS})


def _of_profiles(model: Model, cells: CellHistory) -> dict[str, Callable[[], Floats]]:
    """What tells the velocity profiles, and the flux between rows where they exchange blood."""
    modes, d, flux = model.two_modes, cells.axis_velocity, cells.azimuthal_flux
    exchange: dict[str, Callable[[], Floats]] = {} if flux is None else {"azimuthal_flux": lambda: flux}
    if modes is None or d is None:
        return {"profile_exponent": lambda: cells.exponent, **exchange}
    return {
        "axis_velocity": lambda: d,
        "profile_bend": lambda: modes.bend(cells.flow / cells.area, d[..., None]),
        **exchange,
    }


def section_mean(values: Floats, area: Floats) -> Floats:
    """Mean over the lumen's section, weight A = R² of each row; (..., n_phi) → (...)."""
    return np.asarray(np.sum(values * area, axis=-1) / np.sum(area, axis=-1))
