"""The models of every variant on the same points, at the same instants."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import xarray as xr

from cases.arrays import Floats
from cases.reading.case_file import CaseFile
from cases.results.comparison_file import CALCIFIED, REFERENCE, WALL_STIFFNESS, variable
from cases.sections.calcification import NoCalcification
from cases.sections.case import Case
from solver.case.model import calcified_cells
from solver.runs.result import CONVENTIONS
from validation.compare.budget.sources import Sources
from validation.errors import ValidationError
from validation.reference.alignment import Alignment
from validation.reference.kind import Reference
from validation.runs.instants import common_states, nearest_states, wanted_instants
from validation.runs.reduced_model import ReducedModelRun

_AXES = {
    "time": ("s", "time in the cycle"),
    "x": ("m", "distance from the inlet"),
    "phi": ("rad", "azimuthal angle"),
    "y": ("1", "distance from the axis over the radius"),
}


@dataclass(frozen=True)
class VariantRun:
    """What one reduced model of a variant gave, and what it is compared with."""

    case: Case
    rom: ReducedModelRun
    reference: Reference
    sources: Sources | None = None  # of errors; None of a reference that states some values only


def baselines_of(file: CaseFile) -> dict[str, str]:
    """Variant without calcification that each variant's change is counted from.

    It is the first one whose reference is of the same kind and simulation; a variant without such a
    baseline is left out.
    """
    healthy = [n for n, case in file.variants.items() if isinstance(case.calcification, NoCalcification)]
    sources = {n: case.reference and case.reference.source for n, case in file.variants.items()}
    found = {}
    for name in file.variants:
        same = [other for other in healthy if sources[other] == sources[name]]
        if same:
            found[name] = same[0]
    return found


def baseline_of(file: CaseFile) -> str:
    """Name of the first variant without calcification, or "" if there is none."""
    return next(iter(baselines_of(file).values()), "")


def check_variants(cases: Mapping[str, Case]) -> None:
    """Check before any run that variants can share one dataset; models differ in nothing of this.

    Raises
    ------
    ValidationError
        If grids, periods or tabulated cells and instants differ, or the inlet lacks an instant that is to be
        tabulated.
    """
    first_name, first = next(iter(cases.items()))
    for name, case in cases.items():
        wanted_instants(case)
        for what, here, there in (
            ("solver.n_x", case.solver.n_x, first.solver.n_x),
            ("solver.n_phi", case.solver.n_phi, first.solver.n_phi),
            ("geometry.length", case.geometry.length, first.geometry.length),
            ("the inlet's period", case.inlet.period, first.inlet.period),
            ("compare.cells", case.compare.cells, first.compare.cells),
            ("compare.times", case.compare.times, first.compare.times),
        ):
            if here != there:
                raise ValidationError(
                    f"variants {first_name!r} and {name!r} differ in {what} ({there} and {here}); "
                    "variants compared in one report share it"
                )


def at_common_instants(
    cases: Mapping[str, Case], alignments: Mapping[str, Alignment]
) -> tuple[dict[str, Alignment], list[str]]:
    """Keep the states at instants that all variants' references have; say what was left out.

    Raises
    ------
    ValidationError
        If they share too few.
    """
    period = next(iter(cases.values())).inlet.period
    times = [alignment.cycle_times for alignment in alignments.values()]
    kept, notes = {}, []
    for (name, alignment), states in zip(alignments.items(), common_states(times, period), strict=True):
        left = alignment.cycle_times.size - states.size
        if left:
            notes.append(
                f"{name}: {left} states are left out, at instants that other variants' references lack"
            )
        kept[name] = alignment.at(states)
    return kept, notes


def all_models(runs: Mapping[str, VariantRun], times: Floats) -> xr.Dataset:
    """One variant on (time, x, phi, y): ``<model>_<field>`` of each model and of the reference.

    ``times`` are those of the first variant: instants that variants share differ by round-off.
    """
    first = next(iter(runs.values()))
    fields = {model: run.rom.fields for model, run in runs.items()} | {REFERENCE: first.reference.fields}
    parts = [
        each.assign_coords(time=times).rename({name: variable(model, str(name)) for name in each.data_vars})
        for model, each in fields.items()
    ]
    found = xr.merge(parts, join="exact")
    for model, run in runs.items():
        found[variable(model, WALL_STIFFNESS)] = run.rom.stiffness
    calcified = calcified_cells(first.case).astype(np.int8)
    found[CALCIFIED] = (("x", "phi"), calcified, {"units": "1", "long_name": "inside the calcification"})
    for axis, (unit, words) in _AXES.items():
        found[axis].attrs = {"units": unit, "long_name": words}
    return found


def without_fields(run: VariantRun) -> VariantRun:
    """Return what describes a run, without its fields."""
    nothing = xr.Dataset()
    return replace(
        run,
        rom=replace(run.rom, fields=nothing),
        reference=replace(run.reference, fields=nothing),
        sources=run.sources and run.sources.without_fields(),
    )


def attributes(file: CaseFile, times: Floats) -> dict[str, Any]:
    """Return the global attributes of a comparison at these instants of the cycle.

    Raises
    ------
    ValidationError
        If no instant to be tabulated is near any of them.
    """
    case = next(iter(file.variants.values()))
    instants = nearest_states(wanted_instants(case), times)
    if not instants:
        raise ValidationError(
            "compare.times: the reference has no state near any of them; its states are at "
            f"{times.min():.3g} to {times.max():.3g} s of the cycle (reference.time_offset, time_unit)"
        )
    return {
        "Conventions": CONVENTIONS,
        "case": file.name,
        "title": file.title,
        "models": json.dumps(list(file.models)),
        "variant_titles": json.dumps([case.title for case in file.variants.values()], ensure_ascii=False),
        "baseline": baseline_of(file),
        "period_s": case.inlet.period,
        "compare_i": np.array(case.compare.cells.i),
        "compare_j": np.array(case.compare.cells.j),
        "compare_time_names": json.dumps(list(instants)),
        "compare_times_s": times[list(instants.values())],
        "sparse_reference": int(
            any(c.reference is not None and c.reference.sparse for c in file.variants.values())
        ),
        "baselines": json.dumps(baselines_of(file)),
        "case_yaml": file.text,
    }
