"""What a worker does: run some samples and return a record of each."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import xarray as xr

from cases.arrays import Floats
from cases.results.sweep import FAILED, OK
from cases.sections.case import Case
from solver.model.parameters import Model
from solver.runs.batch import run_batch
from solver.runs.result import CellHistory, cell_dataset
from validation.ablation.ladder import coupled_model
from validation.runs.reduced_model import change_of, run_times
from validation.runs.time_step import at_step
from validation.sweep.outputs import CYCLE_CHANGE, MEASURED, MEASURES, Output
from validation.sweep.samples import Sample
from validation.sweep.standards import Standard, instants_of, judged_values

THREADS = 1  # of one task: a cluster runs as many tasks at once as it has processors
Record = dict[str, Any]


@dataclass(frozen=True)
class Plan:
    """What is wanted of every sample.

    Attributes
    ----------
    parameters : tuple of str
        Names of the parameters.
    outputs : tuple of Output
        What is kept.
    standards : dict of str to Standard
        What judges, by variant.
    steps : dict of str to float
        Time step, s, by variant, where it is not the case's own.
    """

    parameters: tuple[str, ...]
    outputs: tuple[Output, ...]
    standards: Mapping[str, Standard]
    steps: Mapping[str, float] = field(default_factory=dict)


def run_chunk(samples: Sequence[Sample], plan: Plan) -> list[Record]:
    """Run samples; return a record of each, in their order.

    A sample whose values are not allowed, or whose run fails, gives a record that says so. What fails with
    the plan's time step is run with the case's own.
    """
    return [_record_of(sample, plan) for sample in samples]


def failed(sample: Sample, plan: Plan, error: str, seconds: float = 0.0) -> Record:
    """Return the record of a sample that gave nothing."""
    return _stated(sample, plan, FAILED, error, seconds) | {output.name: None for output in plan.outputs}


def _record_of(sample: Sample, plan: Plan) -> Record:
    if sample.case is None:
        return failed(sample, plan, sample.error)
    own = sample.case.solver.time_step
    step = plan.steps.get(sample.variant, own)
    record = _run(sample, at_step(sample.case, step), plan)
    if record["status"] == OK or step == own:
        return record
    again = _run(sample, sample.case, plan)
    return again | {"seconds": record["seconds"] + again["seconds"]}


def _run(sample: Sample, case: Case, plan: Plan) -> Record:
    standard = plan.standards[sample.variant]
    cases = [case, *([coupled_model(case)] if standard.against == "coupled" else [])]
    instants = instants_of(standard, case)
    judged = any(output.bands for output in plan.outputs)
    needed = None if judged else MEASURED

    def last_cycle(model: Model, cells: CellHistory) -> xr.Dataset:
        whole = cell_dataset(model, cells, needed)
        change = change_of(cases[0], whole)
        return _at(whole, instants).assign_attrs({CYCLE_CHANGE: change})

    outcomes = run_batch(cases, run_times(case, instants), last_cycle, THREADS, every_row=judged)
    seconds = sum(outcome.cpu_s for outcome in outcomes)
    lasts: list[xr.Dataset] = []
    for words, outcome in zip(("", "the coupled model: "), outcomes, strict=False):
        if outcome.kept is None:
            return failed(sample, plan, f"{words}{outcome.error}", seconds)
        lasts.append(outcome.kept)
    values = _values(case, standard, lasts, plan.outputs)
    return _stated(sample, plan, OK, None, seconds) | values


def _at(whole: xr.Dataset, instants: Floats) -> xr.Dataset:
    """States at instants of a run; without copying them where they follow each other."""
    places = np.searchsorted(whole.variables["time"].to_numpy(), instants)
    if places.size == whole.sizes["time"]:
        return whole
    follow = np.array_equal(places, np.arange(places[0], places[0] + places.size))
    return whole.isel(time=slice(places[0], places[0] + places.size)) if follow else whole.sel(time=instants)


def _stated(sample: Sample, plan: Plan, status: str, error: str | None, seconds: float) -> Record:
    about = {"sample": sample.number, "variant": sample.variant, "status": status, "error": error}
    return about | {"seconds": seconds} | dict(zip(plan.parameters, sample.values, strict=True))


def _values(
    case: Case, standard: Standard, lasts: Sequence[xr.Dataset], outputs: Sequence[Output]
) -> dict[str, float | None]:
    """Return all outputs of a sample from its last cycle and that of the coupled model, where that judges."""
    own = {
        output.name: MEASURES[output.name](case, lasts[0]) for output in outputs if output.name in MEASURES
    }
    judged = [output for output in outputs if output.bands]
    other = lasts[1] if len(lasts) > 1 else None
    found = judged_values(standard, case, lasts[0], other, [output.bands[0] for output in judged])
    values = own | {output.name: value for output, value in zip(judged, found, strict=True)}
    return {output.name: _finite(values[output.name]) for output in outputs}


def _finite(value: float | None) -> float | None:
    """Return a number, or None for what has no meaning in a sample."""
    return None if value is None or not math.isfinite(value) else value
