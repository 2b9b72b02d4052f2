"""Check case files, or print their JSON schema: `python -m cases FILE…`, `python -m cases --schema`."""

import argparse
import json
import sys

from cases.errors import CaseError
from cases.reading.case_file import CaseFile, load_case_file
from cases.reading.json_schema import case_file_schema
from cases.sections.case import Case


def main(arguments: list[str] | None = None) -> int:
    """Run the command; return its exit status: 0, or 2 where a file is wrong."""
    parser = argparse.ArgumentParser(
        prog="python -m cases", description="Check case files, or print their JSON schema."
    )
    parser.add_argument("files", nargs="*", metavar="FILE", help="a case file (.yaml)")
    parser.add_argument("--schema", action="store_true", help="print the JSON schema of case files")
    options = parser.parse_args(arguments)
    if options.schema == bool(options.files):
        parser.error("state either case files or --schema")
    if options.schema:
        print(json.dumps(case_file_schema(), indent=2))
        return 0
    status = 0
    for file in options.files:
        try:
            print_summary(load_case_file(file))
        except CaseError as error:
            print(error, file=sys.stderr)
            status = 2
    return status


def print_summary(file: CaseFile) -> None:
    """Print one line for each variant of a file."""
    for name, case in file.variants.items():
        print(f"{file.path}: {name}: {summary(case)}")


def summary(case: Case) -> str:
    """Describe a case in a line."""
    solver, bands = case.solver, len(case.compare.bands)
    files = () if case.reference is None else case.reference.files
    reference = f"reference {', '.join(path.name for path in files)}" if files else "no reference"
    return (
        f"calcification {case.calcification.pattern}, {solver.n_x} x {solver.n_phi} cells, "
        f"{solver.cycles} cycles of {case.inlet.period:g} s, {reference}, "
        f"{bands} {'band' if bands == 1 else 'bands'}"
    )


if __name__ == "__main__":
    sys.exit(main())
