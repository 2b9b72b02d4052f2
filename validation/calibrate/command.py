"""``python -m validation.calibrate CALIBRATION.yaml``: fit numbers of a case to pressures or to a 3D run."""

import argparse
import shlex
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from rich.table import Table

from cases.fields import FIELDS
from cases.reading.calibration_file import Calibration, load_calibration
from cases.shell.command import COMPLETE, concluded
from cases.shell.terminal import page
from validation.calibrate.fit import Fit, fit, misses
from validation.calibrate.fitted_case import check_case, write_case
from validation.calibrate.output import KEYS, RECORD, check_results, parameter_records, write_results
from validation.calibrate.targets import Observed, observed
from validation.errors import ValidationError
from validation.runs.cache import open_cache
from validation.runs.variants import watching

PAGE_WIDTH = 130  # columns of the tables where there is no terminal
MOST_ROWS = 20  # of the table of targets


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
        found = fit(calibration, wanted, lambda runs: watch.display.update(task, description=f"{runs} runs"))
    return wanted, found


def parameter_table(calibration: Calibration, found: Fit) -> Table:
    """Parameters for the terminal, SI."""
    table = Table("parameter", "value", "standard error", "the case states", "unit")
    for record in parameter_records(calibration, found):
        error, stated = record["standard_error"], record["case_states"]
        table.add_row(
            record["key"],
            f"{record['value']:.6g}",
            "–" if error is None else f"{error:.2g} ({100 * abs(error / record['value']):.2g} %)",
            "–" if stated is None else f"{stated:.6g}",
            record["unit"],
        )
    return table


def target_table(wanted: Observed, found: Fit) -> Table:
    """Targets for the terminal, in the units people read."""
    table = Table("target", "value", "attained", "difference", "unit")
    rows = zip(wanted.names, wanted.quantities, wanted.values, found.attained, strict=True)
    for name, quantity, value, attained in rows:
        field = FIELDS[quantity]
        factor = field.display_factor
        share = f"{100 * (attained / value - 1):+.2g} %"
        table.add_row(name, f"{value * factor:.6g}", f"{attained * factor:.6g}", share, field.display_unit)
    return table


def remarks(calibration: Calibration, wanted: Observed, found: Fit) -> list[str]:
    """Sentences that say how sure the numbers are."""
    names = [parameter.key.name for parameter in calibration.parameters]
    told = [f"{found.runs} runs" + (f", {found.failed} of which failed on the way" if found.failed else "")]
    told += [
        f"errors of {names[a]} and {names[b]} are correlated: {found.correlation[a, b]:+.2f}"
        for a, b in zip(*np.triu_indices(len(names), 1), strict=True)
    ]
    if found.standard_errors is None:
        told.append(
            "as many targets as parameters: no standard errors; state each target's uncertainty for them"
        )
    if len(wanted.names) > MOST_ROWS:
        told.append(misses(wanted, found.attained))
    return told


def arguments(argv: Sequence[str]) -> argparse.Namespace:
    """Return what the command line states."""
    parser = argparse.ArgumentParser(
        description="Fit numbers of a case by least squares to pressures or radii of the last cycle, or to a "
        "3D reference.",
        epilog="Exit status: 0 fitted; 2 wrong input, or targets that cannot be attained or do not "
        "determine the parameters.",
    )
    parser.add_argument("calibration", type=Path, metavar="CALIBRATION.yaml")
    parser.add_argument(
        "--output", type=Path, metavar="DIR", help="folder for results (default: results/NAME)"
    )
    parser.add_argument(
        "--case",
        type=Path,
        metavar="FILE.yaml",
        help="write the case file with the fitted values too; files that it names are looked for from there",
    )
    parser.add_argument(
        "--fresh", action="store_true", help="read the reference anew, whatever the cache has"
    )
    return parser.parse_args(argv)


def _refuse_a_result(case: Path, folder: Path) -> None:
    if case.resolve() in ((folder / name).resolve() for name in (RECORD, KEYS)):
        raise ValidationError(f"{case}: is a file of the result; choose another --case")


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status: 0 fitted, 2 for a wrong input or targets that cannot be attained, 130 interrupted."""
    stated = sys.argv[1:] if argv is None else list(argv)
    chosen = arguments(stated)
    command = ["python", "-m", "validation.calibrate", *map(shlex.quote, stated)]
    return concluded(lambda: _run(chosen, command), "interrupted; no result was written")


def _run(chosen: argparse.Namespace, command: list[str]) -> int:
    calibration = load_calibration(chosen.calibration)
    folder = chosen.output or Path("results") / calibration.name
    check_results(folder, calibration)
    if chosen.case is not None:
        check_case(chosen.case, calibration)
        _refuse_a_result(chosen.case, folder)
    wanted, found = calibrated(calibration, chosen.fresh)
    write_results(folder, calibration, wanted, found, command)
    if chosen.case is not None:  # last, so that the numbers are kept whatever has become of its folder
        write_case(chosen.case, calibration, found.values)
    output = page(PAGE_WIDTH)
    output.print(parameter_table(calibration, found))
    if len(wanted.names) <= MOST_ROWS:
        output.print(target_table(wanted, found))
    for line in remarks(calibration, wanted, found):
        output.print(line, highlight=False)
    written = f"{folder / RECORD}, {folder / KEYS}"
    output.print(f"results: {written}" + (f", {chosen.case}" if chosen.case else ""), soft_wrap=True)
    return COMPLETE
