"""Chunks (tag, size, payload) and the values in them, in the file or in an inflated stream of it."""

import mmap
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import DTypeLike, NDArray

from febio_io.errors import FebioFormatError
from febio_io.xplt.tags import Tag

ByteOrder = Literal["<", ">"]
HEADER_SIZE = 8
PAIR = {"<": struct.Struct("<II"), ">": struct.Struct(">II")}


class Chunk(NamedTuple):
    """One chunk: its tag, where its payload starts, and the payload's size in bytes."""

    tag: int
    start: int
    size: int

    @property
    def end(self) -> int:
        """First byte after the payload."""
        return self.start + self.size


@dataclass(frozen=True)
class Source:
    """Bytes that chunks are read from: the mapped file, or one inflated stream of it.

    Attributes
    ----------
    path : Path
        The file, for messages.
    data : mmap or bytes
        The bytes.
    order : {"<", ">"}
        Byte order of all numbers.
    stream_offset : int or None
        Where the compressed stream starts in the file; None for the file itself.
    """

    path: Path
    data: mmap.mmap | bytes
    order: ByteOrder
    stream_offset: int | None = None

    def error(self, message: str, offset: int | None = None, tag: int | None = None) -> FebioFormatError:
        """Make the error that names this source and a place in it."""
        return FebioFormatError(
            message, path=self.path, offset=offset, tag=tag, stream_offset=self.stream_offset
        )

    def error_in(self, chunk: Chunk, message: str) -> FebioFormatError:
        """Make the error that names a chunk of this source."""
        return self.error(message, chunk.start, chunk.tag)

    def array(self, chunk: Chunk, dtype: DTypeLike) -> NDArray[Any]:
        """View a payload as items of one type, given without byte order.

        Raises
        ------
        FebioFormatError
            If the payload is not a whole number of items.
        """
        item = np.dtype(dtype).newbyteorder(self.order)
        if chunk.size % item.itemsize:
            raise self.error_in(
                chunk, f"{chunk.size} bytes are not a whole number of {item.itemsize}-byte items"
            )
        return np.frombuffer(self.data, item, chunk.size // item.itemsize, chunk.start)

    def integer(self, chunk: Chunk) -> int:
        """Read a payload that is one i32."""
        return int(self._scalar(chunk, "i"))

    def real(self, chunk: Chunk) -> float:
        """Read a payload that is one f32."""
        return float(self._scalar(chunk, "f"))

    def _scalar(self, chunk: Chunk, code: str) -> float:
        if chunk.size != 4:
            raise self.error(
                f"one number of 4 bytes expected, {chunk.size} bytes found", chunk.start, chunk.tag
            )
        value: float = struct.unpack_from(self.order + code, self.data, chunk.start)[0]
        return value

    def counted_text(self, chunk: Chunk) -> str:
        """Read a payload that is an i32 length and as many bytes of text."""
        if chunk.size < 4:
            raise self.error(
                f"a text with its length expected, {chunk.size} bytes found", chunk.start, chunk.tag
            )
        length = self.integer(Chunk(chunk.tag, chunk.start, 4))
        if not 0 <= length <= chunk.size - 4:
            raise self.error(
                f"a text of {length} bytes in {chunk.size - 4} bytes of payload", chunk.start, chunk.tag
            )
        return _decode(self.data[chunk.start + 4 : chunk.start + 4 + length])

    def fixed_text(self, chunk: Chunk) -> str:
        """Read a payload that is text up to the first NUL; what follows it is not initialised by FEBio."""
        return _decode(self.data[chunk.start : chunk.end])


def _decode(raw: bytes) -> str:
    return raw.partition(b"\0")[0].decode("utf-8", errors="replace")


def children(source: Source, parent: Chunk) -> Iterator[Chunk]:
    """Go through the chunks inside a branch.

    Parameters
    ----------
    source : Source
        The bytes.
    parent : Chunk
        The branch; it must lie within the source.

    Yields
    ------
    Chunk
        Each child, whose bytes lie within the parent.

    Raises
    ------
    FebioFormatError
        If a child does not fit.
    """
    position, end = parent.start, parent.end
    read_pair = PAIR[source.order].unpack_from
    while position < end:
        if end - position < HEADER_SIZE:
            raise source.error(f"{end - position} stray bytes at the end of a branch", position, parent.tag)
        tag, size = read_pair(source.data, position)
        position += HEADER_SIZE
        if size > end - position:
            raise source.error(
                f"a size of {size} bytes where {end - position} are left", position - HEADER_SIZE, tag
            )
        yield Chunk(tag, position, size)
        position += size


def children_by_tag(source: Source, parent: Chunk) -> dict[int, Chunk]:
    """Collect the chunks inside a branch whose children all differ in tag.

    Raises
    ------
    FebioFormatError
        If a child does not fit or a known tag occurs twice.
    """
    found: dict[int, Chunk] = {}
    for child in children(source, parent):
        if child.tag in found:
            raise source.error_in(child, "the chunk occurs twice in one branch")
        found[child.tag] = child
    return found


def required(source: Source, parent: Chunk, found: dict[int, Chunk], tag: Tag) -> Chunk:
    """Take one child, which the format requires.

    Raises
    ------
    FebioFormatError
        If the parent has no such child.
    """
    if tag not in found:
        raise source.error_in(parent, f"{tag.name} ({tag:#010x}) is missing")
    return found[tag]
