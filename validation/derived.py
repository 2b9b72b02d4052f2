"""Fields of the table of fields from mapped states: means, flows, closest profiles, dominance, defects."""

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from cases.fields import FIELDS
from validation.mapping import MappedState
from validation.profiles import closest_profile
from validation.rays import Rays

Floats = NDArray[np.float64]


def as_dataset(values: dict[str, Floats], rays: Rays, times: Floats) -> xr.Dataset:
    """Arrays by field name as a dataset on time, x, phi and y, with units and words."""
    dataset = xr.Dataset(coords={"time": times, "x": rays.x, "phi": rays.phi, "y": rays.y})
    return dataset.assign(
        {
            name: (FIELDS[name].dims, array, {"units": FIELDS[name].unit, "long_name": FIELDS[name].label})
            for name, array in values.items()
        }
    )


def derived_fields(mapped: list[MappedState], rays: Rays, times: Floats) -> xr.Dataset:
    """All fields of a reference from its mapped states.

    Sector flow is the mean velocity u = 2∫₀¹ v_x y dy times the area of the mesh's lumen in that sector, so
    that sectors add up to what flows through the mesh.
    """
    velocity = np.stack([state.velocity for state in mapped]).astype(np.float32)
    axial = velocity[..., 0]
    mean_velocity = np.stack([rays.mean(state.velocity[..., 0]) for state in mapped])
    area = np.stack([state.sector_area for state in mapped])
    pressure = np.stack([state.pressure for state in mapped])
    sector = 0.5 * mean_velocity * area * rays.dphi
    shape = mean_velocity.shape
    closest = closest_profile(axial.reshape(-1, rays.y.size), rays.y)
    inflow = np.array([state.inflow for state in mapped])
    outflow = np.array([state.outflow for state in mapped])
    wall = np.array([state.wall_flow for state in mapped])
    values = {
        "pressure": pressure,
        "radius": np.stack([state.radius for state in mapped]),
        "mean_velocity": mean_velocity,
        "profile_exponent": closest.exponent.reshape(shape),
        "profile_error": closest.error.reshape(shape),
        "sector_flow_rate": sector,
        "section_flow_rate": sector.sum(axis=-1),
        "section_pressure": np.sum(pressure * area, axis=-1) / np.sum(area, axis=-1),
        "axial_velocity": axial,
        "radial_velocity": velocity[..., 1],
        "azimuthal_velocity": velocity[..., 2],
        "mass_defect": mass_defect(inflow, outflow, wall),
        "backflow_fraction": np.mean(axial[..., :-1] <= 0, axis=(1, 2, 3)),
        "axial_dominance_radial": dominance(axial, velocity[..., 1]),
        "axial_dominance_azimuthal": dominance(axial, velocity[..., 2]),
        "axis_velocity_spread": axis_spread(axial[..., 0]),
    }
    return as_dataset(values, rays, times)


def mass_defect(inflow: Floats, outflow: Floats, wall: Floats) -> Floats:
    """(inflow − outflow − dV/dt) over the larger of inflow and outflow, (n_times,); 0 without flow."""
    size = np.maximum(np.abs(inflow), np.abs(outflow))
    defect = np.zeros_like(size)
    np.divide(inflow - outflow - wall, size, out=defect, where=size > 0)
    return defect


def dominance(axial: NDArray[np.floating], across: NDArray[np.floating]) -> Floats:
    """Largest |across|/v_x over time and ray, without the wall (v_x = 0) and backflow, (n_x, n_phi).

    Parameters
    ----------
    axial, across : ndarray (n_times, n_x, n_phi, n_y)
        m/s.
    """
    inner, side = axial[..., :-1], np.abs(across[..., :-1])
    ratio = np.zeros_like(inner)
    np.divide(side, inner, out=ratio, where=inner > 0)
    return np.asarray(ratio.max(axis=(0, 3)), dtype=float)


def axis_spread(axial: NDArray[np.floating]) -> Floats:
    """Largest minus least v_x on the axis over its mean, (..., n_phi) → (...); 0 at rest."""
    mean = np.abs(axial.mean(axis=-1))
    spread = np.asarray(axial.max(axis=-1) - axial.min(axis=-1), dtype=float)
    relative = np.zeros_like(spread)
    np.divide(spread, mean, out=relative, where=mean > 0)
    return relative
