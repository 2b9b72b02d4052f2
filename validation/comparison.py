"""Both models of every variant on the same points, as one dataset."""

import json
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr

from cases.case_file import CaseFile
from cases.schema import Case, NoCalcification
from solver.from_case import calcified_cells, inlet_signal
from solver.result import CONVENTIONS
from solver.waveform import local_minima
from validation.errors import ValidationError
from validation.reduced_model import ReducedModelRun
from validation.reference import Reference

TIME_TOLERANCE = 1e-4  # share of a cycle by which states of two variants may differ


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


def compare_times(case: Case, times: np.ndarray) -> tuple[list[str], list[int]]:
    """Names and state numbers of the instants that the case wants tabulated.

    Named instants come from the inlet waveform: systole is its maximum, the troughs its local minima
    after it. Each becomes the nearest state.
    """
    waveform = inlet_signal(case)
    fine = np.linspace(0.0, waveform.period, 4001)
    minima = local_minima(waveform)
    instants = {"systole": float(fine[np.argmax(waveform(fine))]), "end diastole": waveform.period}
    instants |= {f"{word} trough": float(t) for word, t in zip(("first", "second"), minima, strict=False)}
    names, states = [], []
    for wanted in case.compare.times:
        if isinstance(wanted, str) and wanted not in instants:
            raise ValidationError(
                f"compare.times: the inlet has no {wanted!r}; it has: {', '.join(sorted(instants))}"
            )
        instant = instants[wanted] if isinstance(wanted, str) else wanted
        names.append(wanted if isinstance(wanted, str) else f"{wanted:g} s")
        states.append(int(np.argmin(np.abs(times - instant))))
    return names, states


def check_variants(cases: Mapping[str, Case]) -> None:
    """Check before any run that variants can share one dataset.

    Raises
    ------
    ValidationError
        If grids or periods differ, or a variant has no reference.
    """
    first_name, first = next(iter(cases.items()))
    for name, case in cases.items():
        if case.reference is None:
            raise ValidationError(f"variant {name!r} states no reference: there is nothing to compare with")
        for what, here, there in (
            ("solver.n_x", case.solver.n_x, first.solver.n_x),
            ("solver.n_phi", case.solver.n_phi, first.solver.n_phi),
            ("geometry.length", case.geometry.length, first.geometry.length),
            ("the inlet's period", case.inlet.period, first.inlet.period),
        ):
            if here != there:
                raise ValidationError(
                    f"variants {first_name!r} and {name!r} differ in {what} ({there} and {here}); "
                    "variants compared in one report share it"
                )


def combine(file: CaseFile, runs: Mapping[str, VariantRun]) -> xr.Dataset:
    """One dataset on (variant, time, x, phi, y): ``rom_<field>``, ``reference_<field>``, wall.

    Raises
    ------
    ValidationError
        If the references' states lie at different instants of the cycle.
    """
    first = next(iter(runs.values()))
    times = first.reference.alignment.cycle_times
    for name, run in runs.items():
        other = run.reference.alignment.cycle_times
        slack = TIME_TOLERANCE * run.case.inlet.period
        if other.shape != times.shape or np.max(np.abs(other - times)) > slack:
            raise ValidationError(
                f"the reference of variant {name!r} has states at other instants of the cycle than that of "
                f"{next(iter(runs))!r}; compare it in a case file of its own"
            )
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
    names, states = compare_times(case, times)
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
        "compare_time_names": json.dumps(names),
        "compare_times_s": times[states],
        "case_yaml": file.text,
    }
    return dataset
