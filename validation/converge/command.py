"""``python -m validation.converge CASE.yaml``: what the 2D model's numbers owe to its grid and steps."""

import argparse
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
from rich.console import Console
from rich.table import Table

from cases.fields import FIELDS
from cases.reading.case_file import CaseFile, load_case_file
from cases.shell.command import COMPLETE, concluded
from cases.shell.terminal import page, progress
from cases.shell.whole import write_text, writing
from reports.figures.plots import convergence_plots
from validation.converge.refinement import STUDIES, Refined, levels, refined
from validation.errors import ValidationError
from validation.runs.output import write_json

LEVELS = ("coarse", "own", "fine")
PAGE_WIDTH = 130  # columns of the table where there is no terminal


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Return what the command line states."""
    parser = argparse.ArgumentParser(
        description="Run the 2D side of a case on three grids and with three time steps; report observed "
        "orders, Richardson extrapolates and grid convergence indices.",
    )
    parser.add_argument("case", type=Path, metavar="CASE.yaml")
    parser.add_argument("--variant", action="append", metavar="NAME", help="only these; may be repeated")
    parser.add_argument(
        "--output", type=Path, metavar="DIR", help="folder for results, default results/NAME-convergence"
    )
    return parser.parse_args(argv)


def _chosen(file: CaseFile, names: list[str] | None) -> list[str]:
    unknown = [name for name in names or () if name not in file.variants]
    if unknown:
        raise ValidationError(f"{file.path}: no variant {unknown[0]!r}; it has: {', '.join(file.variants)}")
    return names or list(file.variants)


def study(file: CaseFile, names: list[str]) -> list[Refined]:
    """Refine grid and time step of some variants; progress is shown on a terminal.

    Raises
    ------
    SolverError, ValidationError
        If a grid cannot be halved, or a run fails.
    """
    runs = [(name, what) for name in names for what in STUDIES]
    for name, what in runs:
        levels(file.variants[name], what)
    found = []
    with progress() as display:
        task = display.add_task("", total=len(runs))
        for name, what in runs:
            display.update(task, description=f"{name}: {what}")
            found += refined(name, file.variants[name], what)
            display.advance(task)
    return found


def _words(value: float | None, form: str) -> str:
    return "–" if value is None else format(value, form)


def print_table(console: Console, found: Sequence[Refined]) -> None:
    """Print the numbers of the cycle, in the units people read."""
    table = Table(
        "variant", "study", "quantity", "coarse", "own", "fine", "limit", "order", "error of own", "index"
    )
    for number in found:
        if number.where != "cycle":
            continue
        field = FIELDS[number.quantity]
        record = number.record()
        shown = [
            _words(record[key] and record[key] * field.display_factor, ".6g")
            for key in ("coarse", "own", "fine")
        ]
        limit = number.found.extrapolate
        table.add_row(
            number.variant,
            number.study,
            f"{field.label} ({field.display_unit})",
            *shown,
            _words(None if limit is None else limit * field.display_factor, ".6g"),
            _words(number.found.order, ".2f"),
            _words(record["error_of_own"], ".1e"),
            _words(number.found.index, ".1e"),
        )
    console.print(table)


def draw(found: Sequence[Refined], path: Path) -> None:
    """Draw how each number of the cycle changes from level to level."""
    variants = dict.fromkeys(number.variant for number in found)
    numbers = {
        (variant, what): [
            (FIELDS[number.quantity].symbol, np.array(number.values))
            for number in found
            if (number.variant, number.study, number.where) == (variant, what, "cycle")
        ]
        for variant in variants
        for what in STUDIES
    }
    convergence_plots(numbers, path)


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status: 0, 2 for a wrong input or a run that fails, 130 interrupted."""
    chosen = arguments(argv)
    return concluded(lambda: _run(chosen), "interrupted; no result was written")


def _run(chosen: argparse.Namespace) -> int:
    file = load_case_file(chosen.case)
    folder = chosen.output or Path("results") / f"{file.name}-convergence"
    with writing(folder, ValidationError):
        folder.mkdir(parents=True, exist_ok=True)
        found = study(file, _chosen(file, chosen.variant))
        records = [number.record() for number in found]
        write_json(folder / "convergence.json", records)
        write_text(folder / "convergence.csv", pd.DataFrame(records).to_csv(index=False))
        draw(found, folder / "convergence.svg")
    output = page(PAGE_WIDTH)
    print_table(output, found)
    output.print(f"results in {folder}: convergence.json, .csv and .svg")
    return COMPLETE
