"""``python -m validation.converge CASE.yaml``: what the 2D model's numbers owe to its grid and steps."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from cases.shell.command import COMPLETE, concluded
from cases.shell.interrupts import imports
from cases.shell.whole import write_text, writing
from validation.errors import ValidationError

PAGE_WIDTH = 130  # columns of the table where there is no terminal


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Return what the command line states."""
    parser = argparse.ArgumentParser(
        description="Run the 2D side of a case on three grids and with three time steps; report observed "
        "orders, Richardson extrapolates and grid convergence indices.",
    )
    parser.add_argument("case", type=Path, metavar="CASE.yaml")
    parser.add_argument("--variant", action="append", metavar="NAME", help="only these; may be repeated")
    parser.add_argument("--model", metavar="NAME", help="one of the case file's models (default: the first)")
    parser.add_argument(
        "--output", type=Path, metavar="DIR", help="folder for results, default results/NAME-convergence"
    )
    return parser.parse_args(argv)


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status: 0, 2 for a wrong input or a run that fails, 130 interrupted."""
    chosen = arguments(argv)
    return concluded(lambda: _run(chosen), "interrupted; no result was written")


def _run(chosen: argparse.Namespace) -> int:
    with imports():
        import pandas as pd

        from cases.reading.case_file import load_case_file
        from cases.shell.terminal import page
        from validation.converge.study import chosen_variants, draw, print_table, study
        from validation.runs.output import write_json

    file = load_case_file(chosen.case)
    folder = chosen.output or Path("results") / f"{file.name}-convergence"
    with writing(folder, ValidationError):
        folder.mkdir(parents=True, exist_ok=True)
        found = study(file.model(chosen.model), chosen_variants(file, chosen.variant))
        records = [number.record() for number in found]
        write_json(folder / "convergence.json", records)
        write_text(folder / "convergence.csv", pd.DataFrame(records).to_csv(index=False))
        draw(found, folder / "convergence.svg")
    output = page(PAGE_WIDTH)
    print_table(output, found)
    output.print(f"results in {folder}: convergence.json, .csv and .svg")
    return COMPLETE
