"""``python -m validation.benchmark``: how fast the solver is on this machine."""

import argparse
import json
import sys
from collections.abc import Sequence
from pathlib import Path

from cases.shell.command import COMPLETE, concluded
from cases.shell.interrupts import imports
from cases.shell.whole import write_text, writing
from validation.errors import ValidationError

ROOT = Path(__file__).parents[2]
CASE = ROOT / "benchmarks" / "thesis.yaml"
RESULT = ROOT / "benchmarks" / "solver_speed.json"
PRECISION = ROOT / "benchmarks" / "work_precision.json"
QUICK_STEPS = 4000  # of the explicit scheme
PAGE_WIDTH = 110


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Return what the command line states."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeat", type=int, default=5, help="repetitions, default %(default)s")
    parser.add_argument(
        "--quick", action="store_true", help=f"{QUICK_STEPS} steps of scheme godunov, extrapolated to all"
    )
    parser.add_argument(
        "--precision", action="store_true", help="error against cost for steps, grids and tolerances instead"
    )
    parser.add_argument(
        "--output", type=Path, help=f"JSON file, default {RESULT}; with --precision {PRECISION} and its .svg"
    )
    chosen = parser.parse_args(argv)
    chosen.output = chosen.output or (PRECISION if chosen.precision else RESULT)
    if chosen.precision and chosen.quick:
        parser.error("--quick: allowed without --precision")
    if chosen.repeat < 1:
        parser.error(f"--repeat {chosen.repeat}; allowed: 1 or more")
    if not chosen.output.absolute().parent.is_dir():
        parser.error(f"{chosen.output}: its folder does not exist")
    return chosen


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status: 0, 2 for a wrong input or a run that fails, 130 interrupted."""
    stated = sys.argv[1:] if argv is None else argv
    chosen = arguments(stated)
    command = ["python", "-m", "validation.benchmark", *stated]
    run = _precision if chosen.precision else _run
    return concluded(lambda: run(chosen, command), "interrupted; nothing was written")


def _run(chosen: argparse.Namespace, command: list[str]) -> int:
    with imports():
        from rich.console import Console

        from cases.shell.terminal import page
        from validation.benchmark.measure import measure, result_of, table_of

    with Console(stderr=True).status("") as status:
        rows = measure(CASE, chosen.repeat, QUICK_STEPS if chosen.quick else None, status.update)
    with writing(chosen.output, ValidationError):
        write_text(chosen.output, json.dumps(result_of(rows, CASE, command), indent=1) + "\n")
    console = page(PAGE_WIDTH)
    console.print(table_of(rows))
    for row in rows:
        if row.extrapolated:
            console.print(f"≈ {row.name}: extrapolated from {row.wall_s[0]:.3g} s to all {row.steps} steps")
    return COMPLETE


def _precision(chosen: argparse.Namespace, command: list[str]) -> int:
    with imports():
        from rich.console import Console

        from cases.values.kinds import STEP_TOLERANCE
        from reports.figures.work_precision import work_precision
        from validation.benchmark.precision import lines_of, measure, result_of

    with Console(stderr=True).status("") as status:
        points = measure(CASE, chosen.repeat, status.update)
    figure = chosen.output.with_suffix(".svg")
    with writing(chosen.output, ValidationError):
        write_text(chosen.output, json.dumps(result_of(points, CASE, command), indent=1) + "\n")
        write_text(figure, work_precision(lines_of(points), STEP_TOLERANCE))
    for point in points:
        told = point.output if point.error is None else f"{point.error:.1e} ({point.output})"
        limit = "" if point.tolerance is None else f", tolerance {point.tolerance:g}"
        print(
            f"{point.model}, {point.scheme}, {point.series}: {point.n_x} × {point.n_phi}, "
            f"{1e3 * point.time_step:.4g} ms{limit}: {point.cpu_s:.3g} s, error {told}"
        )
    print(f"results: {chosen.output}, {figure}")
    return COMPLETE
