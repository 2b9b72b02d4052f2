"""What is kept of each sample: numbers of its last cycle, and how far it is from what judges it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from cases.arrays import Floats
from cases.fields import FIELDS, Field
from cases.results.sweep import KeptOutput, OutputBand
from cases.sections.calcification import LocalCalcification, NoCalcification
from cases.sections.case import Case
from cases.sections.compare import Band
from cases.statistics import statistic_of
from validation.metrics.quantities import CYCLE_QUANTITIES, values_of
from validation.sweep.judging import Against, judged_bands

if TYPE_CHECKING:
    import xarray as xr

Measure = Callable[[Case, "xr.Dataset"], float]

MEASURED = ("pressure", "radius", "section_flow_rate", "section_pressure")  # fields that outputs are of
CYCLE_CHANGE = "cycle_change"  # output, and attribute of a last cycle that tells it


@dataclass(frozen=True)
class Output:
    """One number of a sample.

    Attributes
    ----------
    name, label : str
        Column in the dataset; words for people.
    unit, display_unit : str
        SI unit of stored values; unit people read.
    display_factor : float
        Display value = stored value × display_factor.
    bands : tuple of Band
        What is judged: one declared band or more, or one that has no limit; empty where nothing is.
    """

    name: str
    label: str
    unit: str
    display_unit: str
    display_factor: float
    bands: tuple[Band, ...] = ()


def _at_end(index: int, number: Callable[[Floats], float]) -> Measure:
    def measure(_case: Case, last: xr.Dataset) -> float:
        return number(values_of("section_pressure", last)[:, index])

    return measure


def _mean_over_cycle(index: int) -> Measure:
    def measure(_case: Case, last: xr.Dataset) -> float:
        pressure, times = values_of("section_pressure", last)[:, index], values_of("time", last)
        return float(np.trapezoid(pressure, times) / (times[-1] - times[0]))

    return measure


def _of_cycle(name: str) -> Measure:
    return lambda _case, last: CYCLE_QUANTITIES[name](last)


def _patch_section(case: Case, last: xr.Dataset) -> int:
    """Section nearest to the centre of the calcification, of several the first; mid-length without one."""
    parts = case.calcification.parts
    ends = parts[0].x if parts else (0.0, case.geometry.length)
    return int(np.argmin(np.abs(values_of("x", last) - 0.5 * (ends[0] + ends[1]))))


def _patch_row(case: Case, last: xr.Dataset) -> int:
    """Row nearest to the centre of the calcification; the first one of a ring, whose rows are alike."""
    part = next(iter(case.calcification.parts), None)
    if not isinstance(part, LocalCalcification):
        return 0
    first, end = part.phi
    centre = first + 0.5 * ((end - first) % (2.0 * np.pi))
    phi = values_of("phi", last)
    apart = np.abs(np.exp(1j * phi) - np.exp(1j * centre))
    if phi.max() < np.pi:  # rows of one half, which stand for their mirror images
        apart = np.minimum(apart, np.abs(np.exp(-1j * phi) - np.exp(1j * centre)))
    return int(np.argmin(apart))


def _growth(radius: Floats) -> float:
    return float(radius.max() / radius.min() - 1.0)


def _radius_change(case: Case, last: xr.Dataset) -> float:
    return _growth(values_of("radius", last)[:, _patch_section(case, last)].mean(axis=-1))


def _calcified_radius_change(case: Case, last: xr.Dataset) -> float:
    return _growth(values_of("radius", last)[:, _patch_section(case, last), _patch_row(case, last)])


def _flow_amplitude(_case: Case, last: xr.Dataset) -> float:
    return float(np.ptp(values_of("section_flow_rate", last)[:, last.sizes["x"] // 2]))


def _cycle_change(_case: Case, last: xr.Dataset) -> float:
    return float(last.attrs[CYCLE_CHANGE])


def _like(name: str, label: str, field: Field) -> Output:
    return Output(name, label, field.unit, field.display_unit, field.display_factor)


def _percent(name: str, label: str) -> Output:
    return Output(name, label, "1", "%", 100.0)


def _own_outputs() -> dict[str, tuple[Output, Measure]]:
    found: list[tuple[Output, Measure]] = []
    for place, index in (("inlet", 0), ("outlet", -1)):
        kinds: tuple[tuple[str, Measure], ...] = (
            ("systolic", _at_end(index, lambda p: float(p.max()))),
            ("diastolic", _at_end(index, lambda p: float(p.min()))),
            ("mean", _mean_over_cycle(index)),
            ("pulse", _at_end(index, lambda p: float(p.max() - p.min()))),
        )
        for kind, measure in kinds:
            label = f"{kind} pressure at the {place}"
            found.append((_like(f"{kind}_pressure_{place}", label, FIELDS["pressure"]), measure))
    change = "largest radius change at the calcification"
    found += [
        (_percent("radius_change", f"{change}, mean of the section"), _radius_change),
        (_percent("radius_change_calcified", f"{change}, calcified row"), _calcified_radius_change),
        (
            _like(
                "flow_amplitude",
                "amplitude of the flow rate (largest − least) at mid-length",
                FIELDS["section_flow_rate"],
            ),
            _flow_amplitude,
        ),
    ]
    kept = ("largest_radius", "least_radius", "largest_pressure_difference", "largest_radius_variation")
    found += [(_like(name, FIELDS[name].label, FIELDS[name]), _of_cycle(name)) for name in kept]
    found.append(
        (_percent(CYCLE_CHANGE, "change of pressure and flow rate over the last cycle"), _cycle_change)
    )
    return {output.name: (output, measure) for output, measure in found}


OWN: Mapping[str, tuple[Output, Measure]] = MappingProxyType(_own_outputs())


def _size(name: str, field: str) -> tuple[Output, Measure]:
    def measure(_case: Case, last: xr.Dataset) -> float:
        return float(np.abs(values_of(field, last)).max())

    return _like(name, f"size of the {FIELDS[field].label}", FIELDS[field]), measure


# how large the fields are of which outputs are, by unit: small differences are measured by it
SIZES: Mapping[str, tuple[Output, Measure]] = MappingProxyType(
    {
        FIELDS[field].unit: _size(f"{field}_size", field)
        for field in ("section_pressure", "radius", "section_flow_rate")
    }
)
MEASURES: Mapping[str, Measure] = MappingProxyType(
    {output.name: measure for output, measure in (*OWN.values(), *SIZES.values())}
)


def judged_output(bands: tuple[Band, ...]) -> Output:
    """Return the output that bands of one quantity and one statistic judge."""
    band = bands[0]
    name, field = f"{band.quantity}_{band.statistic}", FIELDS[band.quantity]
    label = f"{statistic_of(band.statistic).of_quantity} of the {field.label}"
    if band.relative:
        return Output(name, label, "1", "%", 100.0, bands)
    return Output(name, label, field.unit, field.display_unit, field.display_factor, bands)


def offered_outputs(cases: Mapping[str, Case], against: Against) -> dict[str, Output]:
    """Return all outputs that a study of these cases, by variant, may keep, by name."""
    calcified = not all(isinstance(case.calcification, NoCalcification) for case in cases.values())
    own = {
        name: output for name, (output, _) in OWN.items() if calcified or name != "radius_change_calcified"
    }
    judged = [judged_output(bands) for bands in judged_bands(cases, against)]
    return own | {output.name: output for output in judged}


def described(output: Output) -> KeptOutput:
    """Return an output for study.json: with the limit and reason of the band that judges it."""
    declared = [band for band in output.bands if np.isfinite(band.limit)]
    limits = [OutputBand(limit=b.limit, reason=b.reason, variants=b.variants) for b in declared]
    return KeptOutput(
        name=output.name,
        label=output.label,
        unit=output.display_unit,
        unit_si=output.unit,
        display_factor=output.display_factor,
        band=limits[0] if limits else None,
    )
