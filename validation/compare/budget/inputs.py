"""What the uncertainty of a case's inputs leaves open of the reduced model's results."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from cases.arrays import Floats
from cases.errors import CaseFileError
from cases.fields import FIELDS
from cases.quantities import reads
from cases.reading.template import Template, case_with
from cases.reading.uncertain_numbers import UncertainNumber, uncertain_numbers
from cases.sections.case import Case
from cases.sections.inlet import ReferenceInlet
from cases.sections.uncertainty import Uncertainty
from solver.model.parameters import Model
from solver.runs.batch import run_batch
from solver.runs.result import CellHistory, cell_dataset
from validation.compare.budget.spread import RunningSpread, relative_spread
from validation.converge.refinement import levels
from validation.metrics.quantities import CYCLE_QUANTITIES, DERIVED_QUANTITIES
from validation.runs.cache import Cache
from validation.runs.cached import Numbers, Remark, cached_numbers
from validation.runs.keys import canonical, key_of
from validation.runs.reduced_model import run_times
from validation.sweep.design import Design, points
from validation.sweep.display import Display
from validation.sweep.parameters import Parameter

AT_ONCE = 8  # results in memory
STEPS = 4.0  # steps of the case in one of a sample: a spread needs no more digits,
FEWEST = 40  # nor more cells along x than half of the case's, if they are no fewer than this
MOST_FAILED = 0.1  # share of the samples; above it there is no number
STEP = 0.1  # of a standard deviation: half the interval of the central differences
Values = dict[str, Floats]


def input_uncertainty(
    template: Callable[[], Template],
    case: Case,
    instants: Floats,
    quantities: Sequence[str],
    store: Cache | None = None,
    remark: Remark = lambda _said: None,
) -> Mapping[str, float]:
    """Relative standard uncertainty of 2D results by that of the inputs: u_input of ASME V&V 20-2009.

    Parameters
    ----------
    template : callable
        Gives that of the variant, see :func:`cases.reading.template.load_template`; asked where samples run.
    case : Case
        The same variant; its ``uncertainty`` says what is uncertain.
    instants : ndarray (n,)
        Of the reference in the last cycle of a run, s (``Alignment.rom_times``).
    quantities : sequence of str
        Names of `cases.fields.FIELDS` that are compared; those on rays have no number.
    store : Cache, optional
    remark : callable, optional
        Takes in words what was left out and what failed.

    Returns
    -------
    mapping of str to float
        Of a field the root mean square over all cells and instants of the standard deviation over the mean,
        of a number of the cycle its standard deviation over its mean; nothing where there is no number.
    """
    stated = case.uncertainty
    if stated is None:
        return {}
    numbers, lacking = uncertain_numbers(case)
    if lacking:
        remark(f"uncertainty: has no {', '.join(lacking)}: left out")
    wanted = [name for name in dict.fromkeys(quantities) if "y" not in FIELDS[name].dims]
    if not numbers or not wanted:
        return {}
    parts = {
        "case": {
            name: getattr(case, name)
            for name in type(case).model_fields
            if name not in ("title", "reference", "compare")
        },
        "instants": instants,
        "quantities": wanted,
    }
    found = cached_numbers(
        store,
        lambda: key_of("input uncertainty", canonical(parts)),
        lambda: _computed(_Runs(template(), case, instants, wanted), stated, list(numbers.values())),
        remark,
    )
    said = found.description["said"]
    if said:
        remark(f"uncertainty: {said}")
    return found.values


@dataclass(frozen=True)
class _Runs:
    """Runs of a case with other values of its uncertain numbers."""

    template: Template
    case: Case
    instants: Floats
    quantities: Sequence[str]

    def results(self, numbers: Sequence[UncertainNumber], values: Floats) -> Iterator[Values | None]:
        """Quantities of each sample, in order; None where its values are not allowed or its run fails.

        Parameters
        ----------
        numbers : sequence of UncertainNumber
        values : ndarray (n, n_numbers)
            SI.
        """
        for first in range(0, len(values), AT_ONCE):
            made = [self._case(numbers, each) for each in values[first : first + AT_ONCE].tolist()]
            cases = [_coarser(case) for case in made if case is not None]
            times = run_times(self.case, self.instants)
            outcomes = iter(run_batch(cases, times, self._kept) if cases else ())
            yield from [None if case is None else next(outcomes).kept for case in made]

    def _case(self, numbers: Sequence[UncertainNumber], values: Sequence[float]) -> Case | None:
        stated = {each.key.path: each.key.stated(value) for each, value in zip(numbers, values, strict=True)}
        try:
            made = case_with(self.template, stated)
        except CaseFileError:
            return None
        if isinstance(made.inlet, ReferenceInlet):  # what it took in is known of the case alone
            return made.model_copy(update={"inlet": self.case.inlet})
        return made

    def _kept(self, model: Model, cells: CellHistory) -> Values:
        last = cell_dataset(model, cells).sel(time=self.instants)
        known = [name for name in self.quantities if all(field in last for field in reads(name))]
        return {name: _quantity(name, last) for name in known}


def _coarser(case: Case) -> Case:
    """Return a case with a larger time step and on half its grid, where scheme and grid allow that."""
    stated = case.solver
    if stated.scheme != "semi_implicit":
        return case
    if stated.n_x % 2 == 0 and stated.n_x >= 2 * FEWEST and stated.n_phi % 2 == 0:
        case = levels(case, "grid")[0]
    solver = case.solver.model_copy(update={"time_step": STEPS * stated.time_step})
    return case.model_copy(update={"solver": solver})


def _quantity(name: str, last: xr.Dataset) -> Floats:
    measure: Callable[[xr.Dataset], Any] | None = CYCLE_QUANTITIES.get(name) or DERIVED_QUANTITIES.get(name)
    return np.asarray(last[reads(name)[0]].to_numpy() if measure is None else measure(last), dtype=float)


def _computed(runs: _Runs, stated: Uncertainty, numbers: Sequence[UncertainNumber]) -> Numbers:
    if stated.method == "local":
        return _local(runs, numbers)
    return _sampled(runs, stated, numbers)


def _sampled(runs: _Runs, stated: Uncertainty, numbers: Sequence[UncertainNumber]) -> Numbers:
    """Spread of the results of a Latin hypercube; McKay et al. (1979), Technometrics 21, 239–245."""
    design = Design(kind="latin_hypercube", count=stated.samples, seed=stated.seed)
    values = points(design, [_parameter(each) for each in numbers])
    spread, failed = RunningSpread(), 0
    for result in runs.results(numbers, values):
        if result is None:
            failed += 1
        else:
            spread.add(result)
    said = f"{failed} of {stated.samples} samples failed" if failed else ""
    if spread.count < 2 or failed > MOST_FAILED * stated.samples:
        return _told({}, stated.samples, failed, f"{said}: no number")
    return _told(relative_spread(spread.mean, spread.variance), stated.samples, failed, said)


def _parameter(number: UncertainNumber) -> Parameter:
    kind = "normal" if "mean" in number.numbers else "uniform"
    return Parameter(number.key, number.key.name, Display(number.key.kind.unit, 1.0), kind, number.numbers)


def _local(runs: _Runs, numbers: Sequence[UncertainNumber]) -> Numbers:
    """Σ (∂f/∂p σ_p)² by central differences, about the result of the case itself."""
    base = np.array([each.key.value or 0.0 for each in numbers])
    steps = STEP * np.diag([each.standard_deviation for each in numbers])
    values = np.stack([base, *(base + sign * step for step in steps for sign in (1, -1))])
    results = runs.results(numbers, values)
    mean, failed = next(results), 0
    variance: Values = {}
    for above, below in zip(results, results, strict=True):
        if above is None or below is None:
            failed += 1
            continue
        for name in above:
            change = (above[name] - below[name]) / (2 * STEP)
            variance[name] = variance.get(name, np.zeros(change.shape)) + change**2
    if failed or mean is None:
        said = f"{failed} of {len(numbers)} central differences failed: no number"
        return _told({}, len(values), failed, said)
    return _told(relative_spread(mean, variance), len(values), 0, "")


def _told(relative: dict[str, float], runs: int, failed: int, said: str) -> Numbers:
    return Numbers(relative, {"runs": runs, "failed": failed, "said": said})
