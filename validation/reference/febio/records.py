"""Whether data records, which FEBio wrote as text, hold the values of the plot file."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from cases.arrays import Floats
from cases.sections.references.febio import RecordFile
from febio_io.text.data_records import DataRecord, read_data_record
from febio_io.xplt import Plot
from validation.errors import UnusableReferenceError
from validation.reference.febio.record_columns import Shared, shared_columns, values_at
from validation.runs.provenance import shown_path

SINGLE = 1e-6  # of the largest value: single precision, in which plot files are, with a few roundings


@dataclass(frozen=True)
class RecordAccount:
    """What became of one record: facts for provenance, notes, and what casts doubt on the plot file."""

    facts: dict[str, Any]
    notes: tuple[str, ...]
    warnings: tuple[str, ...]


def account_of_record(stated: RecordFile, plot: Plot) -> RecordAccount:
    """Compare a data record with the plot file, wherever both have the same value.

    Parameters
    ----------
    stated : RecordFile
        The record's file, whether its items are nodes or elements, and its columns.
    plot : Plot
        The open plot file.

    Returns
    -------
    RecordAccount
        With the largest difference over the largest value of the same variable.

    Raises
    ------
    FebioError
        If the file cannot be read or is no data record.
    UnusableReferenceError
        If it shares no value with the plot file: columns, items or times are other ones.
    """
    record = read_data_record(stated.file, columns=stated.columns)
    shared = shared_columns(record.columns, stated.items, plot)
    if not shared:
        have = ", ".join(record.columns) or "none"
        why = f"none of its columns ({have}) is a value of {stated.items} that the plot file has"
        raise _unusable(record, plot, why)
    instants = _instants(record, plot)
    if not instants:
        raise _unusable(record, plot, "no time of its blocks is that of a state")
    pairs = {name: _pairs(record, plot, stated.items, name, shared, instants) for name in shared}
    values = sum(written.size for written, _ in pairs.values())
    if not values:
        raise _unusable(record, plot, f"the plot file has no values of its {stated.items}")
    differences = {name: _difference(*both) for name, both in pairs.items()}
    return _account(record, shared, differences, len(instants), values)


def _instants(record: DataRecord, plot: Plot) -> list[tuple[int, int]]:
    """Pairs of a block and the state at its time."""
    pairs = []
    for state, time in enumerate(plot.times):
        apart = np.abs(record.times - time)
        if apart.size and apart.min() <= SINGLE * max(abs(time), float(np.ptp(plot.times))):
            pairs.append((int(np.argmin(apart)), state))
    return pairs


def _pairs(
    record: DataRecord, plot: Plot, items: str, name: str, shared: Shared, instants: list[tuple[int, int]]
) -> tuple[Floats, Floats]:
    """Values (n, n_columns) of one variable in the record, and in the plot file, where that has them."""
    places, components = zip(*shared[name], strict=True)
    written, read = [], []
    for block, state in instants:
        rows = record.blocks == block
        found = values_at(plot, state, items, name, record.items[rows])[:, components]
        there = ~np.isnan(found).any(axis=1)
        read.append(found[there])
        written.append(record.values[rows][:, places][there])
    return np.concatenate(written), np.concatenate(read)


def _difference(written: Floats, read: Floats) -> float:
    """Largest difference over the largest value; infinite where a value is not finite."""
    largest = float(np.max(np.abs(written), initial=0.0))
    with np.errstate(invalid="ignore"):
        difference = float(np.max(np.abs(written - read), initial=0.0))
    if not np.isfinite([largest, difference]).all():
        return np.inf
    return difference / largest if largest else difference


def _account(
    record: DataRecord, shared: Shared, differences: dict[str, float], instants: int, values: int
) -> RecordAccount:
    name, worst = record.path.name, max(differences, key=lambda variable: differences[variable])
    largest = differences[worst]
    columns = [record.columns[place] for place in sorted(p for pairs in shared.values() for p, _ in pairs)]
    facts = {
        "file": shown_path(record.path),
        "columns": columns,
        "instants": instants,
        "values": values,
        "largest_difference": largest if np.isfinite(largest) else None,
    }
    if largest <= SINGLE:
        note = (
            f"{name}: {values} values that FEBio wrote as text ({', '.join(columns)}; {instants} instants) "
            f"are those of the plot file to {largest:.1e} of the largest, which is single precision"
        )
        return RecordAccount(facts, (note,), record.warnings)
    doubt = (
        f"{name}: {worst} differs from the plot file by up to {largest:.1e} of its largest value, more than "
        "single precision allows: they are of different runs, or one of the files is damaged"
    )
    return RecordAccount(facts, (), (*record.warnings, doubt))


def _unusable(record: DataRecord, plot: Plot, why: str) -> UnusableReferenceError:
    return UnusableReferenceError(
        f"{record.path}: cannot be compared with {plot.path}: {why} (reference.data_records)"
    )
