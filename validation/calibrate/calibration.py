"""One calibration from its file to the fit."""

from cases.reading.calibration_file import Calibration
from validation.calibrate.fit import Fit, fit
from validation.calibrate.targets import Observed, observed
from validation.calibrate.time_step import step_of_runs
from validation.runs.cache import open_cache
from validation.runs.variants import watching


def calibrated(calibration: Calibration, fresh: bool = False) -> tuple[Observed, Fit]:
    """Run a calibration; progress is shown on a terminal.

    Raises
    ------
    ValidationError, FebioError, SolverError
        As :func:`validation.calibrate.fit.fit` and the reference's reader raise them.
    """
    with watching(open_cache(fresh)) as watch:
        wanted = observed(calibration, watch, watch.cache)
        task = watch.display.add_task("least squares", total=None)
        step = step_of_runs(calibration, wanted)

        def watched(runs: int) -> None:
            watch.display.update(task, description=f"{runs} runs")

        found = fit(calibration, wanted, watched, step)
    return wanted, found
