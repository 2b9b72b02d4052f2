"""A finished run as an xarray dataset with CF-style names and units."""

from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from cases.fields import FIELDS
from solver.cross_flow import azimuthal_flux
from solver.errors import NoAdmissibleProfile
from solver.model import Model
from solver.profiles import continuity_exponent
from solver.schemes.layout import REST_VELOCITY
from solver.simulate import Trajectory

CONVENTIONS = "CF-1.11"


def coordinates(time: NDArray[np.float64], x: NDArray[np.float64], phi: NDArray[np.float64]) -> xr.Dataset:
    """Dataset that holds only the coordinates time (s), x (m) and phi (rad)."""
    return xr.Dataset(
        coords={
            "time": ("time", time, {"units": "s", "long_name": "time"}),
            "x": ("x", x, {"units": "m", "long_name": "distance from the inlet"}),
            "phi": ("phi", phi, {"units": "rad", "long_name": "azimuthal angle"}),
        }
    )


def described(name: str, values: NDArray[np.float64]) -> xr.Variable:
    """Values as a variable with the dimensions, unit and words of the table of fields."""
    field = FIELDS[name]
    return xr.Variable(
        field.dims, values, {"units": field.unit, "long_name": field.label, "symbol": field.symbol}
    )


def cell_flow(flow: NDArray[np.float64]) -> NDArray[np.float64]:
    """Q at cell centres, (..., n_x, n_phi), from faces, (..., n_x + 1, n_phi), m³/s."""
    return np.asarray(0.5 * (flow[..., 1:, :] + flow[..., :-1, :]))


def profile_exponent(trajectory: Trajectory, velocity: NDArray[np.float64]) -> NDArray[np.float64]:
    """γ of every cell by the continuity closure.

    Raises
    ------
    NoAdmissibleProfile
        Where a cell has none.
    """
    fixed = trajectory.model.fixed_exponent
    if fixed is not None:
        return np.full(velocity.shape, fixed)
    exponent = continuity_exponent(velocity, REST_VELOCITY)
    missing = np.argwhere(~np.isfinite(exponent))
    if missing.size:
        n, i, j = (int(k) for k in missing[0])
        raise NoAdmissibleProfile(float(trajectory.times[n]), i + 1, j + 1)
    return exponent


def to_dataset(trajectory: Trajectory) -> xr.Dataset:
    """Fields of a run at cell centres.

    Returns
    -------
    xarray.Dataset
        pressure, radius, mean_velocity, profile_exponent, sector_flow_rate on (time, x, phi), and
        azimuthal_flux where rows exchange blood;
        section_flow_rate, section_pressure on (time, x); wall_stiffness on
        (x, phi); mass_defect on (time). SI.

    Raises
    ------
    NoAdmissibleProfile
        Where a cell has no exponent γ > 0.
    """
    flow = cell_flow(trajectory.flow)
    exponent = profile_exponent(trajectory, flow / trajectory.area)
    cells = CellHistory(
        trajectory.times, trajectory.area, flow, trajectory.pressure, exponent, trajectory.mass_defect
    )
    dataset = cell_dataset(trajectory.model, cells)
    wall, grid = trajectory.model.section_wall, trajectory.model.grid
    if wall is not None:
        crossing = [
            azimuthal_flux(wall, grid.dx, grid.dphi, pressure[:, 0], faces)
            for pressure, faces in zip(trajectory.pressure, trajectory.flow, strict=True)
        ]
        dataset["azimuthal_flux"] = described("azimuthal_flux", np.array(crossing))
    return dataset.assign_attrs(
        scheme="semi_implicit",
        time_step_s=trajectory.longest_step,
        steps=trajectory.steps,
        iteration_sweeps=trajectory.sweeps,
    )


class CellHistory(NamedTuple):
    """States at cell centres: times (n,), s; A, m², Q, m³/s, P, Pa, γ (n, n_x, n_phi); mass defect (n,)."""

    times: NDArray[np.float64]
    area: NDArray[np.float64]
    flow: NDArray[np.float64]
    pressure: NDArray[np.float64]
    exponent: NDArray[np.float64]
    mass_defect: NDArray[np.float64]


def cell_dataset(model: Model, cells: CellHistory) -> xr.Dataset:
    """Fields of the table of fields from states at cell centres; see :func:`to_dataset`."""
    sector = 0.5 * model.grid.dphi * cells.flow
    fields = {
        "pressure": cells.pressure,
        "radius": np.sqrt(cells.area),
        "mean_velocity": cells.flow / cells.area,
        "profile_exponent": cells.exponent,
        "sector_flow_rate": sector,
        "section_flow_rate": sector.sum(axis=-1),
        "section_pressure": section_mean(cells.pressure, cells.area),
        "wall_stiffness": model.stiffness,
        "mass_defect": cells.mass_defect,
    }
    dataset = coordinates(cells.times, model.grid.x, model.grid.phi)
    dataset = dataset.assign({name: described(name, values) for name, values in fields.items()})
    return dataset.assign_attrs(Conventions=CONVENTIONS)


def section_mean(values: NDArray[np.float64], area: NDArray[np.float64]) -> NDArray[np.float64]:
    """Mean over the lumen's section, weight A = R² of each row; (..., n_phi) → (...)."""
    return np.asarray(np.sum(values * area, axis=-1) / np.sum(area, axis=-1))
