"""Both models of every variant on the same points, as one dataset."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from cases.case_file import CaseFile
from cases.schema import Case, NoCalcification
from solver.from_case import calcified_cells
from solver.result import CONVENTIONS
from validation.errors import ValidationError
from validation.instants import common_states, nearest_states, wanted_instants
from validation.reduced_model import ReducedModelRun
from validation.reference import Reference


@dataclass(frozen=True)
class VariantRun:
    """What one variant gave."""

    case: Case
    rom: ReducedModelRun
    reference: Reference


def baseline_of(file: CaseFile) -> str:
    """Name of the first variant without calcification, or "" if there is none."""
    for name, case in file.variants.items():
        if isinstance(case.calcification, NoCalcification):
            return name
    return ""


def check_variants(cases: Mapping[str, Case]) -> None:
    """Check before any run that variants can share one dataset.

    Raises
    ------
    ValidationError
        If grids, periods or tabulated cells and instants differ, a variant has no reference, or the inlet
        lacks an instant that is to be tabulated.
    """
    first_name, first = next(iter(cases.items()))
    for name, case in cases.items():
        if case.reference is None:
            raise ValidationError(f"variant {name!r} states no reference: there is nothing to compare with")
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


def at_common_instants(runs: Mapping[str, VariantRun]) -> tuple[dict[str, VariantRun], list[str]]:
    """Keep the states at instants that all variants' references have; say what was left out.

    Raises
    ------
    ValidationError
        If they share too few.
    """
    period = next(iter(runs.values())).case.inlet.period
    times = [run.reference.alignment.cycle_times for run in runs.values()]
    kept, notes = {}, []
    for (name, run), states in zip(runs.items(), common_states(times, period), strict=True):
        left = run.reference.alignment.cycle_times.size - states.size
        if left:
            notes.append(
                f"{name}: {left} states are left out, at instants that other variants' references lack"
            )
        kept[name] = _restricted(run, states)
    return kept, notes


def _restricted(run: VariantRun, states: NDArray[np.int64]) -> VariantRun:
    reference, alignment = run.reference, run.reference.alignment
    instants = alignment.cycle_times[states]
    planes = np.isin(reference.checks["check_time"].to_numpy(), instants)
    return replace(
        run,
        rom=replace(run.rom, fields=run.rom.fields.isel(time=states)),
        reference=replace(
            reference,
            fields=reference.fields.isel(time=states),
            checks=reference.checks.isel(time=states, check_time=planes),
            alignment=replace(
                alignment,
                states=alignment.states[states],
                cycle_times=instants,
                rom_times=alignment.rom_times[states],
            ),
        ),
    )


def combine(file: CaseFile, runs: Mapping[str, VariantRun]) -> xr.Dataset:
    """One dataset on (variant, time, x, phi, y): ``rom_<field>``, ``reference_<field>``, wall.

    The runs share their instants, see :func:`at_common_instants`.
    """
    first = next(iter(runs.values()))
    times = first.reference.alignment.cycle_times
    stacked = xr.concat(
        [_both_models(run, times) for run in runs.values()],
        dim=xr.Variable("variant", np.array(list(runs), dtype=object)),
        combine_attrs="drop_conflicts",
    )
    return _described(stacked, file, first.case, times)


def _both_models(run: VariantRun, times: np.ndarray) -> xr.Dataset:
    rom = run.rom.fields.rename({name: f"rom_{name}" for name in run.rom.fields.data_vars})
    reference = run.reference.fields
    reference = reference.rename({name: f"reference_{name}" for name in reference.data_vars})
    both = xr.merge([part.assign_coords(time=times) for part in (rom, reference)], join="exact")
    calcified = calcified_cells(run.case).astype(np.int8)
    both["wall_stiffness"] = run.rom.stiffness
    both["calcified"] = (("x", "phi"), calcified, {"units": "1", "long_name": "inside the calcification"})
    return both


def _described(dataset: xr.Dataset, file: CaseFile, case: Case, times: np.ndarray) -> xr.Dataset:
    instants = nearest_states(wanted_instants(case), times)
    if not instants:
        raise ValidationError("compare.times: the reference has no state near any of them")
    dataset["time"].attrs = {"units": "s", "long_name": "time in the cycle"}
    dataset["x"].attrs = {"units": "m", "long_name": "distance from the inlet"}
    dataset["phi"].attrs = {"units": "rad", "long_name": "azimuthal angle"}
    dataset["y"].attrs = {"units": "1", "long_name": "distance from the axis over the radius"}
    dataset.attrs = {
        "Conventions": CONVENTIONS,
        "case": file.name,
        "title": file.title,
        "baseline": baseline_of(file),
        "period_s": case.inlet.period,
        "compare_i": np.array(case.compare.cells.i),
        "compare_j": np.array(case.compare.cells.j),
        "compare_time_names": json.dumps(list(instants)),
        "compare_times_s": times[list(instants.values())],
        "case_yaml": file.text,
    }
    return dataset
