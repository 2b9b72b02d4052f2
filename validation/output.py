"""A result directory, written whole or not at all."""

import json
import math
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pandas as pd

from validation.errors import ValidationError

MARK = "provenance.json"  # every finished result has one


def check_target(target: Path) -> None:
    """Refuse, before anything is computed, a directory that a result must not replace.

    Raises
    ------
    ValidationError
        If the target exists and is no older result, or its parent is no directory.
    """
    if target.exists() and not (target.is_dir() and ((target / MARK).is_file() or not any(target.iterdir()))):
        raise ValidationError(f"{target}: exists and is no result of a comparison; choose another --output")
    existing = next(parent for parent in target.absolute().parents if parent.exists())
    if not existing.is_dir():
        raise ValidationError(f"{target}: {existing} is no directory")


@contextmanager
def result_directory(target: Path) -> Iterator[Path]:
    """Fill a temporary directory beside ``target``; it takes the target's place only when complete.

    Raises
    ------
    ValidationError
        As :func:`check_target`, or if the directory cannot be made.
    """
    check_target(target)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        partial = Path(tempfile.mkdtemp(prefix=f".{target.name}.", suffix=".part", dir=target.parent))
    except OSError as error:
        raise ValidationError(f"{target}: cannot be written: {error.strerror or error}") from error
    try:
        partial.chmod(0o755)
        yield partial
        _take_place(partial, target)
    finally:
        shutil.rmtree(partial, ignore_errors=True)


def _take_place(partial: Path, target: Path) -> None:
    if not target.exists():
        partial.rename(target)
        return
    old = partial.with_suffix(".old")
    target.rename(old)
    partial.rename(target)
    shutil.rmtree(old)


def write_json(path: Path, content: Any) -> None:
    """Write strict JSON, UTF-8, indented."""
    path.write_text(
        json.dumps(content, indent=1, ensure_ascii=False, allow_nan=False) + "\n", encoding="utf-8"
    )


def _plain(value: Any) -> Any:
    if value is None or value is pd.NA:
        return None
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def write_metrics(directory: Path, table: pd.DataFrame) -> None:
    """Write metrics.csv and metrics.json, 17 digits."""
    table.to_csv(directory / "metrics.csv", index=False)
    records = [{k: _plain(v) for k, v in row.items()} for row in table.astype(object).to_dict("records")]
    write_json(directory / "metrics.json", records)
