"""``python -m validation.benchmark``: how fast the solver is on this machine."""

import argparse
import json
import sys
from collections.abc import Sequence
from pathlib import Path

from cases.shell.command import COMPLETE, concluded
from cases.shell.interrupts import interrupts_deferred
from cases.shell.whole import write_text, writing
from validation.errors import ValidationError

ROOT = Path(__file__).parents[2]
CASE = ROOT / "benchmarks" / "thesis.yaml"
RESULT = ROOT / "benchmarks" / "solver_speed.json"
QUICK_STEPS = 4000  # of the explicit scheme
PAGE_WIDTH = 110


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Return what the command line states."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeat", type=int, default=5, help="repetitions, default %(default)s")
    parser.add_argument(
        "--quick", action="store_true", help=f"{QUICK_STEPS} steps of scheme godunov, extrapolated to all"
    )
    parser.add_argument("--output", type=Path, default=RESULT, help="JSON file, default %(default)s")
    chosen = parser.parse_args(argv)
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
    return concluded(lambda: _run(chosen, command), "interrupted; nothing was written")


def _run(chosen: argparse.Namespace, command: list[str]) -> int:
    with interrupts_deferred():
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
