"""``python -m solver CASE.yaml [--variant NAME] --output FILE.nc``: run one reduced model of a case alone."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from cases.shell.command import COMPLETE, concluded
from cases.shell.interrupts import imports
from solver.errors import SolverError
from solver.runs.files import check_folder, pieces_folder

if TYPE_CHECKING:
    from cases.reading.case_file import CaseFile

USUAL = "what is usual: docs/methods.md, Diagnostics; solver.limits in the case stops a run beyond a limit"


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Return what the command line states."""
    parser = argparse.ArgumentParser(description="Run the 2D reduced-order model.")
    parser.add_argument("case", type=Path, help="case file (YAML)")
    parser.add_argument("--variant", help="variant of the case file (needed where it has several)")
    parser.add_argument("--model", help="one of the case file's models (default: the first)")
    parser.add_argument("--output", type=Path, required=True, help="result file (NetCDF), e.g. run.nc")
    parser.add_argument("--resume", action="store_true", help="go on with an interrupted run")
    return parser.parse_args(argv)


def chosen_variant(file: CaseFile, name: str | None) -> str:
    """Name of the variant to run.

    Raises
    ------
    SolverError
        Where the name is unknown, or none is given and there are several.
    """
    names = ", ".join(file.variants)
    if name is None and len(file.variants) == 1:
        return next(iter(file.variants))
    if name is None:
        raise SolverError(f"{file.path}: has several variants; choose one with --variant: {names}")
    if name not in file.variants:
        raise SolverError(f"{file.path}: has no variant {name!r}; allowed: {names}")
    return name


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status: 0, 2 for a wrong input or a run that fails, 130 interrupted."""
    chosen = arguments(argv)
    kept = pieces_folder(chosen.output)
    return concluded(lambda: _run(chosen), f"interrupted; --resume goes on from the last piece in {kept}")


def _run(options: argparse.Namespace) -> int:
    with imports():
        from cases.reading.case_file import load_case_file
        from cases.reading.models import labelled
        from cases.sections.doubts import doubts_of
        from cases.shell.terminal import progress_bar
        from solver.case.locality import locality_warning
        from solver.case.periodicity import periodicity_warning
        from solver.errors import ModelError, RunFailure, SolverError
        from solver.model.diagnostics import Limits
        from solver.runs.resumable import run_identity, run_to_file

    check_folder(options.output)
    file = load_case_file(options.case)
    variant, model = chosen_variant(file, options.variant), options.model or next(iter(file.models))
    case = file.model(model)[variant]
    stated = {"case": file.name, "title": file.title, "variant": variant, "model": model}
    stated |= {"case_yaml": file.text}
    results = () if case.reference is None else case.reference.files
    chosen = labelled(variant, model, file.models)
    identity = run_identity(file.text, chosen, [path for path in case.input_files if path not in results])
    with progress_bar(f"{file.name} {chosen}") as progress:
        try:
            done = run_to_file(case, options.output, identity, stated, options.resume, progress)
        except (ModelError, RunFailure) as error:
            raise SolverError(f"{options.case}, variant {chosen}: {error}") from error
    warnings = (
        *doubts_of(case),
        locality_warning(done.get("wall_locality_error")),
        periodicity_warning(done["cycle_change"]),
    )
    for warning in filter(None, warnings):
        print(f"warning: {warning}", file=sys.stderr)
    print(f"{options.output}: {done['steps']} steps of at most {done['time_step_s']:.6g} s")
    for name in vars(Limits()):
        value = done["largest"][name]
        found = f"at most {value:.3g}" if math.isfinite(value) else "not evaluated: states too far apart"
        print(f"  {name.replace('_', ' ')} {found}")
    change = done["cycle_change"]
    told = "not evaluated: no state was saved at its start" if change is None else f"{change:.3g} (relative)"
    print(f"  change over the last cycle {told}")
    print(f"  {USUAL}")
    return COMPLETE
