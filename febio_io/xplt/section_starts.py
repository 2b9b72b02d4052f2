"""Finds where meshes and states begin without inflating those before: by what their first bytes are."""

import zlib
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from febio_io.xplt.compression import ZLIB_FIRST, ZLIB_SECOND
from febio_io.xplt.container import HEADER_SIZE, PAIR, Source
from febio_io.xplt.tags import Tag

BLOCK_SIZE = 1 << 18
BEGINNING = 2 * HEADER_SIZE  # of a section: its own header and that of its first child
INFLATED_FROM = 256  # compressed bytes that certainly hold the beginning
IS_ZLIB_SECOND = np.isin(np.arange(256), ZLIB_SECOND)
FIRST_CHILD = {Tag.STATE: Tag.STATE_HEADER, Tag.MESH: Tag.NODE_SECTION}


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
        First byte to look at.

    Yields
    ------
    int
        Bytes of the file where a section begins, in increasing order.
    """
    data = np.frombuffer(source.data, np.uint8)
    for block in range(start, len(data), BLOCK_SIZE):
        places = _candidates(data[block : block + BLOCK_SIZE + HEADER_SIZE], source)
        for place in places[places < BLOCK_SIZE]:
            if _begins_section(source, block + int(place)):
                yield block + int(place)


def _candidates(block: NDArray[np.uint8], source: Source) -> NDArray[np.int64]:
    """Places of the first bytes of zlib streams and of raw sections, in increasing order."""
    first = np.flatnonzero(block[:-1] == ZLIB_FIRST)
    places = [first[IS_ZLIB_SECOND[block[first + 1]]]]
    pairs = [block[shift:][: (len(block) - shift) // 2 * 2].view(np.uint16) for shift in (0, 1)]
    for tag in FIRST_CHILD:
        wanted = np.array(tag, source.order + "u4").tobytes()
        half = 0 if any(wanted[:2]) else 2  # the other half is two zeros, which are everywhere
        pair = np.frombuffer(wanted, np.uint16, 1, half)[0]
        for shift in (0, 1):
            found = 2 * np.flatnonzero(pairs[shift] == pair) + (shift - half)
            found = found[(found >= 0) & (found <= len(block) - len(wanted))]
            places.append(found[(block[found + 2 - half] | block[found + 3 - half]) == 0])
    return np.sort(np.concatenate(places))


def _begins_section(source: Source, position: int) -> bool:
    beginning = source.data[position : position + BEGINNING]
    if beginning[:1] == bytes([ZLIB_FIRST]):
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
