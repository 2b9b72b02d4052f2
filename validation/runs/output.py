"""A result directory, written whole or not at all."""

import fnmatch
import json
import math
import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pandas as pd

from validation.errors import ValidationError

MARK = "provenance.json"  # every finished result has one
PARAVIEW_FILES = ("rom_*.vtkhdf", "reference_*.vtkhdf")
RESULT_FILES = {
    MARK,
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


def is_result_file(name: str) -> bool:
    """Whether a file of this name belongs to a result."""
    return name in RESULT_FILES or any(fnmatch.fnmatchcase(name, pattern) for pattern in PARAVIEW_FILES)


def _check_content(target: Path, names: set[str]) -> None:
    strange = {name for name in names if not is_result_file(name)}
    if not names or (MARK in names and not strange):
        return
    if MARK in names:
        others = ", ".join(sorted(strange))
        raise ValidationError(f"{target}: holds other files than a result ({others}); move them away")
    raise ValidationError(f"{target}: exists and is no result of a comparison; choose another --output")


@contextmanager
def result_directory(target: Path) -> Iterator[Path]:
    """Fill a temporary directory beside ``target``; it takes the target's place only when complete.

    Raises
    ------
    ValidationError
        As :func:`check_target`, or if the directory cannot be made or put in place.
    """
    check_target(target)
    place = target.resolve()
    made = [folder for folder in place.parents if not folder.exists()]
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
        partial = Path(tempfile.mkdtemp(prefix=".comparison.", suffix=".part", dir=place.parent))
        partial.chmod(0o755)
    except OSError as error:
        raise ValidationError(f"{target}: cannot be written: {error.strerror or error}") from error
    try:
        yield partial
        check_target(target)  # it may have changed meanwhile
        _take_place(partial, place)
    except OSError as error:
        raise ValidationError(f"{target}: cannot be written: {error.strerror or error}") from error
    finally:
        shutil.rmtree(partial, ignore_errors=True)
        for folder in made:
            if folder.is_dir() and not any(folder.iterdir()):
                folder.rmdir()


def _take_place(partial: Path, place: Path) -> None:
    """Rename the complete directory into place; an older result goes only then."""
    if not place.exists():
        partial.rename(place)
        return
    old = partial.with_suffix(".old")
    place.rename(old)
    try:
        partial.rename(place)
    except BaseException:
        old.rename(place)
        raise
    shutil.rmtree(old)


def write_text(path: Path, text: str) -> None:
    """Write a file whole or not at all, UTF-8."""
    partial = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        partial.write_text(text, encoding="utf-8")
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)


def write_json(path: Path, content: Any) -> None:
    """Write strict JSON, indented."""
    write_text(path, json.dumps(content, indent=1, ensure_ascii=False, allow_nan=False) + "\n")


def _plain(value: Any) -> Any:
    if value is None or value is pd.NA:
        return None
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def write_metrics(directory: Path, table: pd.DataFrame) -> None:
    """Write metrics.csv and metrics.json, a line a row, 17 digits."""
    table.to_csv(directory / "metrics.csv", index=False)
    records = [{k: _plain(v) for k, v in row.items()} for row in table.astype(object).to_dict("records")]
    lines = [json.dumps(record, ensure_ascii=False, allow_nan=False) for record in records]
    write_text(directory / "metrics.json", "[\n" + ",\n".join(lines) + "\n]\n")
