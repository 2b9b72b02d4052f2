"""The time step of each variant's samples: the longest that keeps every output of some of them."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from cases.arrays import Floats
from cases.results.sweep import ChosenTimeStep
from cases.sections.case import Case
from validation.runs.reduced_model import run_times
from validation.runs.time_step import SAMPLE, at_step, choice_told, chosen, takes_equal_steps
from validation.sweep.chunk import Plan, Record
from validation.sweep.outputs import SIZES, Output
from validation.sweep.samples import Sample, Samples
from validation.sweep.standards import instants_of

ONE_OF = 8  # samples of which one is judged, so that judging costs less than it saves
SMALL = 0.01  # of a field's size: an output below it, a small difference, is measured by that
TIME_STEP = "solver.time_step"

RunAll = Callable[[list[Sample], Plan], list[Record]]


def chosen_steps(samples: Samples, plan: Plan, run: RunAll) -> dict[str, ChosenTimeStep]:
    """Choose the time step of each variant that takes equal steps, unless the study itself varies it.

    Parameters
    ----------
    samples : Samples
        Of a study with a tolerance.
    plan : Plan
        What is wanted of each sample.
    run : callable
        Runs samples, and returns their records in their order.
    """
    study = samples.study
    if study.error_tolerance is None or TIME_STEP in plan.parameters:
        return {}
    able = [name for name, case in study.cases.items() if takes_equal_steps(case)]
    judges = {name: some for name in able if (some := _some(samples, name))}
    return {
        name: _chosen(study.cases[name], some, plan, run, study.error_tolerance)
        for name, some in judges.items()
    }


def _chosen(base: Case, some: Sequence[Sample], plan: Plan, run: RunAll, limit: float) -> ChosenTimeStep:
    wider = replace(plan, outputs=(*plan.outputs, *(size for size, _ in SIZES.values())))

    def numbers(step: float) -> Floats:
        taken = [replace(each, case=at_step(each.case, step)) for each in some if each.case is not None]
        names = [output.name for output in wider.outputs]
        records = run(taken, wider)
        return np.array([[record[name] for name in names] for record in records], dtype=float)

    own = base.solver.time_step
    times = run_times(base, instants_of(plan.standards[some[0].variant], base))
    begins = (base.solver.cycles - 1) * base.inlet.period
    found = chosen(own, times, begins, numbers, lambda values: _scales(values, wider.outputs), limit)
    return ChosenTimeStep(
        time_step_s=found.time_step,
        case_time_step_s=own,
        error=found.error if np.isfinite(found.error) else None,
        output=wider.outputs[found.worst].name,
        samples=len(some),
    )


def _some(samples: Samples, variant: str) -> list[Sample]:
    """Samples of a variant that may be run, from all over the design."""
    count = len(samples.points)
    first = list(samples.study.templates).index(variant) * count
    number = min(SAMPLE, -(-count // ONE_OF))
    places = np.unique(np.linspace(0, count - 1, number).astype(int)) if number > 1 else [count // 2]
    return [sample for place in places if (sample := samples[first + int(place)]).case is not None]


def _scales(values: Floats, outputs: tuple[Output, ...]) -> Floats:
    """Largest size of each output, at least a hundredth of that of its field; endless for the fields' own."""
    largest = np.nan_to_num(np.abs(values), nan=0.0).max(axis=0)
    by_name = dict(zip((output.name for output in outputs), largest, strict=True))
    sizes = {unit: by_name[size.name] for unit, (size, _) in SIZES.items()} | {"1": 1.0}
    least = [SMALL * sizes.get(output.unit, 0.0) for output in outputs]
    least[-len(SIZES) :] = [np.finfo(float).max] * len(SIZES)
    return np.asarray(np.maximum(np.maximum(largest, least), np.finfo(float).tiny))


def told(choices: Mapping[str, ChosenTimeStep], limit: float | None) -> list[str]:
    """Say which steps were chosen; nothing without a tolerance."""
    if limit is None:
        return []
    return [f"{name}: {words(choice, limit)}" for name, choice in choices.items()]


def words(choice: ChosenTimeStep, limit: float) -> str:
    """Say which step was chosen, and by what error."""
    error = np.inf if choice.error is None else choice.error
    steps = choice.time_step_s, choice.case_time_step_s
    return choice_told(*steps, (error, choice.output), f"{choice.samples} samples", limit)
