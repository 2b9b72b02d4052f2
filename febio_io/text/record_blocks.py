"""The blocks of an FEBio data record: headers, and lines of an item's number and its values."""

import math
import re
from array import array
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from febio_io.errors import FebioFormatError

HEADER = re.compile(r"\*?\s*(Step|Time|Data|File)\s*=\s?(.*)")
SEPARATORS = str.maketrans(",;|\t", "    ")
INTEGER = re.compile(r"[+-]?\d{1,18}")
# What the C library of Windows wrote for values that are no numbers.
WINDOWS_VALUES = {"#IND": math.nan, "#QNAN": math.nan, "#SNAN": math.nan, "#INF": math.inf}


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
    items : array of int
        Number of each line's item.
    values : array of float
        The values, line by line.
    """

    line: int
    step: int = 0
    time: float = math.nan
    name: str = ""
    items: "array[int]" = field(default_factory=lambda: array("q"))
    values: "array[float]" = field(default_factory=lambda: array("d"))


def read_blocks(path: Path, lines: Iterable[tuple[int, str]]) -> list[Block]:
    """Read the blocks of a separate file.

    Parameters
    ----------
    path : Path
        The file, for messages.
    lines : iterable of (int, str)
        Numbered lines.

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
        elif line.strip():
            if block is None or (not with_headers and block.items and _item(line) == block.items[0]):
                block = Block(number, step=len(blocks))
                blocks.append(block)
            add_row(path, block, number, line)
    return blocks


def add_header(
    path: Path, blocks: list[Block], block: Block | None, number: int, match: re.Match[str]
) -> Block:
    """Take in a header line; "Step" starts a block."""
    key, text = match[1], match[2].strip()
    if block is None or key == "Step" or block.items:
        block = Block(number, step=len(blocks))
        blocks.append(block)
    if key == "Step":
        block.step = _number(path, number, text, "the number of a time step", INTEGER)
    elif key == "Time":
        block.time = read_number(path, number, text)
    elif key == "Data":
        block.name = text
    return block


def add_row(path: Path, block: Block, number: int, line: str) -> None:
    """Take in a line of values.

    Raises
    ------
    FebioFormatError
        If it is not the number of an item and as many values as the block's other lines have.
    """
    words = line.translate(SEPARATORS).split()
    item = _number(path, number, words[0] if words else "", "the number of an item", INTEGER)
    try:
        values = [float(word) for word in words[1:]]
    except ValueError:
        values = [read_number(path, number, word) for word in words[1:]]
    if block.items and len(values) * len(block.items) != len(block.values):
        expected = len(block.values) // len(block.items)
        raise FebioFormatError(
            f"line {number}: {len(values)} values where {expected} are expected", path=path
        )
    block.items.append(item)
    block.values.extend(values)


def read_number(path: Path, number: int, word: str) -> float:
    """Read one number, also in the spellings of old Windows programs for those that are none.

    Raises
    ------
    FebioFormatError
        If it is no number.
    """
    try:
        return float(word)
    except ValueError:
        sign, _, special = word.upper().partition("1.")
        if sign in ("", "+", "-") and special in WINDOWS_VALUES:
            return math.copysign(WINDOWS_VALUES[special], -1.0 if sign == "-" else 1.0)
        raise FebioFormatError(
            f"line {number}: {word[:40]!r} is no number "
            "(lines written with a format of their own cannot be read)",
            path=path,
        ) from None


def numbered_lines(text: str) -> Iterator[tuple[int, str]]:
    """Go through the lines of a text, numbered from 1."""
    for number, line in enumerate(text.split("\n"), start=1):
        yield number, line.removesuffix("\r")


def _number(path: Path, number: int, text: str, what: str, pattern: re.Pattern[str]) -> int:
    if not pattern.fullmatch(text):
        raise FebioFormatError(f"line {number}: {what} expected, {text[:40]!r} found", path=path)
    return int(text)


def _item(line: str) -> int | None:
    words = line.translate(SEPARATORS).split(maxsplit=1)
    return int(words[0]) if words and INTEGER.fullmatch(words[0]) else None
