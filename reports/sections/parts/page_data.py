"""Data of several interactive pictures: both models over the cycle on all cells."""

from typing import Any

import numpy as np

from cases.arrays import Floats
from cases.fields import FIELDS, Field
from reports.html.packed import pack
from reports.result.load import Comparison
from reports.wording.numbers import DIFFERENCE_UNITS

MODELS = ("reference", "rom")
SHOWN = ("pressure", "radius", "sector_flow_rate", "profile_exponent", "section_flow_rate")
LARGEST_EXPONENT = 100.0  # beyond, a profile is flat to the eye, and one such value would coarsen all others


def page_data(comparison: Comparison) -> dict[str, Any]:
    """Return the axes, the cells and the fields on them as JSON values; display units throughout."""
    data = comparison.fields
    return {
        "variants": comparison.variants,
        "time": digits(data["time"].values),
        "named": [
            {"name": name, "state": state}
            for (name, _), state in zip(comparison.times, comparison.states, strict=True)
        ],
        "x": digits(1e3 * data["x"].values),
        "phi": digits(np.degrees(data["phi"].values)),
        "i": comparison.i,
        "j": comparison.j,
        "y": digits(comparison.profiles["y"].values),
        "calcified": [
            pack(data["calcified"].sel(variant=name).values).plain() for name in comparison.variants
        ],
        "fields": {name: both_models(comparison, FIELDS[name], data) for name in SHOWN},
    }


def digits(values: Floats) -> list[float]:
    """Values as JSON numbers of six digits."""
    return [float(f"{value:.6g}") for value in values]


def both_models(comparison: Comparison, field: Field, data: Any) -> dict[str, Any]:
    """Words, units and packed values of one quantity, a list over the variants for each model."""
    unit, factor = DIFFERENCE_UNITS[field.unit]
    return {
        "label": field.label,
        "symbol": field.symbol,
        "unit": "" if field.display_unit == "1" else field.display_unit,
        "difference_unit": unit,
        "difference_factor": factor / field.display_factor,
        **{
            model: [
                pack(_shown(field, data[f"{model}_{field.name}"].sel(variant=name).values)).plain()
                for name in comparison.variants
            ]
            for model in MODELS
        },
    }


def _shown(field: Field, values: Floats) -> Floats:
    shown = field.display_factor * values.astype(float)
    if field.name == "profile_exponent":
        shown = np.where(shown > LARGEST_EXPONENT, np.inf, shown)
    return shown
