"""``python -m validation.sweep STUDY.yaml``: run a case over ranges and distributions of its numbers."""

import argparse
import sys
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path

from cases.shell.command import COMPLETE, concluded
from cases.shell.interrupts import imports
from validation.errors import ValidationError

NEEDED = ("distributed", "locket", "pyarrow", "SALib")


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Return what the command line states."""
    parser = argparse.ArgumentParser(
        description="Run the reduced model for many values of a case's numbers. An interrupted sweep goes on "
        "where it was.",
        epilog="Exit status: 0 complete, failed samples included; 2 wrong input; 130 interrupted.",
    )
    parser.add_argument("study", type=Path, metavar="STUDY.yaml", help="study file (docs/sweeps.md)")
    parser.add_argument(
        "--scheduler",
        default="processes",
        metavar="WHERE",
        help="processes (default) or threads of this machine, or a Dask scheduler's address, e.g. tcp://host:8786",
    )
    parser.add_argument(
        "--workers", type=_positive, metavar="N", help="local processes or threads (default: all)"
    )
    parser.add_argument("--output", type=Path, metavar="DIR", help="folder (default: results/NAME)")
    parser.add_argument("--fresh", action="store_true", help="remove what an earlier run left and start anew")
    return parser.parse_args(argv)


def _positive(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text}; allowed: 1, 2, …")
    return int(text)


def _check_scheduler(stated: str) -> None:
    if stated not in ("processes", "threads") and "://" not in stated:
        raise ValidationError(
            f"--scheduler {stated}; allowed: processes, threads, or an address such as tcp://host:8786"
        )


def _check_libraries() -> None:
    missing = [name for name in NEEDED if find_spec(name) is None]
    if missing:
        raise ValidationError(f"sweeps need {', '.join(missing)}; install them: pip install -e '.[sweep]'")


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status: 0 complete, failed samples included, 2 for a wrong input, 130 interrupted."""
    chosen = arguments(argv)

    def interrupted() -> str:
        kept = f"what is done is kept in {chosen.output}" if chosen.output else "nothing was computed"
        return f"interrupted; {kept}, and the same command goes on"

    return concluded(lambda: _run(chosen), interrupted)


def _run(chosen: argparse.Namespace) -> int:
    """Sweep; where no folder is chosen, the study's is, as soon as its name is known."""
    _check_libraries()
    _check_scheduler(chosen.scheduler)
    with imports():
        from validation.sweep.page import up_to_date_page
        from validation.sweep.run import Where, run_sweep
        from validation.sweep.study import load_study

    study = load_study(chosen.study)
    folder = chosen.output = chosen.output or Path("results") / study.name
    where = Where(folder, chosen.scheduler, chosen.workers, chosen.fresh)
    counts = run_sweep(study, where, lambda words: print(words, file=sys.stderr))
    page = up_to_date_page(folder)
    words = f", {counts.failed} of them failed" if counts.failed else ""
    print(f"{study.name}: {counts.done} samples{words}; page: {page}")
    return COMPLETE
