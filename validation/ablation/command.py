"""``python -m validation.ablation CASE.yaml``: what each part of the coupled model buys against 3D.

Every variant is run with each model between the thesis's and the coupled one, and compared with the same 3D
run. In a directory that holds a finished comparison its reports get the table too.
"""

import argparse
from collections.abc import Sequence
from pathlib import Path

from cases.shell.command import COMPLETE, concluded
from cases.shell.interrupts import imports

PAGE_WIDTH = 160


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Return what the command line states."""
    parser = argparse.ArgumentParser(
        description="Run each model between the thesis's and the coupled one against the same 3D runs.",
    )
    parser.add_argument("case", type=Path, metavar="CASE.yaml", help="case file")
    parser.add_argument(
        "--output",
        type=Path,
        metavar="DIR",
        help="folder (default: results/NAME-ablation); the report of a comparison there gets the table",
    )
    parser.add_argument(
        "--sectors", type=Path, metavar="CSV", help="the thesis's table 3.8, for local calcifications"
    )
    return parser.parse_args(argv)


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status: 0, 2 for a wrong input, 130 interrupted."""
    chosen = arguments(argv)
    return concluded(lambda: _run(chosen), "interrupted; no result was written")


def _run(chosen: argparse.Namespace) -> int:
    with imports():
        from cases.reading.case_file import load_case_file
        from cases.shell.terminal import page
        from validation.ablation.study import ablation_rows, printed, write_rows
        from validation.runs.variants import watching

    file = load_case_file(chosen.case)
    directory = chosen.output or Path("results") / f"{file.name}-ablation"
    with watching() as watch:
        rows = list(ablation_rows(file, chosen.sectors, watch))
    write_rows(directory, rows)
    console = page(PAGE_WIDTH)
    console.print(printed(rows))
    console.print(f"{directory / 'ablation.csv'}")
    return COMPLETE
