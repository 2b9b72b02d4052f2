"""Data of interactive pictures: packed fields of all models on all cells, and all rows of metrics.json."""

import base64
import json
import zlib
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import xarray as xr

from cases.arrays import Floats
from cases.fields import FIELDS, Field
from cases.results.comparison_file import REFERENCE, ROM, variable
from cases.results.metric_row import MetricRow
from cases.statistics import statistic_of
from reports.result.load import Comparison
from reports.sections.parts.models import headed
from reports.wording.numbers import DIFFERENCE_UNITS
from reports.wording.words import field_of, quantity_words, statistic_words

LEVELS = 65534  # the largest whole number that stands for a value
ABSENT = 65535  # stands for what is not finite


@dataclass(frozen=True)
class Packed:
    """An array as text.

    Attributes
    ----------
    shape : tuple of int
        Of the array.
    low, step : float
        Value = low + step × whole number.
    data : str
        Base 64 of zlib of all low bytes, then all high bytes, of the whole numbers' differences along each
        axis in turn (modulo 2¹⁶).
    """

    shape: tuple[int, ...]
    low: float
    step: float
    data: str

    def plain(self) -> dict[str, object]:
        """As JSON."""
        return asdict(self)


def pack(values: Floats, levels: int = LEVELS) -> Packed:
    """Pack an array of any shape; the values come back to half a level, of so many in their range."""
    finite = np.isfinite(values)
    low, high = (float(values[finite].min()), float(values[finite].max())) if finite.any() else (0.0, 0.0)
    step = (high - low) / levels or 1.0
    whole = np.full(values.shape, ABSENT, dtype=np.uint16)
    whole[finite] = np.round((values[finite] - low) / step).astype(np.uint16)
    for axis in range(whole.ndim):
        whole = np.diff(whole, axis=axis, prepend=np.uint16(0))
    octets = (whole & 0xFF).astype(np.uint8).tobytes() + (whole >> 8).astype(np.uint8).tobytes()
    return Packed(values.shape, low, step, base64.b64encode(zlib.compress(octets, 6)).decode())


SHOWN = ("pressure", "radius", "sector_flow_rate", "profile_exponent", "section_flow_rate")
LEVELS_OF_EXPONENT = 10_000  # two decimals of up to 100; finer ones would be a tenth of the page
LARGEST_EXPONENT = 100.0  # beyond, a profile is flat to the eye, and one such value would coarsen all others


def page_data(comparison: Comparison) -> dict[str, Any]:
    """Return the axes, the cells and the fields on them as JSON values; display units throughout."""
    data = comparison.fields
    return {
        "variants": comparison.variants,
        "models": [{"name": name, "label": headed(comparison, name)} for name in comparison.models],
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
        "fields": {name: all_models(comparison, FIELDS[name], _fields) for name in SHOWN},
    }


def digits(values: Floats) -> list[float]:
    """Values as JSON numbers of six digits."""
    return [float(f"{value:.6g}") for value in values]


def all_models(
    comparison: Comparison, field: Field, data: Callable[[Comparison], xr.Dataset]
) -> dict[str, Any]:
    """Words, units and packed values of one quantity, a list over the variants for each model.

    `data` returns where a comparison holds the quantity's values, of the reference and of the model in view.
    """
    unit, factor = DIFFERENCE_UNITS[field.unit]
    levels = LEVELS_OF_EXPONENT if field.name == "profile_exponent" else LEVELS

    def packed(seen: Comparison, name: str) -> list[dict[str, object]]:
        values = data(seen)[variable(name, field.name)]
        return [
            pack(_shown(field, values.sel(variant=variant).values), levels).plain()
            for variant in comparison.variants
        ]

    return {
        "label": field.label,
        "symbol": field.symbol,
        "unit": "" if field.display_unit == "1" else field.display_unit,
        "difference_unit": unit,
        "difference_factor": factor / field.display_factor,
        "values": {
            REFERENCE: packed(comparison, REFERENCE),
            **{model: packed(comparison.of(model), ROM) for model in comparison.models},
        },
    }


def _fields(comparison: Comparison) -> xr.Dataset:
    return comparison.fields


def _shown(field: Field, values: Floats) -> Floats:
    shown = field.display_factor * values.astype(float)
    if field.name == "profile_exponent":
        shown = np.where(shown > LARGEST_EXPONENT, np.inf, shown)
    return shown


_NUMBERS = ("i", "j", "t_s", "reference", "rom", "error", "band")


def metric_columns(comparison: Comparison) -> str:
    """Return all rows of all models by columns as base 64 of zlib of JSON; words that recur stand once."""
    rows = [row for model in comparison.models for row in comparison.of(model).metrics.rows]
    columns = {
        **({"model": _coded([row.model for row in rows])} if len(comparison.models) > 1 else {}),
        "variant": _coded([row.variant for row in rows]),
        "quantity": _coded([quantity_words(row.quantity) for row in rows]),
        "statistic": _coded([_statistic(row) for row in rows]),
        "status": _coded([row.status for row in rows]),
        "unit": _coded([_display(row)[0] for row in rows]),
        "relative": [statistic_of(row.statistic).relative for row in rows],
        **{name: [_number(row, name) for row in rows] for name in _NUMBERS},
    }
    text = json.dumps(columns, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    return base64.b64encode(zlib.compress(text.encode(), 6)).decode()


def _statistic(row: MetricRow) -> str:
    words = statistic_words(row.statistic)
    return f"{words}, with the inflow of 3D" if row.inflow else words


def _display(row: MetricRow) -> tuple[str, float]:
    """Return the unit that people read a row's values in, and display over stored value."""
    field = field_of(row.quantity, row.unit)
    return (field.display_unit, field.display_factor) if row.unit == field.unit else (row.unit, 1.0)


def _number(row: MetricRow, name: str) -> float | None:
    value = getattr(row, name)
    relative = name in ("error", "band") and statistic_of(row.statistic).relative
    if name in ("reference", "rom", "error", "band") and value is not None and not relative:
        value *= _display(row)[1]
    return float(f"{value:.6g}") if isinstance(value, float) else value


def _coded(words: list[str]) -> dict[str, list[Any]]:
    names = list(dict.fromkeys(words))
    number = {name: k for k, name in enumerate(names)}
    return {"names": names, "rows": [number[word] for word in words]}
