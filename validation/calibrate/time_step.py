"""The time step of a calibration's runs: the longest that keeps every target at some points of its ranges."""

from dataclasses import dataclass

import numpy as np
from scipy.stats import qmc

from cases.arrays import Floats
from cases.errors import CaseError
from cases.reading.calibration_file import Calibration, changed_values
from cases.reading.template import case_with
from cases.sections.case import Case
from solver.runs.batch import run_batch
from validation.calibrate.targets import Observed
from validation.runs.time_step import Choice, at_step, choice_told, chosen, takes_equal_steps

BESIDE = 3  # points besides that from which the search begins: more would cost what they save


@dataclass(frozen=True)
class StepOfRuns:
    """The time step of all runs, s, that of the case, and how many runs the choice rests on."""

    choice: Choice
    own: float
    runs: int


def step_of_runs(calibration: Calibration, wanted: Observed) -> StepOfRuns | None:
    """Choose the time step; None where the calibration or the scheme does not let it be chosen."""
    case, limit = calibration.case, calibration.error_tolerance
    if limit is None or not takes_equal_steps(case):
        return None
    some = _some(calibration)
    own, period = case.solver.time_step, case.inlet.period

    def numbers(step: float) -> Floats:
        outcomes = run_batch([at_step(each, step) for each in some], wanted.times, wanted.measure)
        nothing = np.full(wanted.values.size, np.nan)
        return np.array([nothing if each.kept is None else each.kept for each in outcomes])

    sizes = np.abs(wanted.values)
    if calibration.reference is not None:  # instants of one curve, which may go through zero
        sizes = np.full(sizes.size, sizes.max())
    begins = (case.solver.cycles - 1) * period
    choice = chosen(own, wanted.times, begins, numbers, lambda _: sizes, limit)
    return StepOfRuns(choice, own, len(some))


def _some(calibration: Calibration) -> list[Case]:
    """Cases from which the search begins and of points between the limits, as far as they are allowed."""
    limits = [(each.low, each.high) for each in calibration.parameters]
    shares = qmc.LatinHypercube(len(limits), rng=0).random(BESIDE)
    points = [[each.start for each in calibration.parameters], *qmc.scale(shares, *np.transpose(limits))]
    keys = [each.key for each in calibration.parameters]
    found = []
    for point in points:
        try:
            found.append(case_with(calibration.template, changed_values(keys, point)))
        except CaseError:  # the search itself goes around such points
            continue
    return found or [calibration.case]


def words(step: StepOfRuns, wanted: Observed, limit: float) -> str:
    """Say which step was chosen, and by what error."""
    choice = step.choice
    error = choice.error, wanted.names[choice.worst]
    return choice_told(choice.time_step, step.own, error, f"{step.runs} runs", limit)
