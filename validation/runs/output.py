"""A result directory, written whole or not at all."""

import csv
import json
import math
import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from cases.results.comparison_file import REFERENCE, ROM
from cases.results.metric_row import COLUMNS, MetricRow
from cases.shell.whole import write_text, write_whole_folder, writing
from validation.errors import ValidationError

MARK = "provenance.json"  # every finished result has one
SEAL = "checksums.json"
RESULT_FILES = {
    MARK,
    SEAL,
    "ablation.csv",
    "ablation.json",
    "comparison.nc",
    "metrics.csv",
    "metrics.json",
    "report.html",
    "report.pdf",
}


def check_target(target: Path) -> None:
    """Refuse, before anything is computed, a directory that a result must not replace.

    Raises
    ------
    ValidationError
        If the target exists and holds anything but an older result, or cannot be made.
    """
    try:
        place = target.resolve()
        if place.exists() and not place.is_dir():
            raise ValidationError(f"{target}: exists and is no directory; choose another --output")
        if place.is_dir():
            _check_content(target, {item.name for item in place.iterdir()})
        existing = next(folder for folder in place.parents if folder.exists())
    except (OSError, RuntimeError) as error:
        raise ValidationError(
            f"{target}: cannot be used: {getattr(error, 'strerror', None) or error}"
        ) from error
    if not existing.is_dir() or not os.access(existing, os.W_OK | os.X_OK):
        raise ValidationError(f"{target}: {existing} is no directory that can be written to")
    if place == Path.cwd():
        raise ValidationError(f"{target}: is the current directory; choose another --output")


def _walls_of(mark: Path) -> set[str]:
    """Names of an older result's walls for ParaView; none where its provenance tells no variants."""
    try:
        variants = json.loads(mark.read_text(encoding="utf-8"))["variants"]
        return {
            f"{model}_{variant}.vtkhdf"
            for variant, record in variants.items()
            for model in (REFERENCE, *record.get("models", (ROM,)))
        }
    except (AttributeError, KeyError, OSError, TypeError, ValueError):  # damaged
        return set()


def _check_content(target: Path, names: set[str]) -> None:
    if not names:
        return
    if MARK not in names:
        raise ValidationError(f"{target}: exists and is no result of a comparison; choose another --output")
    strange = names - RESULT_FILES - _walls_of(target / MARK)
    if strange:
        others = ", ".join(sorted(strange))
        raise ValidationError(f"{target}: holds other files than a result ({others}); move them away")


@contextmanager
def result_directory(target: Path) -> Iterator[Path]:
    """Fill a temporary directory beside ``target``; it takes the target's place only when complete.

    Raises
    ------
    ValidationError
        As :func:`check_target`, or if the directory cannot be made or put in place.
    """
    check_target(target)
    with writing(target, ValidationError), write_whole_folder(target.resolve()) as partial:
        yield partial
        check_target(target)  # it may have changed meanwhile


def write_json(path: Path, content: Any) -> None:
    """Write strict JSON, indented."""
    write_text(path, json.dumps(content, indent=1, ensure_ascii=False, allow_nan=False) + "\n")


def write_metrics(directory: Path, rows: Iterable[MetricRow]) -> None:
    """Write metrics.csv and metrics.json, a line a row, 17 digits; null where not finite."""
    records = [_record(row) for row in rows]
    with (directory / "metrics.csv").open("w", encoding="utf-8", newline="") as stream:
        table = csv.writer(stream, lineterminator="\n")
        table.writerow(COLUMNS)
        table.writerows(record.values() for record in records)
    lines = [json.dumps(record, ensure_ascii=False, allow_nan=False) for record in records]
    write_text(directory / "metrics.json", "[\n" + ",\n".join(lines) + "\n]\n")


def _record(row: MetricRow) -> dict[str, Any]:
    found = {name: getattr(row, name) for name in COLUMNS}
    for name in ("t_s", "rom", "reference", "error", "band"):
        if found[name] is not None:  # γ of plug flow is infinite
            found[name] = float(found[name]) if math.isfinite(found[name]) else None
    return found
