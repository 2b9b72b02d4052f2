"""Check case files, or print their JSON schema: `python -m cases FILE…`, `python -m cases --schema`."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

from cases.errors import CaseError
from cases.shell.command import COMPLETE, WRONG_INPUT, concluded
from cases.shell.interrupts import imports

if TYPE_CHECKING:
    from cases.reading.case_file import CaseFile
    from cases.sections.case import Case

MOST_LISTED = 6  # files of a reference


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status: 0, or 2 where a file is wrong."""
    chosen = arguments(argv)
    return concluded(lambda: _run(chosen))


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Return what the command line states."""
    parser = argparse.ArgumentParser(description="Check case files, or print their JSON schema.")
    parser.add_argument("files", nargs="*", metavar="FILE", help="a case file (.yaml)")
    parser.add_argument("--schema", action="store_true", help="print the JSON schema of case files")
    options = parser.parse_args(argv)
    if options.schema == bool(options.files):
        parser.error("state either case files or --schema")
    return options


def _run(options: argparse.Namespace) -> int:
    with imports():
        from cases.reading.case_file import load_case_file
        from cases.reading.json_schema import case_file_schema

    if options.schema:
        print(json.dumps(case_file_schema(), indent=2))
        return COMPLETE
    status = COMPLETE
    for file in options.files:
        try:
            print_summary(load_case_file(file))
        except CaseError as error:
            print(error, file=sys.stderr)
            status = WRONG_INPUT
    return status


def print_summary(file: CaseFile) -> None:
    """Print one line for each variant and model of a file, and on stderr what is seldom meant."""
    from cases.reading.models import labelled
    from cases.sections.doubts import doubts_of

    for model, variants in file.models.items():
        for variant, case in variants.items():
            print(f"{file.path}: {labelled(variant, model, file.models)}: {summary(case)}")
    for variant, case in file.variants.items():  # boundary values are those of all models
        for doubt in doubts_of(case):
            print(f"warning: {file.path}: {variant}: {doubt}", file=sys.stderr)


def summary(case: Case) -> str:
    """Describe a case in a line."""
    solver, bands = case.solver, len(case.compare.bands)
    files = () if case.reference is None else case.reference.files
    names = [path.name for path in files]
    listed = (
        ", ".join(names) if len(names) <= MOST_LISTED else f"{names[0]} … {names[-1]} ({len(names)} files)"
    )
    reference = f"reference {listed}" if files else "no reference"
    return (
        f"calcification {case.calcification.pattern}, {solver.n_x} x {solver.n_phi} cells, "
        f"{solver.cycles} cycles of {case.inlet.period:g} s, {reference}, "
        f"{bands} {'band' if bands == 1 else 'bands'}"
    )
