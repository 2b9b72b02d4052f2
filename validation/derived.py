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

    Sector flow ∫₀^R v_x r dr Δφ runs to the ray's end in the mesh, so that sectors add up to what flows
    through the mesh; the mean velocity u = 2∫₀¹ v_x y dy does not depend on that end.
    """
    velocity = np.stack([state.velocity for state in mapped]).astype(np.float32)
    axial = velocity[..., 0]
    mean_velocity = np.stack([rays.mean(state.velocity[..., 0]) for state in mapped])
    chord = np.stack([state.chord for state in mapped])
    pressure = np.stack([state.pressure for state in mapped])
    sector = 0.5 * mean_velocity * chord**2 * rays.dphi
    shape = mean_velocity.shape
    closest = closest_profile(axial.reshape(-1, rays.y.size), rays.y)
    inflow = np.array([state.inflow for state in mapped])
    outflow = np.array([state.outflow for state in mapped])
    wall = np.array([state.wall_flow for state in mapped])
    area = chord**2
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
        "mass_defect": (inflow - outflow - wall) / np.abs(inflow),
        "backflow_fraction": np.mean(axial[..., :-1] <= 0, axis=(1, 2, 3)),
        "axial_dominance_radial": dominance(axial, velocity[..., 1]),
        "axial_dominance_azimuthal": dominance(axial, velocity[..., 2]),
        "axis_velocity_spread": axis_spread(axial[..., 0]),
    }
    return as_dataset(values, rays, times)


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
