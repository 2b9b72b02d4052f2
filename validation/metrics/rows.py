"""Every figure of a comparison as one row of data."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from cases.arrays import Floats
from cases.fields import FIELDS
from cases.quantities import of_cycle, pooled, reads, statistics_of, tabulated
from cases.results.comparison_file import REFERENCE, ROM, variable
from cases.results.metric_row import COLUMNS, MetricRow, metric_row
from cases.statistics import statistic_of
from validation.metrics.quantities import CYCLE_QUANTITIES, phase_lag, values_of
from validation.metrics.statistics import EXTREMES, OF_ERROR, relative_error, statistic_value

DOMINANCE = ("axial_dominance_radial", "axial_dominance_azimuthal")


@dataclass(frozen=True)
class Models:
    """A reduced model and the reference of one variant, fields under their own names.

    Where the reference is ``sparse``, NaN is what it does not state. ``stated`` are its own numbers of the
    cycle, by quantity.
    """

    case: str
    variant: str
    rom: xr.Dataset
    reference: xr.Dataset
    period: float
    sparse: bool = False
    stated: Mapping[str, float] = field(default_factory=dict)
    model: str = ROM
    _errors: dict[str, Floats | None] = field(default_factory=dict, init=False, repr=False, compare=False)

    def has(self, quantity: str) -> bool:
        """Whether both models have a quantity."""
        return all(name in self.rom and name in self.reference for name in reads(quantity))

    def pair(self, quantity: str) -> tuple[Floats, Floats]:
        """Values of a quantity in both models, float64."""
        return values_of(quantity, self.rom), values_of(quantity, self.reference)

    def relative_error(self, quantity: str) -> Floats | None:
        """Relative error of a quantity over all entries, computed once; None where it has no meaning."""
        if quantity not in self._errors:
            self._errors[quantity] = relative_error(*self.pair(quantity))
        return self._errors[quantity]

    def pooled(self, quantity: str, name: str) -> float | None:
        """Value of a statistic over all cells and states; None where it has no meaning."""
        if self.sparse or name not in OF_ERROR:
            return self.statistic(name, *self.pair(quantity))
        error = self.relative_error(quantity)
        return None if error is None else OF_ERROR[name](error)

    def statistic(self, name: str, rom: Floats, reference: Floats) -> float | None:
        """Value of a statistic over all entries that the reference states; None where it has no meaning."""
        if self.sparse:
            there = ~np.isnan(reference)
            rom, reference = rom[there], reference[there]
            if not reference.size or name in EXTREMES:  # a few instants have no systole
                return None
        return statistic_value(name, rom, reference)

    def of_cycle(self, quantity: str) -> tuple[float, float | None]:
        """One number of the cycle in both models."""
        measure = CYCLE_QUANTITIES[quantity]
        if self.sparse:
            return measure(self.rom), self.stated.get(quantity)
        return measure(self.rom), measure(self.reference)

    def row(self, quantity: str, statistic: str, **values: Any) -> MetricRow:
        """Row of this variant; its unit is that of values, or of an absolute error."""
        has_unit = not statistic_of(statistic).relative or "rom" in values or "reference" in values
        unit = FIELDS[quantity].unit if has_unit else "1"
        return metric_row(self.case, self.variant, self.model, quantity, statistic, unit=unit, **values)


def models_of(
    case: str, variant: str, both: xr.Dataset, period: float, model: str = ROM, **about: Any
) -> Models:
    """One variant's fields ``<model>_…`` and ``reference_…`` as a reduced model and the reference.

    ``about``: ``sparse`` and ``stated`` of :class:`Models`.
    """

    def fields(of: str) -> xr.Dataset:
        prefix = variable(of, "")
        names = {str(n): str(n).removeprefix(prefix) for n in both.data_vars if str(n).startswith(prefix)}
        return both[list(names)].rename(names)

    return Models(case, variant, fields(model), fields(REFERENCE), period, model=model, **about)


def _single(rom: float, reference: float | None) -> float | None:
    if reference is None:
        return None
    error = relative_error(np.atleast_1d(rom), np.atleast_1d(reference))
    return None if error is None else float(error[0])


def _number(value: float) -> float | None:
    """Return a value, or None for what a reference does not state."""
    return None if np.isnan(value) else float(value)


def value_rows(models: Models, cells: tuple[Floats, Floats], times: Floats) -> Iterator[MetricRow]:
    """Values of both models at the chosen cells and instants."""
    states = [int(np.argmin(np.abs(models.rom["time"].to_numpy() - t))) for t in times]
    for quantity in tabulated():
        rom, reference = models.pair(quantity)
        for place, at in _cells_of(quantity, cells):
            for t, ours, theirs in zip(times, rom[at][states], reference[at][states], strict=True):
                both = {"rom": float(ours), "reference": _number(theirs)}
                error = _single(ours, theirs)
                yield models.row(quantity, "value", **place, t_s=float(t), **both, error=error)


def _cells_of(quantity: str, cells: tuple[Floats, Floats]) -> Iterator[tuple[dict[str, Any], Any]]:
    """Chosen cells of a quantity, or sections of one of whole ones: as a row names them, and their index."""
    by_row = "phi" in FIELDS[quantity].dims
    for i in cells[0]:
        for j in cells[1] if by_row else (None,):
            at = np.s_[:, i - 1] if j is None else np.s_[:, i - 1, j - 1]
            yield {"i": int(i), "j": None if j is None else int(j)}, at


def cycle_error_rows(models: Models, cells: tuple[Floats, Floats]) -> Iterator[MetricRow]:
    """Errors over the cycle at each chosen cell."""
    for quantity in pooled():
        rom, reference = models.pair(quantity)
        for place, at in _cells_of(quantity, cells):
            for statistic in ("rms_error", "max_error", *EXTREMES):
                error = models.statistic(statistic, rom[at], reference[at])
                yield models.row(quantity, statistic, error=error, **place)


def pooled_rows(models: Models) -> Iterator[MetricRow]:
    """Statistics over all cells and states; for the largest error, where and when it is."""
    for quantity in pooled():
        rom, reference = models.pair(quantity)
        for statistic in statistics_of(quantity):
            row = models.row(quantity, statistic, error=models.pooled(quantity, statistic))
            yield _with_place(row, models, rom, reference) if statistic.startswith("max_") else row


def _with_place(row: MetricRow, models: Models, rom: Floats, reference: Floats) -> MetricRow:
    """Add cell, instant and values of the largest error."""
    if row.error is None:
        return row
    error = rom - reference if row.statistic == "max_difference" else rom / reference - 1.0
    at = np.unravel_index(int(np.nanargmax(np.abs(error))), error.shape)
    return replace(
        row,
        unit=FIELDS[row.quantity].unit,
        i=int(at[1]) + 1,
        j=int(at[2]) + 1 if len(at) > 2 else None,
        t_s=float(models.rom["time"].to_numpy()[at[0]]),
        rom=float(rom[at]),
        reference=float(reference[at]),
    )


def cycle_rows(models: Models) -> Iterator[MetricRow]:
    """One number per cycle."""
    for quantity in of_cycle():
        rom, reference = models.of_cycle(quantity)
        yield models.row(quantity, "cycle", rom=rom, reference=reference, error=_single(rom, reference))
    if not models.sparse:
        yield models.row("phase_lag", "cycle", rom=phase_lag(models.rom, models.reference, models.period))


def check_rows(models: Models) -> Iterator[MetricRow]:
    """Tell whether the reduced model's assumptions, and both simulations, hold."""
    for quantity in ("mass_defect", "axis_velocity_spread", "section_pressure_range"):
        rom, reference = models.pair(quantity)
        yield models.row(quantity, "largest", rom=float(np.max(np.abs(rom))), reference=_largest(reference))
    for quantity in ("backflow_fraction", *DOMINANCE):
        for model, fields in (("reference", models.reference), ("rom", models.rom)):
            if quantity in fields:  # a row a model: each is largest elsewhere
                values = fields[quantity].to_numpy()
                yield models.row(quantity, "largest", **{model: _largest(values)}, **_cell_of_largest(values))


def _cell_of_largest(values: Floats) -> dict[str, int]:
    """Cell of the largest of (n_x, n_phi) values; nothing of others, or where nothing is stated."""
    if values.ndim != 2 or np.all(np.isnan(values)):
        return {}
    i, j = np.unravel_index(int(np.nanargmax(values)), values.shape)
    return {"i": int(i) + 1, "j": int(j) + 1}


def _largest(values: Floats) -> float | None:
    """Largest magnitude; None where a reference states nothing."""
    return None if np.all(np.isnan(values)) else float(np.nanmax(np.abs(values)))


def dominance_rows(models: Models, cells: tuple[Floats, Floats]) -> Iterator[MetricRow]:
    """Axial dominance at the chosen cells (tables 3.10 and 3.11)."""
    for quantity in DOMINANCE:
        values = models.reference[quantity].to_numpy()
        own = models.rom[quantity].to_numpy() if quantity in models.rom else None
        for i in cells[0]:
            for j in cells[1]:
                ratio = _number(values[i - 1, j - 1])
                estimate = None if own is None else float(own[i - 1, j - 1])
                yield models.row(quantity, "value", i=int(i), j=int(j), rom=estimate, reference=ratio)


def plane_rows(models: Models, checks: xr.Dataset) -> Iterator[MetricRow]:
    """3D section flow by rays (``reference``), and its deviation from planes cut by VTK (``error``)."""
    if "plane_flow_rate" not in checks:
        return
    by_rays = models.reference["section_flow_rate"]
    times, stations = models.reference["time"].to_numpy(), models.reference["x"].to_numpy()
    for t, at_time in zip(checks["check_time"].to_numpy(), checks["plane_flow_rate"].to_numpy(), strict=True):
        for x, plane in zip(checks["check_x"].to_numpy(), at_time, strict=True):
            n, i = int(np.argmin(np.abs(times - t))), int(np.argmin(np.abs(stations - x)))
            q = float(by_rays[n, i])
            place = {"i": i + 1, "t_s": float(t), "reference": q}
            yield models.row("section_flow_rate", "plane_integral", error=_single(q, plane), **place)


def inflow_rows(models: Models, checks: xr.Dataset, prescribed: Floats | None) -> Iterator[MetricRow]:
    """3D inflow by surface integral (``reference``), and its deviation from the prescribed (``error``)."""
    if prescribed is None:
        return
    inflow = checks["inlet_flow_rate"].to_numpy()
    error = relative_error(inflow, prescribed)
    for n, t in enumerate(models.reference["time"].to_numpy()):
        yield models.row(
            "section_flow_rate",
            "prescribed_inflow",
            t_s=float(t),
            reference=float(inflow[n]),
            error=None if error is None else float(error[n]),
        )


def cost_rows(models: Models, rom: dict[str, Any], reference: dict[str, Any]) -> Iterator[MetricRow]:
    """Tell what a simulation took, where its log does; the 2D model's wall times differ from run to run."""
    cost = reference.get("cost")
    if cost is None:
        return
    yield models.row("wall_time", "cost", reference=cost["wall_time_s"])
    yield models.row("time_steps", "cost", rom=float(rom["steps"]), reference=float(cost["time_steps"]))
    yield models.row("iterations", "cost", reference=float(cost["iterations"]))


def change_rows(rows: list[MetricRow], baselines: Mapping[str, str]) -> Iterator[MetricRow]:
    """Values and cycle quantities minus, and over, the baseline's: what calcification changes.

    Parameters
    ----------
    rows : list of MetricRow
        Of all variants.
    baselines : mapping of str to str
        By variant, the one to compare it with.
    """
    kept = [
        row
        for row in rows
        if row.statistic in ("value", "cycle")
        and not row.inflow
        and row.rom is not None
        and row.quantity not in DOMINANCE
    ]
    known = {(r.variant, r.model, r.quantity, r.statistic, r.i, r.j, r.t_s): r for r in kept}
    for row in kept:
        baseline = baselines.get(row.variant, row.variant)
        other = known.get((baseline, row.model, row.quantity, row.statistic, row.i, row.j, row.t_s))
        if row.variant != baseline and other is not None:
            yield from _change(row, other)


def _change(row: MetricRow, base: MetricRow) -> Iterator[MetricRow]:
    if row.rom is None or row.reference is None or base.rom is None or base.reference is None:
        return
    rom, reference = row.rom - base.rom, row.reference - base.reference
    yield replace(row, statistic="change", rom=rom, reference=reference, error=_single(rom, reference))
    if base.rom and base.reference:
        rom, reference = row.rom / base.rom, row.reference / base.reference
        yield replace(
            row, statistic="ratio", rom=rom, reference=reference, error=_single(rom, reference), unit="1"
        )


def to_frame(rows: list[MetricRow]) -> pd.DataFrame:
    """Rows as a table with the columns of the harness, in their order; missing entries are null."""
    table = pd.DataFrame([vars(row) for row in rows], columns=COLUMNS)
    numbers = ["t_s", "rom", "reference", "error", "band"]
    table[numbers] = table[numbers].astype(float).replace([np.inf, -np.inf], np.nan)  # γ of plug flow
    return table.astype({"i": "Int64", "j": "Int64"})
