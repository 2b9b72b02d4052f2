"""The folder of a sweep: parts of a Parquet dataset, each written whole, and one writer at a time."""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import locket
import pyarrow as pa
import pyarrow.parquet as pq

from cases.results.sweep import FAILED
from cases.shell.whole import write_whole, writing
from validation.errors import ValidationError

STUDY, ACCOUNT, SAMPLES, LOCK = "study.yaml", "study.json", "samples", ".lock"
PAGE_FILES = ("index.html", "index.pdf")
OWN_FILES = (STUDY, ACCOUNT, SAMPLES, LOCK, *PAGE_FILES)


@dataclass(frozen=True)
class Counts:
    """How many samples are recorded, and how many of these failed."""

    done: int = 0
    failed: int = 0

    def __add__(self, other: "Counts") -> "Counts":
        """Count both."""
        return Counts(self.done + other.done, self.failed + other.failed)


def schema_of(parameters: Iterable[str], outputs: Iterable[str]) -> pa.Schema:
    """Return the columns of a dataset, from the names of its parameters and outputs."""
    columns = [
        ("sample", pa.int64()),
        ("variant", pa.string()),
        ("status", pa.string()),
        ("error", pa.string()),
    ]
    numbers = ["seconds", *parameters, *outputs]
    return pa.schema([*columns, *((name, pa.float64()) for name in numbers)])


@contextmanager
def claimed(folder: Path) -> Iterator[None]:
    """Make a folder the place of one sweep and of one process at a time.

    Raises
    ------
    ValidationError
        If it holds other things, cannot be written to, or another process is at it.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        _check_content(folder)
        lock = locket.lock_file(str(folder / LOCK), timeout=0)
        lock.acquire()
    except locket.LockError as error:
        raise ValidationError(f"{folder}: another sweep is writing there; choose another --output") from error
    except OSError as error:
        raise ValidationError(f"{folder}: cannot be written: {error.strerror or error}") from error
    try:
        yield
    finally:
        lock.release()
        (folder / LOCK).unlink(missing_ok=True)


def _check_content(folder: Path) -> None:
    names = {item.name for item in folder.iterdir()}
    strange = sorted(name for name in names if name not in OWN_FILES and not name.endswith(".part"))
    if strange:
        raise ValidationError(
            f"{folder}: holds other files than a sweep ({', '.join(strange)}); choose another --output"
        )


def begun(folder: Path) -> dict[str, Any] | None:
    """Return the account of an earlier run in a folder; None where there was none.

    Raises
    ------
    ValidationError
        If it cannot be read.
    """
    path = folder / ACCOUNT
    if not path.exists():
        return None
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise ValidationError(f"{path}: cannot be read: {error}; --fresh starts anew") from error
    if not isinstance(found, dict):
        raise ValidationError(f"{path}: is no account of a sweep; --fresh starts anew")
    return found


def cleared(folder: Path) -> None:
    """Remove what an earlier sweep left in a folder of its own."""
    for path in [
        *(folder / SAMPLES).glob("part-*.parquet"),
        folder / ACCOUNT,
        *(folder / name for name in PAGE_FILES),
    ]:
        path.unlink(missing_ok=True)


def part_path(folder: Path, number: int) -> Path:
    """Return where the samples of one chunk lie."""
    return folder / SAMPLES / f"part-{number:06d}.parquet"


def write_part(path: Path, records: Sequence[Mapping[str, object]], schema: pa.Schema) -> Counts:
    """Write the records of one chunk, whole or not at all.

    Raises
    ------
    ValidationError
        If it cannot be written.
    """
    table = pa.Table.from_pylist(list(records), schema)
    with writing(path, ValidationError), write_whole(path) as partial:
        pq.write_table(table, partial, write_page_checksum=True)
    return Counts(len(records), sum(record["status"] == FAILED for record in records))


def parts_present(folder: Path, chunks: Sequence[range], schema: pa.Schema) -> dict[int, Counts]:
    """Return the chunks that are recorded, by number; remove what a killed writer left, and damaged parts.

    Parameters
    ----------
    folder : pathlib.Path
        A claimed folder of this study.
    chunks : sequence of range
        Numbers of the samples of each chunk.
    schema : pyarrow.Schema
        The columns of a part.

    Raises
    ------
    ValidationError
        If something else lies among the parts.
    """
    place = folder / SAMPLES
    with writing(place, ValidationError):
        place.mkdir(exist_ok=True)
    for path in place.glob(".*.part"):
        path.unlink(missing_ok=True)
    parts = {part_path(folder, number) for number in range(len(chunks))}
    for path in sorted(place.iterdir()):
        if path not in parts or not path.is_file():
            raise ValidationError(
                f"{path}: no part of this sweep; allowed there: its {len(parts)} parts; remove it"
            )
    found = {}
    for number, numbers in enumerate(chunks):
        path = part_path(folder, number)
        if not path.exists():
            continue
        counts = _counts_of(path, numbers, schema)
        if counts is None:
            path.unlink()
        else:
            found[number] = counts
    return found


def _counts_of(path: Path, numbers: range, schema: pa.Schema) -> Counts | None:
    """Count the records of a part; None where it is damaged or holds other samples or columns."""
    try:
        with pq.ParquetFile(path, page_checksum_verification=True) as part:  # read_table would load pandas
            table = part.read()
    except (pa.ArrowException, OSError):
        return None
    if not table.schema.equals(schema) or table["sample"].to_pylist() != list(numbers):
        return None
    return Counts(len(numbers), table["status"].to_pylist().count(FAILED))


def all_records(folder: Path, columns: list[str]) -> pa.Table:
    """Return columns of all recorded samples, in the order of their numbers."""
    return pq.read_table(folder / SAMPLES, columns=["sample", *columns]).sort_by("sample")
