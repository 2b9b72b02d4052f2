"""The blocks of an FEBio data record: headers, and lines of an item's number and its values."""

import math
import re
from array import array
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from febio_io.errors import FebioFormatError
from febio_io.text.record_units import unit_of

HEADER = re.compile(r"\*?\s*(Step|Time|Data|File)\s*=\s?(.*)")
SEPARATORS = str.maketrans(",;|\t", "    ")
INTEGER = re.compile(r"[+-]?\d{1,18}")
NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?|nan|inf)")
# What the C libraries of Windows write for values that are no numbers: -nan(ind), 1.#QNAN, -1.#IND00.
NO_NUMBER = re.compile(
    r"([+-]?)(?:nan\([\w ]{0,20}\)|1\.#(?:(inf)|ind|qnan|snan)\d{0,9}(?:e[+-]\d{1,3})?)", re.I
)
# A comma in a number, which only differs from a separator if others separate the numbers.
DECIMAL_COMMA = re.compile(r"\d,\d.*\d[ ;|\t]|\d[ ;|\t].*\d,\d")
READ = "separators are blanks, commas, semicolons, bars, tabs, or one other text; else name it"


@dataclass
class Block:
    """The lines written at one time.

    Attributes
    ----------
    line : int
        Line of the file where it starts, 1-based.
    step : int
        Number of the time step; counted from 0 where the file does not say.
    time : float
        Time; NaN where the file does not say.
    name : str
        Text after "Data ="; empty where the file does not say.
    positional : bool or None
        Whether the lines have no item numbers, as a format of its own leaves out; items count from 1 then.
        None before the first line of the record, which decides it.
    items : array of int
        Number of each line's item.
    values : array of float
        The values, line by line.
    """

    line: int
    step: int = 0
    time: float = math.nan
    name: str = ""
    positional: bool | None = None
    items: "array[int]" = field(default_factory=lambda: array("q"))
    values: "array[float]" = field(default_factory=lambda: array("d"))

    @property
    def is_whole(self) -> bool:
        """Whether the last item has all its values, which one a line may leave open."""
        return not self.positional or len(self.values) == len(self.items) * max(_n_columns(self.name), 1)


def read_blocks(path: Path, lines: Iterable[tuple[int, str]], delimiter: str | None = None) -> list[Block]:
    """Read the blocks of a separate file.

    Parameters
    ----------
    path : Path
        The file, for messages.
    lines : iterable of (int, str)
        Numbered lines; those that start with # are comments.
    delimiter : str, optional
        What separates the numbers, beside blanks, commas, semicolons, bars and tabs; found if not given.

    Returns
    -------
    list of Block
        The blocks. Without the headers (``comments="off"``), a block starts where the first item comes again.

    Raises
    ------
    FebioFormatError
        If a line is neither a header nor a number of an item and as many values as the others have.
    """
    blocks: list[Block] = []
    block: Block | None = None
    with_headers = False
    for number, line in lines:
        if line.startswith("*"):
            match = HEADER.match(line)
            if match:
                with_headers = True
                block = add_header(path, blocks, block, number, match)
        elif line.strip() and not line.startswith("#"):
            if delimiter is None:
                delimiter = _delimiter(line)
            words = words_of(line, delimiter)
            again = not with_headers and block is not None and not block.positional and bool(block.items)
            if block is None or (again and INTEGER.fullmatch(words[0]) and int(words[0]) == block.items[0]):
                block = Block(number, step=len(blocks), positional=blocks[-1].positional if blocks else None)
                blocks.append(block)
            add_row(path, block, number, line, delimiter)
    return blocks


def _delimiter(line: str) -> str:
    """Find what separates the numbers of a line; empty if that is usual, or cannot be told."""
    between = set(NUMBER.sub(" ", line.translate(SEPARATORS)).split())
    usual = all(float_of(word) is not None for word in words_of(line, ""))
    one = len(between) == 1 and not usual and not any(map(str.isalnum, "".join(between)))
    return between.pop() if one else ""


def words_of(line: str, delimiter: str) -> list[str]:
    """Split a line into its numbers; FEBio writes "%s" for a line's end (%n) in formats."""
    if delimiter:
        line = line.replace(delimiter, " ")
    return line.replace("%s", " ").translate(SEPARATORS).split() or [""]


def add_header(
    path: Path, blocks: list[Block], block: Block | None, number: int, match: re.Match[str]
) -> Block:
    """Take in a header line; "Step" starts a block."""
    key, text = match[1], match[2].strip()
    if block is None or key == "Step" or block.items:
        block = Block(number, step=len(blocks), positional=blocks[-1].positional if blocks else None)
        blocks.append(block)
    if key == "Step":
        block.step = _number(path, number, text, "the number of a time step", INTEGER)
    elif key == "Time":
        block.time = read_number(path, number, text)
    elif key == "Data":
        block.name = text
    return block


def add_row(path: Path, block: Block, number: int, line: str, delimiter: str = "") -> None:
    """Take in a line of values.

    Raises
    ------
    FebioFormatError
        If it is not the number of an item and as many values as the block's other lines have, and not values
        only, as many as there are columns, or one.
    """
    words = words_of(line, delimiter)
    n_columns = _n_columns(block.name)
    if block.positional is None and words != [""]:
        block.positional = len(words) in (1, n_columns)
    if len(words) not in (n_columns, n_columns + 1) and "." not in line and DECIMAL_COMMA.search(line):
        raise FebioFormatError(
            f"line {number}: {line.strip()[:40]!r} has commas in numbers, or two kinds of separators; "
            "allowed: decimal points",
            path=path,
        )
    if block.positional:
        _add_values(path, block, number, words, n_columns)
        return
    item = _number(path, number, words[0], "the number of an item", INTEGER)
    values = [read_number(path, number, word) for word in words[1:]]
    if block.items and len(values) * len(block.items) != len(block.values):
        expected = len(block.values) // len(block.items)
        raise FebioFormatError(
            f"line {number}: {len(values)} values where {expected} are expected", path=path
        )
    block.items.append(item)
    block.values.extend(values)


def _n_columns(name: str) -> int:
    """Count the columns that a block's data list; 0 if it may be the record's own name."""
    parts = name.split(";")
    return len(parts) if len(parts) > 1 or unit_of(name) is not None else 0


def _add_values(path: Path, block: Block, number: int, words: list[str], n_columns: int) -> None:
    """Take in a line without an item's number: all its values, or one of them."""
    values = [read_number(path, number, word) for word in words]
    if len(words) not in (1, n_columns):
        raise FebioFormatError(
            f"line {number}: {len(words)} numbers where {max(n_columns, 1)} are expected", path=path
        )
    if len(block.values) % max(n_columns, 1) == 0:
        block.items.append(len(block.items) + 1)
    block.values.extend(values)


def float_of(word: str) -> float | None:
    """Read a number, also as Windows programs spell what is none; None if it is no number."""
    try:
        return float(word) if "_" not in word else None
    except ValueError:
        match = NO_NUMBER.fullmatch(word)
        return None if match is None else float(f"{match[1]}{match[2] or 'nan'}")


def read_number(path: Path, number: int, word: str) -> float:
    """Read one number, also in the spellings of Windows programs for those that are none.

    Raises
    ------
    FebioFormatError
        If it is no number.
    """
    value = float_of(word)
    if value is None:
        raise FebioFormatError(f"line {number}: {word[:40]!r} is no number; {READ}", path=path)
    return value


def numbered_lines(text: str) -> Iterator[tuple[int, str]]:
    """Go through the lines of a text, numbered from 1."""
    for number, line in enumerate(text.split("\n"), start=1):
        yield number, line.removesuffix("\r")


def _number(path: Path, number: int, text: str, what: str, pattern: re.Pattern[str]) -> int:
    if not pattern.fullmatch(text):
        raise FebioFormatError(f"line {number}: {what} expected, {text[:40]!r} found; {READ}", path=path)
    return int(text)
