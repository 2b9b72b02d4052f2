"""Fit numbers of a case by least squares, and say how well they are determined."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from cases.arrays import Floats
from cases.errors import CaseError
from cases.fields import FIELDS
from cases.reading.calibration_file import Calibration, Parameter, changed_values
from cases.reading.template import case_with
from cases.sections.case import Case
from solver.errors import SolverError
from solver.runs.batch import run_batch
from validation.calibrate.targets import Observed
from validation.calibrate.time_step import StepOfRuns
from validation.errors import ValidationError
from validation.runs.time_step import at_step

DIFFERENCE = 1e-3  # of a parameter's range: half the interval of the central differences
SMALL_CHANGE = 1e-2  # of a value, for a difference that limits decades apart do not widen
MOST_EVALUATIONS = 60
TOLERANCE = 1e-8
AT_LIMIT = 1e-5  # share of its range, and of its value, within which a parameter lies on its limit
REACHED = 1e-3  # of a target's value: farther off, it is not attained
DETERMINED = 1e-4  # of the largest singular value: a direction below it is not seen by the targets


@dataclass(frozen=True)
class Fit:
    """What was found.

    Attributes
    ----------
    values : ndarray (n,)
        Of the parameters, SI.
    standard_errors : ndarray (n,) or None
        SI: from the stated uncertainties, else from the differences that remain; None where there are as many
        parameters as targets and no uncertainty is stated.
    correlation : ndarray (n, n)
        Of the parameters' errors.
    condition : float
        Largest over least singular value of the Jacobian, parameters over their ranges.
    attained : ndarray (m,)
        What the fitted case attains, SI.
    runs, failed : int
        Of the reduced model: in all, and those that failed on the way.
    step : StepOfRuns or None
        Their time step, where it was chosen.
    """

    values: Floats
    standard_errors: Floats | None
    correlation: Floats
    condition: float
    attained: Floats
    runs: int
    failed: int
    step: StepOfRuns | None = None


class _Runs:
    """Runs of a case at points of the unit cube: each is run once."""

    def __init__(
        self,
        calibration: Calibration,
        wanted: Observed,
        watched: Callable[[int], None],
        step: StepOfRuns | None,
    ) -> None:
        self.calibration, self.wanted, self.watched = calibration, wanted, watched
        self.step = step
        self.low = np.array([parameter.low for parameter in calibration.parameters])
        self.width = np.array([parameter.high for parameter in calibration.parameters]) - self.low
        self.known: dict[bytes, Floats] = {}
        self.errors: dict[bytes, CaseError | SolverError] = {}

    def values(self, point: Floats) -> Floats:
        return np.asarray(self.low + point * self.width)

    def _case(self, point: Floats) -> Case | None:
        keys = [parameter.key for parameter in self.calibration.parameters]
        try:
            case = case_with(self.calibration.template, changed_values(keys, self.values(point)))
        except CaseError as error:
            self.errors[point.tobytes()] = error
            return None
        return case if self.step is None else at_step(case, self.step.choice.time_step)

    def attained(self, points: Sequence[Floats]) -> list[Floats]:
        """Return what the case attains at points, NaN where it fails; new points are run side by side."""
        new = {point.tobytes(): point for point in points if point.tobytes() not in self.known}
        cases = {name: self._case(point) for name, point in new.items()}
        able = {name: case for name, case in cases.items() if case is not None}
        outcomes = run_batch(list(able.values()), self.wanted.times, self.wanted.measure)
        self.known |= dict.fromkeys(new, np.full(self.wanted.values.size, np.nan))
        for name, outcome in zip(able, outcomes, strict=True):
            if outcome.kept is not None:
                self.known[name] = outcome.kept
            elif outcome.error is not None:
                self.errors[name] = outcome.error
        self.watched(len(self.known))
        return [self.known[point.tobytes()] for point in points]

    def error(self, point: Floats) -> CaseError | SolverError | None:
        """Return why a run failed."""
        return self.errors.get(point.tobytes())

    def residuals(self, point: Floats) -> Floats:
        (attained,) = self.attained([point])
        return np.asarray((attained - self.wanted.values) / self.wanted.scales)

    def jacobian(self, point: Floats) -> Floats:
        """Differences over ± a thousandth of each range, a hundredth of the value where that is less.

        One-sided at the ends of a range and where a run fails.
        """
        near = SMALL_CHANGE * np.abs(self.values(point)) / self.width
        steps = np.where(near > 0, np.minimum(DIFFERENCE, near), DIFFERENCE)
        below, above = (
            [np.clip(point + sign * step, 0.0, 1.0) for step in np.diag(steps)] for sign in (-1.0, 1.0)
        )
        at, *beside = self.attained([point, *below, *above])
        columns = []
        for n in range(point.size):
            low, high = beside[n], beside[point.size + n]
            begin, end = below[n][n], above[n][n]
            if not np.all(np.isfinite(low)):
                low, begin = at, point[n]
            if not np.all(np.isfinite(high)):
                high, end = at, point[n]
            columns.append((high - low) / self.wanted.scales / (end - begin) if end > begin else at * np.nan)
        jacobian = np.stack(columns, axis=1)
        if not np.all(np.isfinite(jacobian)):
            tried = (point, *below, *above)
            failing = next((each for each in tried if self.error(each) is not None), point)
            raise ValidationError(
                f"{self.calibration.path}: at {self._where(failing)}: {self.error(failing)}"
            )
        return jacobian

    def _where(self, point: Floats) -> str:
        stated = zip(self.calibration.parameters, self.values(point), strict=True)
        return ", ".join(f"{parameter.key.name} {value:.6g}" for parameter, value in stated)


def fit(
    calibration: Calibration,
    wanted: Observed,
    watched: Callable[[int], None],
    step: StepOfRuns | None = None,
) -> Fit:
    """Fit the parameters of a calibration by least squares: Gauss–Newton steps within their limits.

    Parameters
    ----------
    calibration : Calibration
    wanted : Observed
        From :func:`validation.calibrate.targets.observed`.
    watched : callable
        Called with the number of runs so far.
    step : StepOfRuns, optional
        Time step of all runs; default: the case's own.

    Raises
    ------
    ValidationError
        If the first run fails, the targets do not determine the parameters or cannot be attained, or a
        parameter ends on its limit; the message says how far off the targets are.
    """
    count = wanted.values.size
    if count < len(calibration.parameters):
        raise ValidationError(
            f"{calibration.path}: {count} values for {len(calibration.parameters)} parameters; allowed: as "
            "many as parameters, or more"
        )
    runs = _Runs(calibration, wanted, watched, step)
    start = np.array([parameter.start for parameter in calibration.parameters])
    begin = (start - runs.low) / runs.width
    if not np.all(np.isfinite(runs.residuals(begin))):
        raise ValidationError(
            f"{calibration.path}: the run from which the search begins: {runs.error(begin)}"
        )
    _require_determined(calibration, runs.jacobian(np.clip(begin, AT_LIMIT, 1 - AT_LIMIT)))
    found = least_squares(  # runs that fail count as steps too long
        runs.residuals,
        begin,
        jac=runs.jacobian,
        method="dogbox",
        bounds=(0.0, 1.0),
        xtol=TOLERANCE,
        ftol=TOLERANCE,
        gtol=TOLERANCE,
        max_nfev=MOST_EVALUATIONS,
    )
    attained = found.fun * wanted.scales + wanted.values
    _require_inside(calibration, wanted, found.x, attained)
    if found.status == 0:
        raise ValidationError(
            f"{calibration.path}: no end after {MOST_EVALUATIONS} evaluations; {misses(wanted, attained)}"
        )
    _require_attained(calibration, wanted, attained)
    singular, directions = _require_determined(calibration, np.asarray(found.jac))
    covariance = (directions.T / singular**2) @ directions
    spread = np.sqrt(np.diag(covariance))
    surplus = count - start.size
    scale = 1.0 if wanted.uncertain else float(np.sqrt(2 * found.cost / surplus)) if surplus else None
    return Fit(
        values=runs.values(found.x),
        standard_errors=None if scale is None else scale * spread * runs.width,
        correlation=covariance / np.outer(spread, spread),
        condition=float(singular[0] / singular[-1]),
        attained=attained,
        runs=len(runs.known),
        failed=sum(not np.all(np.isfinite(attained)) for attained in runs.known.values()),
        step=step,
    )


def _require_determined(calibration: Calibration, jacobian: Floats) -> tuple[Floats, Floats]:
    """Singular values, and directions in the space of the parameters as rows."""
    _, singular, directions = np.linalg.svd(jacobian, full_matrices=False)
    names = [parameter.key.name for parameter in calibration.parameters]
    still = [name for name, column in zip(names, jacobian.T, strict=True) if not np.any(column)]
    if still:
        raise ValidationError(f"{calibration.path}: no target depends on {', '.join(still)}")
    if singular[-1] < DETERMINED * singular[0]:
        weak = [name for name, part in zip(names, directions[-1], strict=True) if abs(part) > 0.1]
        what = f"tell {' and '.join(weak)} apart" if len(weak) > 1 else f"determine {weak[0]}"
        raise ValidationError(
            f"{calibration.path}: the targets do not {what} (singular values from {singular[0]:.2g} to "
            f"{singular[-1]:.2g})"
        )
    return singular, directions


def _require_inside(calibration: Calibration, wanted: Observed, point: Floats, attained: Floats) -> None:
    for parameter, share in zip(calibration.parameters, point, strict=True):
        end = "low" if share < 0.5 else "high"
        limit, value = _limit(parameter, end), parameter.low + share * (parameter.high - parameter.low)
        if abs(value - limit) <= AT_LIMIT * min(abs(value) or np.inf, parameter.high - parameter.low):
            raise ValidationError(
                f"{calibration.path}: parameters.{parameter.key.name}: ends on its limit {end} "
                f"({_limit(parameter, end):g}); {misses(wanted, attained)}"
            )


def _limit(parameter: Parameter, end: str) -> float:
    return parameter.low if end == "low" else parameter.high


def _require_attained(calibration: Calibration, wanted: Observed, attained: Floats) -> None:
    """Refuse a fit that misses targets which are no more than the parameters."""
    off = np.abs(attained - wanted.values) / wanted.scales
    allowed = 1.0 if wanted.uncertain else REACHED
    if off.size == len(calibration.parameters) and np.max(off) > allowed:
        told = misses(wanted, attained)
        raise ValidationError(f"{calibration.path}: the targets cannot be attained; {told}")


def misses(wanted: Observed, attained: Floats) -> str:
    """Tell how far off each target is; of many, how far they are on the whole."""
    quantity = FIELDS[wanted.quantities[0]]
    difference = attained - wanted.values
    if len(set(wanted.names)) < len(wanted.names):
        factor, unit = quantity.display_factor, quantity.display_unit
        rms, worst = np.sqrt(np.mean(difference**2)) * factor, np.max(np.abs(difference)) * factor
        return f"{wanted.names[0]}: {rms:.4g} {unit} off (root mean square), {worst:.4g} {unit} at worst"
    parts = []
    for name, each, value, found in zip(
        wanted.names, wanted.quantities, wanted.values, attained, strict=True
    ):
        factor, unit = FIELDS[each].display_factor, FIELDS[each].display_unit
        share = f"{100 * (found / value - 1):+.2g} %"
        parts.append(f"{name}: {found * factor:.5g} {unit} instead of {value * factor:.5g} {unit} ({share})")
    return "; ".join(parts)
