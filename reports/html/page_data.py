"""What the page's interactive pictures are drawn from: both models over the cycle on all cells."""

import json
from typing import Any

import numpy as np

from cases.arrays import Floats
from cases.fields import FIELDS, Field
from cases.results.comparison_file import MODELS, variable
from cases.results.metric_row import MetricRow
from cases.statistics import statistic_of
from reports.html.packed import pack
from reports.result.load import Comparison
from reports.result.metrics import Metrics
from reports.sections.artery import has_shape, view
from reports.wording.numbers import DIFFERENCE_UNITS
from reports.wording.words import field_of, quantity_words, statistic_words

ON_CELLS = ("pressure", "radius", "sector_flow_rate", "profile_exponent")
LARGEST_EXPONENT = 100.0  # beyond, a profile is flat to the eye, and one such value would coarsen all others


def page_data(comparison: Comparison) -> str:
    """Return the JSON that the page's scripts read; display units throughout."""
    data = comparison.fields
    content = {
        "variants": comparison.variants,
        "time": _digits(data["time"].values),
        "named": [
            {"name": name, "state": state}
            for (name, _), state in zip(comparison.times, comparison.states, strict=True)
        ],
        "x": _digits(1e3 * data["x"].values),
        "phi": _digits(np.degrees(data["phi"].values)),
        "i": comparison.i,
        "j": comparison.j,
        "y": _digits(comparison.profiles["y"].values),
        "calcified": [
            pack(data["calcified"].sel(variant=name).values).plain() for name in comparison.variants
        ],
        "fields": {name: _both(comparison, FIELDS[name], data) for name in (*ON_CELLS, "section_flow_rate")},
        "profiles": _both(comparison, FIELDS["axial_velocity"], comparison.profiles),
        "errors": _errors(comparison),
        "artery": _artery(comparison),
        "metrics": _metrics(comparison.metrics),
    }
    return json.dumps(content, ensure_ascii=False, separators=(",", ":"), allow_nan=False)


def _errors(comparison: Comparison) -> dict[str, Any]:
    """Error (%) of the closest profile over its exponent: instant, i, j, γ for each variant."""
    curves = comparison.error_curves
    return {
        "gamma": _digits(curves["exponent"].values),
        "values": [pack(100 * curves.sel(variant=name).values).plain() for name in comparison.variants],
    }


def _artery(comparison: Comparison) -> dict[str, float] | None:
    if not has_shape(comparison):
        return None
    seen = view(comparison)
    return {
        "rest_radius": 1e3 * seen.rest_radius,
        "exaggeration": seen.exaggeration,
        "seen_from": float(np.degrees(seen.seen_from)),
    }


def _digits(values: Floats) -> list[float]:
    return [float(f"{value:.6g}") for value in values]


def _both(comparison: Comparison, field: Field, data: Any) -> dict[str, Any]:
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
                pack(_shown(field, data[variable(model, field.name)].sel(variant=name).values)).plain()
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


def _metrics(metrics: Metrics) -> dict[str, Any]:
    """Return all rows by columns; words that occur often stand once."""
    return {
        "variant": _coded([row.variant for row in metrics.rows]),
        "quantity": _coded([quantity_words(row.quantity) for row in metrics.rows]),
        "statistic": _coded([statistic_words(row.statistic) for row in metrics.rows]),
        "status": _coded([row.status for row in metrics.rows]),
        "unit": _coded([_display(row)[0] for row in metrics.rows]),
        "relative": [statistic_of(row.statistic).relative for row in metrics.rows],
        **{name: [_number(row, name) for row in metrics.rows] for name in _NUMBERS},
    }


_NUMBERS = ("i", "j", "t_s", "reference", "rom", "error", "band")


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
