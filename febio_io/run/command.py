"""The command ``python -m febio_io.run``."""

import argparse
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from cases.shell.command import BAND_BROKEN, COMPLETE, concluded
from febio_io.errors import FebioFileError
from febio_io.feb.structure import Contents, read_structure
from febio_io.feb.summary import problem_lines
from febio_io.files import read_text
from febio_io.run.endings import explain_ending
from febio_io.run.process import FebioRunError, Finished, LogTail, find_febio, run_febio
from febio_io.text.log import Log, read_log
from febio_io.xplt import open_plot

Watch = Callable[[LogTail], None]

MOST_THREADS = 1024
FAILED = BAND_BROKEN


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status: 0 if FEBio ended normally, 1 if it did not, 2 if it could not be run, 130 interrupted."""
    chosen = arguments(argv)
    left = "interrupted; FEBio has been ended; what it wrote is left as it is"
    return concluded(
        lambda: _run(chosen), lambda: f"{left}: {_listed(chosen.model, Contents())}", "febio_io.run: "
    )


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Return what the command line states."""
    parser = argparse.ArgumentParser(
        description="Run FEBio 4 on a model; plot file and log are written beside it.",
        epilog="Exit status: 0 normal termination; 1 FEBio failed; 2 it could not be run.",
    )
    parser.add_argument("model", type=Path, metavar="MODEL.feb", help="the model")
    parser.add_argument("--febio", metavar="PATH", help="the program (default: $FEBIO, else febio4 on PATH)")
    parser.add_argument(
        "--threads", type=int, metavar="N", help="threads it may use (default: its own choice)"
    )
    parser.add_argument(
        *("-cnf", "--config"),
        type=Path,
        metavar="FILE",
        help="FEBio's configuration, e.g. its linear solver (default: febio.xml beside the program)",
    )
    parser.add_argument(
        "--force", action="store_true", help="replace the plot file and log of an earlier run"
    )
    return parser.parse_args(argv)


def _run(options: argparse.Namespace) -> int:
    model: Path = options.model
    if options.threads is not None and not 1 <= options.threads <= MOST_THREADS:
        raise FebioRunError(f"--threads {options.threads}: allowed: 1 to {MOST_THREADS}")
    if options.config is not None and not options.config.is_file():
        raise FebioRunError(f"--config {options.config}: there is no such file")
    febio = find_febio(options.febio)
    contents = read_structure(model)
    for problem in problem_lines(contents):
        print(f"warning: {model}: {problem}", file=sys.stderr)
    earlier = _results(model, contents)
    if earlier and not options.force:
        raise FebioRunError(f"{earlier[0]} exists; --force runs the model again and replaces it")
    for path in earlier:
        path.unlink()
    begin = time.perf_counter()
    with _shown(model, contents) as watch:
        configuration = None if options.config is None else options.config.absolute()
        log = model.absolute().parent / (contents.log or model.with_suffix(".log").name)
        finished = run_febio(
            febio, model.absolute(), options.threads, watch, log=log, configuration=configuration
        )
    failure = _problem(model, contents, finished)
    if failure is not None:
        print(f"febio_io.run: {failure}", file=sys.stderr)
        return FAILED
    told = read_log(_log_of(model, contents))
    print(
        f"normal termination: {told.n_converged} time steps, {told.n_iterations} iterations, "
        f"{told.n_retries} retries, {time.perf_counter() - begin:.1f} s; wrote {_listed(model, contents)}"
    )
    return COMPLETE


def _log_of(model: Path, contents: Contents) -> Path:
    """Give the log's path: the model may name it, but if FEBio cannot read the model, that does not count."""
    named = model.parent / contents.log if contents.log else None
    return named if named is not None and named.is_file() else model.with_suffix(".log")


def _results(model: Path, contents: Contents) -> list[Path]:
    """Give the plot file and the log that are there, those of the model's own naming too."""
    names = (contents.plot, model.with_suffix(".xplt").name, contents.log, model.with_suffix(".log").name)
    paths = dict.fromkeys(model.parent / name for name in names if name)
    return [path for path in paths if path.is_file() and not path.samefile(model)]


def _listed(model: Path, contents: Contents) -> str:
    return ", ".join(map(str, _results(model, contents))) or "nothing yet"


def _problem(model: Path, contents: Contents, finished: Finished) -> str | None:
    """Say what went wrong; the log decides, not the exit status alone."""
    path = _log_of(model, contents)
    words = f": {finished.last_words.splitlines()[-1].strip()}" if finished.last_words else ""
    said = (read_text(path) if path.is_file() else "") + "\n" + finished.last_words
    meaning = explain_ending(said) if finished.status >= 0 else ""  # not of one that was killed
    meaning = f"; {meaning}" if meaning else ""
    if not path.is_file():
        return f"FEBio ended with status {finished.status} and wrote no log{words}{meaning}"
    try:
        log = read_log(path)
    except FebioFileError as error:
        return f"FEBio ended with status {finished.status}: {error}{words}{meaning}"
    if log.termination == "error":
        return f"{path}: FEBio ended with an error{_last_error(log)}{meaning}"
    if log.termination == "none":
        how = f"was ended by signal {-finished.status}" if finished.status < 0 else "stopped"
        what = f"FEBio {how} after {log.n_converged} time steps, unfinished"
        return f"{path}: {what}{_last_error(log)}{meaning}"
    if finished.status != 0:
        return f"{path}: FEBio ended normally, but with status {finished.status}{words}"
    if not contents.writes_plot:
        return None
    plot = model.parent / (contents.plot or model.with_suffix(".xplt").name)
    if not plot.is_file():
        return f"{path}: FEBio ended normally, but {plot.name} is missing"
    with open_plot(plot) as opened:
        return f"{plot}: {opened.warnings[0]}" if opened.warnings else None


def _last_error(log: Log) -> str:
    return f": {log.errors[-1].text} (line {log.errors[-1].line})" if log.errors else ""


@contextmanager
def _shown(model: Path, contents: Contents) -> Iterator[Watch]:
    """Show how far the run is, if there is a terminal to show it on."""
    from rich.progress import BarColumn, TimeElapsedColumn, TimeRemainingColumn

    from cases.shell.terminal import progress

    reached = "{task.completed:.4g} of {task.total:.4g} s, step {task.fields[steps]}{task.fields[retries]}"
    columns = ("{task.description}", BarColumn(), reached, TimeElapsedColumn(), TimeRemainingColumn())
    with progress(*columns) as display:
        task = display.add_task(model.name, total=contents.end, steps=0, retries="")

        def watch(tail: LogTail) -> None:
            retries = f", {tail.retries} retries" if tail.retries else ""
            display.update(task, completed=tail.time, steps=tail.steps, retries=retries)

        yield watch
