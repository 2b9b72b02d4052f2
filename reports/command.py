"""Draw the reports of finished comparisons, or the page of a sweep, again: python -m reports DIR [DIR …]."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from cases.shell.command import COMPLETE, concluded
from cases.shell.interrupts import imports
from reports.errors import ReportError


def _written(directories: list[Path]) -> tuple[Path, ...]:
    with imports():
        from reports.build import write_gallery, write_reports
        from reports.sweep import is_sweep, write_sweep_page

    if len(directories) > 1:
        return (write_gallery(directories),)
    (directory,) = directories
    return write_sweep_page(directory) if is_sweep(directory) else write_reports(directory)


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Return what the command line states."""
    parser = argparse.ArgumentParser(
        description=__doc__,
        epilog="With several directories, gallery.html in the folder that holds them leads to all reports.",
    )
    parser.add_argument(
        "directories",
        metavar="DIR",
        type=Path,
        nargs="+",
        help="what `python -m validation.compare` or `python -m validation.sweep` left",
    )
    return parser.parse_args(argv)


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status: 0, 2 where a directory holds no finished comparison, 130 interrupted."""
    directories: list[Path] = list(dict.fromkeys(arguments(argv).directories))
    return concluded(lambda: _run(directories), "reports: interrupted", prefix="reports: ")


def _run(directories: list[Path]) -> int:
    try:
        written = _written(directories)
    except OSError as error:
        raise ReportError(str(error)) from error
    for path in written:
        print(path)
    return COMPLETE
