"""Fields of the table of fields from mapped states: means, flows, closest profiles, dominance, defects."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from cases.arrays import Floats
from cases.fields import FIELDS
from validation.mapping.meshed_profiles import closest_meshed_profile
from validation.mapping.nodal_shares import TwoRings
from validation.mapping.rays import Rays
from validation.mapping.state import MappedState
from validation.mapping.two_modes import closest_modes


def as_dataset(values: Mapping[str, NDArray[np.floating]], rays: Rays, times: Floats) -> xr.Dataset:
    """Arrays by field name as a dataset on time, x, phi and y, with units and words."""
    dataset = xr.Dataset(coords={"time": times, "x": rays.x, "phi": rays.phi, "y": rays.y})
    return dataset.assign(
        {
            name: (FIELDS[name].dims, array, {"units": FIELDS[name].unit, "long_name": FIELDS[name].label})
            for name, array in values.items()
        }
    )


def derived_fields(mapped: Iterable[MappedState], rays: Rays, times: Floats) -> xr.Dataset:
    """All fields of a reference from its mapped states, taken one by one.

    Parameters
    ----------
    mapped : iterable of MappedState
        As many as there are times.
    rays : Rays
    times : ndarray (n_times,)
        s.
    """
    series: dict[str, NDArray[np.floating]] = {}
    largest: dict[str, Floats] = {}
    for n, state in enumerate(mapped):
        for name, value in _state_fields(state, rays).items():
            if n == 0:
                series[name] = np.empty((len(times), *np.shape(value)), np.result_type(value))
            series[name][n] = value
        for name, ratio in _dominances(state).items():
            largest[name] = np.maximum(largest[name], ratio) if n else ratio
    return as_dataset(series | largest, rays, times)


def _state_fields(state: MappedState, rays: Rays) -> dict[str, Any]:
    """Fields of one state.

    Sector flow is the mean velocity u = 2∫₀¹ v_x y dy times the area of the mesh's lumen in that sector, so
    that sectors add up to what flows through the mesh.
    """
    velocity = state.velocity.astype(np.float32)
    mean_velocity = rays.mean(state.velocity[..., 0])
    sector = 0.5 * mean_velocity * state.sector_area * rays.dphi
    rings = TwoRings(*(part.reshape(-1, rays.y.size) for part in state.rings))
    closest = closest_meshed_profile(state.velocity[..., 0].reshape(-1, rays.y.size), rays.y, rings)
    modes = closest_modes(state.velocity[..., 0], state.rings)
    axial = velocity[..., 0]
    return {
        "pressure": state.pressure,
        "radius": state.radius,
        "mean_velocity": mean_velocity,
        "profile_exponent": closest.exponent.reshape(mean_velocity.shape),
        "profile_error": closest.error.reshape(mean_velocity.shape),
        "axis_velocity": modes.axis_velocity,
        "profile_bend": modes.bend,
        "two_mode_error": modes.error,
        "sector_flow_rate": sector,
        "section_flow_rate": sector.sum(axis=-1),
        "section_pressure": np.average(state.pressure, weights=state.sector_area, axis=-1),
        "section_pressure_range": state.pressure_range,
        "axial_velocity": axial,
        "radial_velocity": velocity[..., 1],
        "azimuthal_velocity": velocity[..., 2],
        "mass_defect": mass_defect(state.inflow, state.outflow, state.wall_flow),
        "backflow_fraction": np.mean(axial[..., :-1] <= 0),
        "axis_velocity_spread": axis_spread(state.velocity[..., 0, 0]),
    }


def _dominances(state: MappedState) -> dict[str, Floats]:
    axial = state.velocity[..., 0]
    return {
        "axial_dominance_radial": dominance(axial, state.velocity[..., 1]),
        "axial_dominance_azimuthal": dominance(axial, state.velocity[..., 2]),
    }


def mass_defect(inflow: float, outflow: float, wall: float) -> float:
    """(inflow − outflow − dV/dt) over the larger of inflow and outflow; 0 without flow."""
    size = max(abs(inflow), abs(outflow))
    return (inflow - outflow - wall) / size if size > 0 else 0.0


def dominance(axial: Floats, across: Floats) -> Floats:
    """Largest |across|/v_x over a ray, without the wall (v_x = 0) and backflow, (n_x, n_phi).

    Parameters
    ----------
    axial, across : ndarray (n_x, n_phi, n_y)
        m/s.
    """
    inner, side = axial[..., :-1], np.abs(across[..., :-1])
    ratio = np.zeros_like(inner)
    np.divide(side, inner, out=ratio, where=inner > 0)
    return np.asarray(ratio.max(axis=-1), dtype=float)


def axis_spread(axial: NDArray[np.floating]) -> Floats:
    """Largest minus least v_x on the axis over its mean, (..., n_phi) → (...); 0 at rest."""
    mean = np.abs(axial.mean(axis=-1))
    spread = np.asarray(axial.max(axis=-1) - axial.min(axis=-1), dtype=float)
    relative = np.zeros_like(spread)
    np.divide(spread, mean, out=relative, where=mean > 0)
    return relative
