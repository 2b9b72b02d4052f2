"""Variants of a case on three grids and with three time steps: their runs, as a table and as a figure."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

from cases.fields import FIELDS
from cases.reading.case_file import CaseFile
from cases.sections.case import Case
from cases.shell.terminal import progress
from reports.figures.plots import convergence_plots
from validation.converge.refinement import STUDIES, Refined, levels, refined
from validation.errors import ValidationError

LEVELS = ("coarse", "own", "fine")


def chosen_variants(file: CaseFile, names: list[str] | None) -> list[str]:
    """Names of the variants to refine; all where none is named.

    Raises
    ------
    ValidationError
        If the file has no such variant.
    """
    unknown = [name for name in names or () if name not in file.variants]
    if unknown:
        raise ValidationError(f"{file.path}: no variant {unknown[0]!r}; it has: {', '.join(file.variants)}")
    return names or list(file.variants)


def study(cases: Mapping[str, Case], names: list[str]) -> list[Refined]:
    """Refine grid and time step of some variants; progress is shown on a terminal.

    Raises
    ------
    SolverError, ValidationError
        If a grid cannot be halved, or a run fails.
    """
    runs = [(name, what) for name in names for what in STUDIES]
    for name, what in runs:
        levels(cases[name], what)
    found = []
    with progress() as display:
        task = display.add_task("", total=len(runs))
        for name, what in runs:
            display.update(task, description=f"{name}: {what}")
            found += refined(name, cases[name], what)
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
