"""error(γ) of the closest profile: as curves (figures 3.26, 3.30, 3.37), and at the reduced model's γ."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from validation.metrics import Models, Row
from validation.profiles import errors_at

Floats = NDArray[np.float64]

EXPONENTS = np.geomspace(0.5, 50.0, 121)
CURVE = "reference_profile_error_curve"


def _profiles(models: Models, attributes: Mapping[str, Any]) -> tuple[xr.DataArray, list[int]]:
    """3D axial velocity at the tabulated instants and cells, (time, x, phi, y), and those states."""
    times = models.reference["time"].to_numpy()
    states = [int(np.argmin(np.abs(times - t))) for t in attributes["compare_times_s"]]
    i, j = np.asarray(attributes["compare_i"]) - 1, np.asarray(attributes["compare_j"]) - 1
    return models.reference["axial_velocity"].isel(time=states, x=i, phi=j), states


def error_curves(models: Models, attributes: Mapping[str, Any]) -> xr.DataArray:
    """Relative error of the profile that is closest to 3D for a given γ.

    Returns
    -------
    xarray.DataArray
        On (compare_time, compare_x, compare_phi, exponent); NaN where the reference has no profile.
    """
    chosen, _ = _profiles(models, attributes)
    velocities = chosen.to_numpy().astype(float).reshape(-1, chosen.sizes["y"])
    exponents = np.broadcast_to(EXPONENTS, (len(velocities), EXPONENTS.size))
    curves = errors_at(velocities, chosen["y"].to_numpy(), exponents)
    return xr.DataArray(
        curves.reshape(*chosen.shape[:-1], EXPONENTS.size),
        dims=("compare_time", "compare_x", "compare_phi", "exponent"),
        coords={
            "compare_time": ("compare_time", chosen["time"].to_numpy(), {"units": "s"}),
            "compare_x": ("compare_x", chosen["x"].to_numpy(), {"units": "m"}),
            "compare_phi": ("compare_phi", chosen["phi"].to_numpy(), {"units": "rad"}),
            "exponent": ("exponent", EXPONENTS, {"units": "1", "long_name": "velocity-profile exponent"}),
        },
        attrs={"units": "1", "long_name": "relative error of the closest profile with this exponent"},
    )


def profile_rows(models: Models, attributes: Mapping[str, Any]) -> Iterator[Row]:
    """Error of the profile closest to 3D (``reference``), and of that with the 2D model's γ (``rom``)."""
    chosen, states = _profiles(models, attributes)
    if np.all(np.isnan(chosen)):
        return
    velocities = chosen.to_numpy().astype(float)
    i, j = np.asarray(attributes["compare_i"]), np.asarray(attributes["compare_j"])
    own = models.rom["profile_exponent"].isel(time=states, x=i - 1, phi=j - 1).to_numpy()
    best = models.reference["profile_error"].isel(time=states, x=i - 1, phi=j - 1).to_numpy()
    flat = velocities.reshape(-1, velocities.shape[-1])
    error = errors_at(flat, chosen["y"].to_numpy(), own.reshape(-1, 1)).reshape(own.shape)
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
