"""Finds where meshes and states begin without inflating those before: by what their first bytes are."""

import zlib
from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from febio_io.xplt.compression import ZLIB_FIRST
from febio_io.xplt.container import HEADER_SIZE, PAIR, Source
from febio_io.xplt.tags import Tag

BLOCK_SIZE = 1 << 18
BEGINNING = 2 * HEADER_SIZE  # of a section: its own header and that of its first child
INFLATED_FROM = 256  # compressed bytes that certainly hold the beginning
FIRST_CHILD = {Tag.STATE: Tag.STATE_HEADER, Tag.MESH: Tag.NODE_SECTION}


def start_finder(source: Source) -> Callable[[int], int | None]:
    """Give a function that finds where the section after a compressed one begins.

    Returns
    -------
    callable
        From the byte where a compressed section starts to that of the next section, or None. To be asked in
        the file's order.
    """
    starts: Iterator[int] | None = None

    def start_after(position: int) -> int | None:
        nonlocal starts
        starts = starts or section_starts(source, position)
        return next((start for start in starts if start > position), None)

    return start_after


def section_starts(source: Source, start: int) -> Iterator[int]:
    """Search the file for beginnings of meshes and states, raw or compressed.

    A beginning is two headers of chunks, with known tags and sizes that fit; compressed, these must moreover
    be the start of a zlib stream. Chance does not make such bytes, but a search proves nothing: whether one
    section ends where the next was found is seen when it is read.

    Parameters
    ----------
    source : Source
        The file.
    start : int
        Where a compressed section starts. The others are compressed alike: their streams' first two bytes,
        which tell how, are the same.

    Yields
    ------
    int
        Bytes of the file where a section begins, in increasing order.
    """
    data = np.frombuffer(source.data, np.uint8)
    wanted = [(source.data[start : start + 2], 0)]
    for tag in FIRST_CHILD:
        raw = np.array(tag, source.order + "u4").tobytes()
        half = 0 if any(raw[:2]) else 2  # the other half is two zeros, which are everywhere
        wanted.append((raw[half : half + 2], half))
    for block in range(start, len(data), BLOCK_SIZE):
        for place in _places(data[block : block + BLOCK_SIZE + HEADER_SIZE], wanted):
            if place < BLOCK_SIZE and _begins_section(source, block + place):
                yield block + place


def _places(block: NDArray[np.uint8], wanted: list[tuple[bytes, int]]) -> list[int]:
    """Places, in increasing order, that have one of some pairs of bytes so far behind them."""
    found = []
    for shift in (0, 1):
        pairs = block[shift:][: (len(block) - shift) // 2 * 2].view(np.uint16)
        for pair, behind in wanted:
            places = 2 * np.flatnonzero(pairs == np.frombuffer(pair, np.uint16)[0]) + (shift - behind)
            found += places[places >= 0].tolist()
    return sorted(found)


def _begins_section(source: Source, position: int) -> bool:
    beginning = source.data[position : position + BEGINNING]
    if beginning and beginning[0] == ZLIB_FIRST:
        packed = source.data[position : position + INFLATED_FROM]
        try:
            beginning = zlib.decompressobj().decompress(packed, BEGINNING)
        except zlib.error:
            return False
    if len(beginning) < BEGINNING:
        return False
    tag, size = PAIR[source.order].unpack_from(beginning)
    child, child_size = PAIR[source.order].unpack_from(beginning, HEADER_SIZE)
    return bool(FIRST_CHILD.get(tag) == child and HEADER_SIZE + child_size <= size)
