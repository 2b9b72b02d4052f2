"""``python -m validation.sweep STUDY.yaml``: run a case over ranges and distributions of its numbers."""

import argparse
import signal
import sys
from importlib.util import find_spec
from pathlib import Path

from cases.errors import CaseError
from febio_io.errors import FebioError
from reports.errors import ReportError
from solver.errors import SolverError
from solver.runs.batch import available_threads
from validation.errors import ValidationError

EXPECTED = (CaseError, SolverError, FebioError, ValidationError, ReportError)
COMPLETE, WRONG_INPUT, INTERRUPTED = 0, 2, 130
NEEDED = ("distributed", "locket", "pyarrow", "SALib")


def _arguments(argv: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m validation.sweep",
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


def _interrupt(*_: object) -> None:
    """Let a request to terminate clean up as Ctrl-C does."""
    raise KeyboardInterrupt


def main(argv: list[str] | None = None) -> int:
    """Run the command; return its exit status."""
    arguments = _arguments(argv)
    signal.signal(signal.SIGTERM, _interrupt)
    folder = arguments.output
    try:
        _check_libraries()
        _check_scheduler(arguments.scheduler)
        from reports.sweep import write_sweep_page
        from validation.sweep.folder import PAGE_FILES, writing
        from validation.sweep.run import Where, run_sweep
        from validation.sweep.study import load_study

        study = load_study(arguments.study)
        folder = folder or Path("results") / study.name
        workers = arguments.workers or available_threads()
        where = Where(folder, arguments.scheduler, workers, arguments.fresh)
        counts = run_sweep(study, where, lambda words: print(words, file=sys.stderr))
        with writing(folder / PAGE_FILES[0]):
            page, _ = write_sweep_page(folder)
    except EXPECTED as error:
        print(error, file=sys.stderr)
        return WRONG_INPUT
    except KeyboardInterrupt:
        kept = "nothing was computed" if folder is None else f"what is done is kept in {folder}"
        print(f"interrupted; {kept}, and the same command goes on", file=sys.stderr)
        return INTERRUPTED
    words = f", {counts.failed} of them failed" if counts.failed else ""
    print(f"{study.name}: {counts.done} samples{words}; page: {page}")
    return COMPLETE


if __name__ == "__main__":
    sys.exit(main())
