"""Two small models made of formulas, side by side as the command combines them."""

import numpy as np
import xarray as xr

from cases.fields import FIELDS
from validation.mapping.derived import as_dataset
from validation.mapping.rays import rays
from validation.metrics.rows import Models, models_of

PERIOD = 0.8
N_X, N_PHI, N_T = 6, 8, 21
CELLS = (np.array([1, 3, 6]), np.array([2, 7]))
TIMES = np.array([0.2, 0.8])


def model_fields(seed: int, calcified: bool) -> xr.Dataset:
    """All fields of a model: smooth, positive, different at every cell and instant."""
    rng = np.random.default_rng(seed)
    cells = rays((np.arange(N_X) + 0.5) * 1e-3, (np.arange(N_PHI) + 0.5) * 2 * np.pi / N_PHI, points=5)
    times = np.linspace(0.0, PERIOD, N_T)
    sizes = {"time": N_T, "x": N_X, "phi": N_PHI, "y": 5}
    scales = {"pressure": 13e3, "section_pressure": 13e3, "radius": 2.8e-3, "profile_exponent": 3.0}
    values = {}
    for name, field in FIELDS.items():
        if not field.dims or name == "wall_stiffness":
            continue
        shape = tuple(sizes[dim] for dim in field.dims)
        wave = 1.0 + 0.3 * np.sin(2 * np.pi * times / PERIOD)
        wave = wave.reshape(-1, *[1] * (len(shape) - 1)) if "time" in field.dims else 1.0
        change = 1.1 if calcified else 1.0
        values[name] = scales.get(name, 0.1) * change * wave * rng.uniform(0.95, 1.05, shape)
    return as_dataset(values, cells, times)


def comparison(rom: dict[str, xr.Dataset], reference: dict[str, xr.Dataset]) -> xr.Dataset:
    """Models by variant as one dataset."""
    parts = [
        xr.merge(
            [
                model[name].rename({field: f"{which}_{field}" for field in model[name].data_vars})
                for which, model in (("rom", rom), ("reference", reference))
            ]
        )
        for name in rom
    ]
    both = xr.concat(parts, dim=xr.Variable("variant", np.array(list(rom), dtype=object)))
    return both.assign_attrs(case="made", period_s=PERIOD)


def two_models(variant: str = "none") -> Models:
    rom, reference = ({variant: model_fields(seed, calcified=False)} for seed in (1, 2))
    return models_in(comparison(rom, reference), variant)


def equal_models() -> Models:
    """A reduced model that is right everywhere."""
    fields = {"none": model_fields(1, calcified=False)}
    return models_in(comparison(fields, fields), "none")


def models_in(both: xr.Dataset, variant: str) -> Models:
    return models_of(both.attrs["case"], variant, both.sel(variant=variant), PERIOD)
