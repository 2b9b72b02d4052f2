"""``python -m validation.calibrate CALIBRATION.yaml``: fit numbers of a case to pressures or to a 3D run."""

import argparse
import shlex
import sys
from collections.abc import Sequence
from pathlib import Path

from cases.shell.command import COMPLETE, concluded
from cases.shell.interrupts import imports
from validation.errors import ValidationError

PAGE_WIDTH = 130  # columns of the tables where there is no terminal


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


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status: 0 fitted, 2 for a wrong input or targets that cannot be attained, 130 interrupted."""
    stated = sys.argv[1:] if argv is None else list(argv)
    chosen = arguments(stated)
    command = ["python", "-m", "validation.calibrate", *map(shlex.quote, stated)]
    return concluded(lambda: _run(chosen, command), "interrupted; no result was written")


def _run(chosen: argparse.Namespace, command: list[str]) -> int:
    with imports():
        from cases.reading.calibration_file import load_calibration
        from cases.shell.terminal import page
        from validation.calibrate.calibration import calibrated
        from validation.calibrate.fitted_case import check_case, write_case
        from validation.calibrate.output import KEYS, RECORD, check_results, write_results
        from validation.calibrate.presentation import MOST_ROWS, parameter_table, remarks, target_table

    calibration = load_calibration(chosen.calibration)
    folder = chosen.output or Path("results") / calibration.name
    check_results(folder, calibration)
    if chosen.case is not None:
        check_case(chosen.case, calibration)
        if chosen.case.resolve() in ((folder / name).resolve() for name in (RECORD, KEYS)):
            raise ValidationError(f"{chosen.case}: is a file of the result; choose another --case")
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
