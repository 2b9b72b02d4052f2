"""The command ``python -m febio_io FILE``: what a file of FEBio holds, and export to other formats."""

import argparse
import json
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Literal

from cases.shell.command import COMPLETE, concluded
from febio_io.errors import FebioFileError, FebioFormatError, FebioKeyError
from febio_io.feb.structure import read_structure
from febio_io.feb.summary import model_lines, problem_lines, summarize_model
from febio_io.files import open_file, text_of
from febio_io.text.data_records import looks_like_record, read_data_record
from febio_io.text.log import LOOKED_AT, looks_like_log, read_log
from febio_io.text.summary import log_lines, record_lines, summarize_log, summarize_record
from febio_io.views.export import export_log, export_plot, export_record
from febio_io.xplt import open_plot
from febio_io.xplt.root import MAGIC_SIZE
from febio_io.xplt.summary import summarize, summary_lines
from febio_io.xplt.tags import MAGIC

FORMATS = ("vtu", "vtkhdf", "csv", "nc")
# A model, also in two bytes a letter, or behind comments; what else is XML is told what it is.
MODEL = re.compile(rb"<\0?f\0?e\0?b\0?i\0?o\0?_\0?|^\s*<\?xml")
MAGICS = (MAGIC.to_bytes(MAGIC_SIZE, "little"), MAGIC.to_bytes(MAGIC_SIZE, "big"))


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status: 0, 2 if the file cannot be read or what is asked for cannot be done, 130 interrupted."""
    chosen = arguments(argv)
    return concluded(lambda: _run(chosen), "interrupted; no file was written", prefix="febio_io: ")


def _run(options: argparse.Namespace) -> int:
    if options.export is None and (options.format or options.variables or options.states):
        raise FebioFileError("--format, --variables and --states need --export")
    kind = kind_of(options.file)
    run = {"plot": _run_plot, "log": _run_log, "record": _run_record, "model": _run_model}[kind]
    print("\n".join(run(options)))
    return COMPLETE


def kind_of(path: Path) -> Literal["plot", "log", "record", "model"]:
    """Tell a file's kind by what is in it, whatever its name.

    Raises
    ------
    FebioFileError
        If it cannot be opened, or is none of FEBio's result files.
    """
    try:
        with open_file(path) as file:
            start = file.read(LOOKED_AT)
    except OSError as error:
        raise FebioFileError(f"{path}: cannot be read: {error.strerror}") from error
    text = text_of(start)
    if start.startswith(MAGICS):
        return "plot"
    if MODEL.search(start):
        return "model"
    if looks_like_log(text):
        return "log"
    if looks_like_record(text):
        return "record"
    what = f"it starts with {start[:8]!r}" if start else "it is empty"
    raise FebioFileError(f"{path}: not an FEBio plot file, log, data record or model: {what}")


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Return what the command line states."""
    parser = argparse.ArgumentParser(
        description="Tell what an FEBio plot file (.xplt), log (.log), data record (.txt) or model (.feb) "
        "holds, or write results in another format.",
    )
    parser.add_argument("file", type=Path, metavar="FILE", help="the file; its kind is told by what is in it")
    parser.add_argument("--json", action="store_true", help="print JSON, for programs")
    parser.add_argument("--export", type=Path, metavar="DIR", help="write files into this folder")
    parser.add_argument(
        "--format",
        choices=FORMATS,
        help="vtu (the default for plot files) and vtkhdf: for ParaView; csv (the default for others): "
        "tables; nc: netCDF",
    )
    parser.add_argument("--variables", nargs="+", metavar="NAME", help="only these variables or columns")
    parser.add_argument(
        "--states",
        metavar="LIST",
        help="only these states or blocks: numbers from 0, or from the end if negative, and ranges "
        "FIRST:LAST[:STEP] with the last included, e.g. 0,10:20,-1 (as --states=-1 if it starts with a dash)",
    )
    parser.add_argument(
        "--delimiter",
        metavar="TEXT",
        help="what separates the numbers of a data record (delim=), where it is none of the usual",
    )
    return parser.parse_args(argv)


def _run_plot(options: argparse.Namespace) -> list[str]:
    with open_plot(options.file) as plot:
        if options.export is None:
            summary = summarize(plot)
            return _shown(summary, summary_lines(summary), options.json)
        states = None if options.states is None else parse_states(options.states, plot.n_states)
        from rich.progress import SpinnerColumn

        from cases.shell.terminal import progress

        with progress(SpinnerColumn(), "{task.completed} states written") as display:
            task = display.add_task("", total=None)
            written = export_plot(
                plot,
                options.export,
                options.format or "vtu",
                variables=options.variables,
                states=states,
                advance=lambda: display.advance(task),
            )
    return _written(written, options.json)


def _run_log(options: argparse.Namespace) -> list[str]:
    log = read_log(options.file)
    if options.export is None:
        summary = summarize_log(log)
        return _shown(summary, log_lines(summary), options.json)
    if options.variables or options.states:
        raise FebioFileError(f"{options.file}: --variables and --states do not apply to a log")
    return _written(export_log(log, options.export, options.format or "csv"), options.json)


def _run_record(options: argparse.Namespace) -> list[str]:
    record = read_data_record(options.file, delimiter=options.delimiter)
    if options.export is None:
        summary = summarize_record(record)
        return _shown(summary, record_lines(summary), options.json)
    blocks = None if options.states is None else parse_states(options.states, len(record.times))
    written = export_record(
        record, options.export, options.format or "csv", variables=options.variables, blocks=blocks
    )
    return _written(written, options.json)


def _run_model(options: argparse.Namespace) -> list[str]:
    if options.export is not None:
        raise FebioFileError(f"{options.file}: a model cannot be exported")
    contents = read_structure(options.file)
    summary = summarize_model(options.file, contents)
    lines = _shown(summary, model_lines(summary), options.json)
    if contents.problems:
        print("\n".join(lines))
        raise FebioFormatError("\n".join(problem_lines(contents)), path=options.file)
    return lines


def _shown(summary: dict[str, Any], lines: Iterator[str], as_json: bool) -> list[str]:
    return [json.dumps(summary, indent=2)] if as_json else list(lines)


def _written(paths: list[Path], as_json: bool) -> list[str]:
    names = [str(path) for path in paths]
    return [json.dumps({"written": names}, indent=2)] if as_json else [f"wrote {name}" for name in names]


RANGE = re.compile(r"(-?\d{1,9})(?::(-?\d{1,9})(?::(\d{1,9}))?)?")


def parse_states(text: str, count: int) -> list[int]:
    """Read a list of numbers and ranges.

    Parameters
    ----------
    text : str
        E.g. "0,5,10:20,-1" or "0:-1:10": numbers from 0, or from the end if negative; FIRST:LAST and
        FIRST:LAST:STEP are ranges that include the last. Each number counts once, in increasing order.
    count : int
        How many there are.

    Raises
    ------
    FebioKeyError
        If the text is no such list, or a number is not there.
    """
    chosen: set[int] = set()
    for part in text.split(","):
        match = RANGE.fullmatch(part.strip())
        if not match or match[3] == "0":
            raise FebioKeyError(
                f"states {part.strip()!r}: a number, FIRST:LAST or FIRST:LAST:STEP is expected"
            )
        first = _number(match[1], count)
        last = _number(match[2], count) if match[2] else first
        chosen.update(range(first, last + 1, int(match[3] or 1)))
    return sorted(chosen)


def _number(text: str, count: int) -> int:
    number = int(text)
    if not -count <= number < count:
        have = f"0 to {count - 1}" if count else "none"
        raise FebioKeyError(f"state {number} is not there; there are {have}")
    return number % count
