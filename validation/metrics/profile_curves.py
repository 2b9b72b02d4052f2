"""error(γ) of the closest profile: as curves (figures 3.26, 3.30, 3.37), and at the reduced model's γ."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import xarray as xr

from cases.arrays import Floats
from cases.results.comparison_file import CURVE_DIMS
from cases.results.metric_row import MetricRow
from validation.mapping.meshed_profiles import meshed_shapes
from validation.mapping.nodal_shares import RINGS, TwoRings
from validation.mapping.profiles import errors_at, errors_of
from validation.metrics.rows import Models

EXPONENTS = np.geomspace(0.5, 50.0, 121)


def _profiles(models: Models, attributes: Mapping[str, Any]) -> tuple[xr.DataArray, list[int]]:
    """3D axial velocity at the tabulated instants and cells, (time, x, phi, y), and those states."""
    times = models.reference["time"].to_numpy()
    states = [int(np.argmin(np.abs(times - t))) for t in attributes["compare_times_s"]]
    i, j = np.asarray(attributes["compare_i"]) - 1, np.asarray(attributes["compare_j"]) - 1
    return models.reference["axial_velocity"].isel(time=states, x=i, phi=j), states


def _errors(models: Models, chosen: xr.DataArray, states: list[int], exponents: Floats) -> Floats:
    """Relative errors (n, m) of the chosen profiles from the closest ones with exponents (n, m).

    Profiles of the family are interpolated as the reference's mesh does; a reference that tells no mesh is
    taken to know its velocity at each point.
    """
    velocities = chosen.to_numpy().astype(float).reshape(-1, chosen.sizes["y"])
    if RINGS not in models.reference:
        return errors_at(velocities, chosen["y"].to_numpy(), exponents)
    parts = models.reference[RINGS].isel(time=states).to_numpy()
    rings = TwoRings(*np.moveaxis(parts.reshape(-1, chosen.sizes["y"], 3), -1, 0))
    return errors_of(velocities, meshed_shapes(rings, exponents))


def error_curves(models: Models, attributes: Mapping[str, Any]) -> xr.DataArray:
    """Relative error of the profile that is closest to 3D for a given γ.

    Returns
    -------
    xarray.DataArray
        On (compare_time, compare_x, compare_phi, exponent); NaN where the reference has no profile.
    """
    chosen, states = _profiles(models, attributes)
    count = chosen.size // chosen.sizes["y"]
    curves = _errors(models, chosen, states, np.broadcast_to(EXPONENTS, (count, EXPONENTS.size)))
    return xr.DataArray(
        curves.reshape(*chosen.shape[:-1], EXPONENTS.size),
        dims=CURVE_DIMS,
        coords={
            "compare_time": ("compare_time", chosen["time"].to_numpy(), {"units": "s"}),
            "compare_x": ("compare_x", chosen["x"].to_numpy(), {"units": "m"}),
            "compare_phi": ("compare_phi", chosen["phi"].to_numpy(), {"units": "rad"}),
            "exponent": ("exponent", EXPONENTS, {"units": "1", "long_name": "velocity-profile exponent"}),
        },
        attrs={"units": "1", "long_name": "relative error of the closest profile with this exponent"},
    )


def profile_rows(models: Models, attributes: Mapping[str, Any]) -> Iterator[MetricRow]:
    """Error of the profile closest to 3D (``reference``), and of that with the 2D model's γ (``rom``)."""
    chosen, states = _profiles(models, attributes)
    if np.all(np.isnan(chosen)):
        return
    i, j = np.asarray(attributes["compare_i"]), np.asarray(attributes["compare_j"])
    own = models.rom["profile_exponent"].isel(time=states, x=i - 1, phi=j - 1).to_numpy()
    best = models.reference["profile_error"].isel(time=states, x=i - 1, phi=j - 1).to_numpy()
    error = _errors(models, chosen, states, own.reshape(-1, 1)).reshape(own.shape)
    for place in np.ndindex(*own.shape):
        yield models.row(
            "profile_error",
            "value",
            i=int(i[place[1]]),
            j=int(j[place[2]]),
            t_s=float(attributes["compare_times_s"][place[0]]),
            rom=float(error[place]),
            reference=float(best[place]),
        )
