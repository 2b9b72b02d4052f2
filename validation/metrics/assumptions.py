"""The reduced model's assumptions where and when results are tabulated, and against the pulse."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from cases.results.metric_row import MetricRow
from validation.metrics.rows import Models

BY_SECTION = ("axis_velocity_spread", "section_pressure_range")
BY_STATE = ("mass_defect", "backflow_fraction")


def assumption_rows(models: Models, attributes: Mapping[str, Any]) -> Iterator[MetricRow]:
    """Continuity on the axis, pressure over a section, mass and backflow at the tabulated instants."""
    if models.sparse:
        return
    times = models.reference["time"].to_numpy()
    states = {float(t): int(np.argmin(np.abs(times - t))) for t in attributes["compare_times_s"]}
    for quantity in (*BY_SECTION, *BY_STATE):
        sections = [int(i) for i in attributes["compare_i"]] if quantity in BY_SECTION else [None]
        for i in sections:
            for t, n in states.items():
                at = n if i is None else (n, i - 1)
                found = {side: _at(getattr(models, side), quantity, at) for side in ("rom", "reference")}
                yield models.row(quantity, "value", i=i, t_s=t, **found)
    yield _pressure_over_pulse(models)


def _at(fields: Any, quantity: str, at: Any) -> float | None:
    return float(fields[quantity].to_numpy()[at]) if quantity in fields else None


def _pressure_over_pulse(models: Models) -> MetricRow:
    """Largest difference of pressure within a section over the pulse pressure of the same model."""
    shares = []
    for fields, pulse in zip((models.rom, models.reference), models.of_cycle("pulse_pressure"), strict=True):
        largest = float(fields["section_pressure_range"].max())
        shares.append(largest / pulse if pulse else None)
    rom, reference = shares
    return replace(models.row("section_pressure_range", "over_pulse", rom=rom, reference=reference), unit="1")
