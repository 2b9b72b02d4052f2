"""``python -m validation.compare CASE.yaml``: what it is told, what it says, and its exit status."""

from __future__ import annotations

import argparse
import shlex
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cases.shell.command import BAND_BROKEN, COMPLETE, concluded
from cases.shell.interrupts import imports

if TYPE_CHECKING:
    from cases.reading.case_file import CaseFile
    from validation.compare.outcome import Outcome


def arguments(argv: Sequence[str]) -> argparse.Namespace:
    """Return what the command line states."""
    parser = argparse.ArgumentParser(
        description="Compare the 2D reduced-order model with a 3D reference and write a report.",
        epilog="Exit status: 0 complete; 1 a band fails or is missing (with --check); 2 wrong input.",
    )
    parser.add_argument("cases", nargs="+", type=Path, metavar="CASE.yaml", help="case files")
    parser.add_argument(
        "--output",
        type=Path,
        metavar="DIR",
        help="result directory (default: results/NAME; with several cases: DIR/NAME)",
    )
    parser.add_argument("--fresh", action="store_true", help="compute everything, whatever earlier runs left")
    parser.add_argument("--check", action="store_true", help="exit 1 unless every band holds")
    return parser.parse_args(argv)


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status: 0 complete, 1 with --check if a band does not hold, 2 wrong input, 130 interrupted."""
    stated = sys.argv[1:] if argv is None else list(argv)
    chosen = arguments(stated)
    command = ["python", "-m", "validation.compare", *map(shlex.quote, stated)]
    return concluded(lambda: _run(chosen, command), "interrupted; no result was written")


def _run(chosen: argparse.Namespace, command: list[str]) -> int:
    with imports():
        from cases.reading.case_file import load_case_file
        from validation.compare.outcome import summary, targets
        from validation.compare.unchanged import determinants, unchanged

    files = [load_case_file(path) for path in chosen.cases]
    digests = [determinants(file) for file in files]  # before anything that they name can change
    places = targets(files, chosen.output)
    rows: dict[str, Any] = {}
    broken = False
    for file, digest, target in zip(files, digests, places, strict=True):
        kept = None if chosen.fresh else unchanged(file, digest, target)
        outcome = kept or _compared(file, digest, target, command, chosen.fresh)
        rows[file.name] = outcome.rows
        for warning in outcome.warnings:
            print(f"warning: {warning}", file=sys.stderr)
        broken |= any(row.status in ("FAIL", "MISSING") for row in outcome.bands)
        print(summary(file, target, outcome))
    if len(files) > 1:
        _write_side_by_side(places[0].parent, rows)
    return BAND_BROKEN if broken and chosen.check else COMPLETE


def _compared(file: CaseFile, digest: str, target: Path, command: list[str], fresh: bool) -> Outcome:
    with imports():
        from validation.compare.case import compare_case
        from validation.runs.cache import open_cache

    return compare_case(file, target, command, open_cache(fresh), digest)


def _write_side_by_side(folder: Path, rows: dict[str, Any]) -> None:
    with imports():
        from validation.compare.side_by_side import write_side_by_side

    written = write_side_by_side(folder, rows)
    print(f"{len(rows)} cases side by side: {', '.join(map(str, written))}")
