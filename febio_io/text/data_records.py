"""Data records: values that FEBio wrote as text (``<logfile>``), as tables and labelled arrays."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

from cases.arrays import Floats, Integers
from febio_io.errors import FebioFileError, FebioFormatError
from febio_io.files import read_text
from febio_io.text.record_blocks import Block, numbered_lines, read_blocks
from febio_io.text.record_units import unit_of

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

Repeats = Literal["last", "all"]
LABELS = ("time", "step", "item", "row", "values")


@dataclass(frozen=True, eq=False)
class DataRecord:
    """One data record: rows of values, block by block.

    Attributes
    ----------
    path : Path
        The file.
    name : str
        Name of the record, or the list of its data where it has none; empty where the file does not say.
    columns : tuple of str
        Names of the values. "1", "2" … where the file has only the record's name.
    times : (n_blocks,) float64 array
        Time of each block, in the model's unit; NaN where the file does not say (``comments="off"``).
    steps : (n_blocks,) int64 array
        Number of each block's time step, which FEBio starts again at each analysis step; the number of the
        block where the file does not say.
    blocks : (n_rows,) int64 array
        Number of each row's block.
    items : (n_rows,) int64 array
        Number of each row's item: for nodes their 1-based place in the mesh, for elements their number in the
        model.
    values : (n_rows, n_columns) float64 array
        The values.
    warnings : tuple of str
        What is odd about the file, e.g. that it is cut off.
    """

    path: Path
    name: str
    columns: tuple[str, ...]
    times: Floats
    steps: Integers
    blocks: Integers
    items: Integers
    values: Floats
    warnings: tuple[str, ...] = ()

    @property
    def units(self) -> tuple[str | None, ...]:
        """FEBio's unit pattern of each column, as in plot files (e.g. "L/t"); None where it is not known."""
        return tuple(unit_of(column) for column in self.columns)

    @property
    def is_regular(self) -> bool:
        """Whether every block has the same items in the same order."""
        n_blocks = len(self.times)
        if not n_blocks or len(self.items) % n_blocks:
            return not n_blocks
        table = self.items.reshape(n_blocks, -1)
        same = np.array_equal(self.blocks, np.repeat(np.arange(n_blocks), table.shape[1]))
        return same and bool((table == table[0]).all())

    def to_pandas(self) -> pd.DataFrame:
        """Give one row for each item and time.

        Returns
        -------
        DataFrame
            Columns "step", "time", "item" and those of the record; a column that repeats a name has its
            count added.
        """
        import pandas as pd

        frame = pd.DataFrame(self.values, columns=list(self._labels()))
        frame.insert(0, "item", self.items)
        frame.insert(0, "time", self.times[self.blocks])
        frame.insert(0, "step", self.steps[self.blocks])
        return frame

    def to_xarray(self) -> xr.Dataset:
        """Give one variable for each column.

        Returns
        -------
        Dataset
            Dimensions (time, item) if every block has the same items, which is the rule; (row,) else, with
            the coordinates "time" and "item" along it. Attribute "unit" of a variable where it is known.
        """
        import xarray as xr

        if self.is_regular and len(self.times):
            dims: tuple[str, ...] = ("time", "item")
            values = self.values.reshape(
                len(self.times), len(self.items) // len(self.times), len(self.columns)
            )
            coords = {
                "time": self.times,
                "step": ("time", self.steps),
                "item": self.items[: values.shape[1]],
            }
        else:
            dims, values = ("row",), self.values
            coords = {
                "time": ("row", self.times[self.blocks]),
                "step": ("row", self.steps[self.blocks]),
                "item": ("row", self.items),
            }
        variables = {
            label: (dims, values[..., place], {"unit": unit} if unit else {})
            for place, (label, unit) in enumerate(zip(self._labels(), self.units, strict=True))
        }
        return xr.Dataset(variables, coords, {"name": self.name, "source": self.path.name})

    def _labels(self) -> tuple[str, ...]:
        seen = dict.fromkeys(LABELS, 1)
        labels = []
        for column in self.columns:
            seen[column] = seen.get(column, 0) + 1
            labels.append(f"{column} ({seen[column]})" if seen[column] > 1 else column)
        if len(set(labels)) < len(labels):
            return tuple(str(number) for number in range(1, len(labels) + 1))
        return tuple(labels)


def read_data_record(
    path: str | PathLike[str],
    *,
    columns: tuple[str, ...] | None = None,
    repeats: Repeats = "last",
    delimiter: str | None = None,
) -> DataRecord:
    """Read a data record from its separate file.

    Parameters
    ----------
    path : path-like
        The file.
    columns : tuple of str, optional
        Names of the values, for records that have a name of their own: their file does not tell them.
    repeats : {"last", "all"}, optional
        "last": where time goes back or stands still, as after a restart, only what was written last counts.
        "all": everything counts, e.g. for output at every iteration.
    delimiter : str, optional
        What separates the numbers (``delim=``), where it is not found: no part of a number.

    Returns
    -------
    DataRecord
        The record. A last block that is cut off is left out, which is among its warnings.

    Raises
    ------
    FebioFileError
        If the file cannot be opened or is no data record.
    FebioFormatError
        If a line is neither a header nor an item with its values.
    """
    path = Path(path)
    text = read_text(path)
    whole, _, cut = text.rpartition("\n")
    if not looks_like_record(text[:4096]):
        raise FebioFileError(f"{path}: not an FEBio data record: it starts with {text[:20]!r}")
    if delimiter is not None and (not delimiter or set(delimiter) & set("0123456789.+-eE")):
        raise FebioFormatError(
            f"delimiter {delimiter!r}: allowed: a text that is no part of a number", path=path
        )
    blocks = read_blocks(path, numbered_lines(whole), delimiter)
    return make_record(path, blocks, cut=cut.strip(), columns=columns, repeats=repeats)


def looks_like_record(start: str) -> bool:
    """Whether a text begins like a data record: with a header line, or an item's number and values."""
    lines = (line.strip() for line in start.split("\n"))
    line = next((line for line in lines if line and not line.startswith("#")), "")
    if line.startswith("*"):
        return line[1:].lstrip()[:4] in ("Step", "Time", "Data", "Titl")
    return bool(line) and line[0] in "+-0123456789" and "\0" not in start


def make_record(
    path: Path,
    blocks: list[Block],
    *,
    cut: str,
    columns: tuple[str, ...] | None = None,
    repeats: Repeats = "last",
) -> DataRecord:
    """Put blocks together.

    Parameters
    ----------
    path : Path
        The file.
    blocks : list of Block
        The blocks.
    cut : str
        What there is of a last line that is incomplete; empty if the text ends with a line's end.
    columns, repeats
        As in :func:`read_data_record`.

    Raises
    ------
    FebioFormatError
        If the blocks differ in the number of values, or the given columns in number from them.
    """
    blocks, warnings = _complete(path, blocks, cut)
    if repeats == "last":
        blocks, superseded = _last_written(blocks)
        if superseded:
            warnings.append(
                f"{path.name}: {superseded} blocks were written again later; only the last of each time count"
            )
    width = _width(path, blocks)
    name = next((block.name for block in blocks if block.name), "")
    warnings += _doubts(path, blocks, name, width, columns)
    sizes = [len(block.items) for block in blocks]
    return DataRecord(
        path=path,
        name=name,
        columns=_columns(path, name, width, columns),
        times=np.array([block.time for block in blocks], dtype=np.float64),
        steps=np.array([block.step for block in blocks], dtype=np.int64),
        blocks=np.repeat(np.arange(len(blocks)), sizes).astype(np.int64),
        items=np.concatenate([np.empty(0, np.int64), *(np.array(block.items, np.int64) for block in blocks)]),
        values=np.concatenate(
            [np.empty(0), *(np.array(block.values, np.float64) for block in blocks)]
        ).reshape(sum(sizes), width),
        warnings=tuple(warnings),
    )


def _doubts(
    path: Path, blocks: list[Block], name: str, width: int, columns: tuple[str, ...] | None
) -> Iterator[str]:
    """Say what may have been read otherwise than it was meant."""
    if any(block.positional for block in blocks):
        yield f"{path.name}: its lines have no item numbers; items are counted from 1 in each block"
    if any(len(set(block.items)) < len(block.items) for block in blocks):
        yield (
            f"{path.name}: an item stands twice in a block: item numbers may be missing, "
            "and the first column be a value"
        )
    names = name.split(";")
    if columns is None and width and len(names) != width and (len(names) > 1 or unit_of(name) is not None):
        yield (
            f"{path.name}: {len(names)} names ({name[:80]}) but {width} values an item: "
            "are there decimal commas?"
        )


def _complete(path: Path, blocks: list[Block], cut: str) -> tuple[list[Block], list[str]]:
    """Leave out a last block that is shorter than the others, or whose last line is incomplete."""
    others = {len(block.items) for block in blocks[:-1]}
    size = len(blocks[-1].items) if blocks else 0
    short = bool(blocks) and (
        not size or not blocks[-1].is_whole or (len(others) == 1 and size < min(others))
    )
    in_it = bool(blocks and cut) and not cut.startswith("*") and others != {size}
    if short or in_it:
        return blocks[:-1], [f"{path.name} is cut off: its last block, which is incomplete, is left out"]
    return blocks, [f"{path.name} is cut off after its last block"] if cut else []


def _last_written(blocks: list[Block]) -> tuple[list[Block], int]:
    kept: list[Block] = []
    for block in blocks:
        while kept and kept[-1].time >= block.time:
            kept.pop()
        kept.append(block)
    return kept, len(blocks) - len(kept)


def _width(path: Path, blocks: list[Block]) -> int:
    filled = [block for block in blocks if block.items]
    widths = [len(block.values) // len(block.items) for block in filled]
    for block, width in zip(filled, widths, strict=True):
        if not block.is_whole:
            raise FebioFormatError(f"line {block.line}: a block whose last item lacks values", path=path)
        if width != widths[0]:
            raise FebioFormatError(
                f"line {block.line}: a block with {width} values an item, after others with {widths[0]}",
                path=path,
            )
    return widths[0] if widths else 0


def _columns(path: Path, name: str, width: int, given: tuple[str, ...] | None) -> tuple[str, ...]:
    if given is not None:
        if width and len(given) != width:
            raise FebioFormatError(f"{len(given)} columns named where the file has {width}", path=path)
        return given if width else ()
    names = tuple(part.strip() for part in name.split(";"))
    if len(names) == width and all(names):
        return names
    return tuple(str(number) for number in range(1, width + 1))
