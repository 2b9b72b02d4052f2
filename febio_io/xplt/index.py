"""The top level of a plot file: where each mesh and state lies, raw or compressed."""

import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from febio_io.xplt.compression import ZLIB_FIRST, Inflater, WrongSizeError, inflate_exactly, is_zlib_start
from febio_io.xplt.container import HEADER_SIZE, PAIR, Chunk, Source, children
from febio_io.xplt.section_starts import start_finder
from febio_io.xplt.tags import Tag

StartFinder = Callable[[int], int | None]
LARGEST_STATE_HEADER = 4096  # its few numbers take some 40 bytes


@dataclass(frozen=True)
class Section:
    """One mesh or state at the top level.

    Attributes
    ----------
    tag : int
        MESH or STATE.
    offset, length : int
        Its bytes in the file, header included.
    size : int
        Bytes of its (inflated) payload.
    compressed : bool
        Whether it is a zlib stream.
    head : bytes
        The payload of a state's header; empty for a mesh.
    """

    tag: int
    offset: int
    length: int
    size: int
    compressed: bool
    head: bytes = b""


@dataclass(frozen=True)
class Index:
    """All complete meshes and states.

    Attributes
    ----------
    sections : tuple of Section
        In the file's order.
    cut_at : int or None
        Byte where an incomplete section starts; None if the file is whole.
    skipped : tuple of int
        Tags of chunks of a kind not known here.
    inflated : dict of int to bytes
        Compressed sections that were kept when they had been inflated, by their offset.
    """

    sections: tuple[Section, ...]
    cut_at: int | None
    skipped: tuple[int, ...]
    inflated: dict[int, bytes]


class _CutOffError(Exception):
    """The file ends before the section does."""


def read_index(source: Source, start: int, keep: int = 0) -> Index:
    """Find every mesh and state.

    Raw sections are hopped over. No length is stored of compressed ones: the first of them are inflated and
    kept; once no more may be, the next section is searched for, so that none need be inflated twice. The last
    one is inflated block by block to see whether it is whole.

    Parameters
    ----------
    source : Source
        The file.
    start : int
        Byte after the root chunk.
    keep : int, optional
        Bytes of inflated sections that may be kept in all.

    Returns
    -------
    Index
        The complete sections, and whether an incomplete one follows.

    Raises
    ------
    FebioFormatError
        If something else than a section is found.
    """
    sections: list[Section] = []
    skipped: set[int] = set()
    inflated: dict[int, bytes] = {}
    position, end = start, len(source.data)
    start_after = start_finder(source)
    while position < end:
        try:
            section, content = _read_section(source, position, keep, start_after)
        except _CutOffError:
            return Index(tuple(sections), position, tuple(sorted(skipped)), inflated)
        if section.tag in (Tag.MESH, Tag.STATE):
            sections.append(section)
            if content:
                inflated[position] = content
                keep -= len(content)
        else:
            skipped.add(section.tag)
        position = section.offset + section.length
    return Index(tuple(sections), None, tuple(sorted(skipped)), inflated)


def open_section(
    source: Source, section: Section, kept: Mapping[int, bytes] = MappingProxyType({})
) -> tuple[Source, Chunk]:
    """Give the bytes of a section, inflated where they are compressed.

    Parameters
    ----------
    source : Source
        The file.
    section : Section
        The section.
    kept : mapping of int to bytes
        Sections that the index kept when it had inflated them.

    Returns
    -------
    source : Source
        Where the section's chunks are read from.
    chunk : Chunk
        The section.
    """
    if not section.compressed:
        return source, Chunk(section.tag, section.offset + HEADER_SIZE, section.size)
    content = kept[section.offset] if section.offset in kept else _inflate(source, section)
    return replace(source, data=content, stream_offset=section.offset), Chunk(
        section.tag, HEADER_SIZE, section.size
    )


def _inflate(source: Source, section: Section) -> bytes:
    stream = source.data[section.offset : section.offset + section.length]
    try:
        return inflate_exactly(stream, HEADER_SIZE + section.size)
    except (zlib.error, WrongSizeError) as error:
        raise source.error(f"damaged compressed data: {error}", section.offset, section.tag) from error


def _read_section(
    source: Source, position: int, keep: int, start_after: StartFinder
) -> tuple[Section, bytes]:
    left = len(source.data) - position
    if left < HEADER_SIZE:
        raise _CutOffError
    tag, size = PAIR[source.order].unpack_from(source.data, position)
    if tag not in (Tag.MESH, Tag.STATE):
        if is_zlib_start(source.data[position], source.data[position + 1]):
            return _read_compressed(source, position, keep, start_after)
        if tag == 0 and not np.frombuffer(source.data, np.uint8, offset=position).any():
            # A file system may have reserved room that the interrupted program never wrote to.
            raise _CutOffError
        if tag == 0 or size > left - HEADER_SIZE:
            raise source.error("neither a mesh, a state nor compressed data", position, tag)
    if size > left - HEADER_SIZE:
        raise _CutOffError
    chunk = Chunk(tag, position + HEADER_SIZE, size)
    head = _state_head(source, chunk) if tag == Tag.STATE else b""
    return Section(tag, position, HEADER_SIZE + size, size, compressed=False, head=head), b""


def _state_head(source: Source, state: Chunk) -> bytes:
    for child in children(source, state):
        if child.tag == Tag.STATE_HEADER:
            if child.size > LARGEST_STATE_HEADER:
                raise source.error_in(child, f"a state header of {child.size} bytes")
            return source.data[child.start : child.end]
    raise source.error_in(state, "a state without a header")


def _read_compressed(
    source: Source, position: int, keep: int, start_after: StartFinder
) -> tuple[Section, bytes]:
    inflater = Inflater(source.data, position)
    try:
        return _read_stream(replace(source, stream_offset=position), inflater, position, keep, start_after)
    except zlib.error as error:
        raise source.error(f"damaged compressed data: {error}", position) from error


def _read_stream(
    source: Source, inflater: Inflater, position: int, keep: int, start_after: StartFinder
) -> tuple[Section, bytes]:
    start = _read_exactly(source, inflater, HEADER_SIZE)
    tag, size = PAIR[source.order].unpack(start)
    total = HEADER_SIZE + size
    content, head = b"", b""
    if total <= keep:
        content = b"".join((start, *inflater.pieces(size)))
    elif tag == Tag.STATE:
        head = _stream_head(source, inflater, total)
    if not content and tag in (Tag.MESH, Tag.STATE):
        following = start_after(position)
        # Bytes that begin a raw section may lie within a stream that stores some of its content as it is.
        if following is not None and source.data[following] == ZLIB_FIRST:
            return Section(tag, position, following - position, size, compressed=True, head=head), b""
    inflater.skip(total - inflater.inflated)
    surplus = inflater.read(1)  # also takes in the checksum at the stream's end
    if not inflater.ended and not surplus:
        raise _CutOffError
    if surplus or inflater.inflated != total:
        found = "more" if surplus else str(inflater.inflated - HEADER_SIZE)
        raise source.error(f"a size of {size} bytes, but {found} are there", 0, tag)
    if content and tag == Tag.STATE:
        head = _state_head(replace(source, data=content), Chunk(tag, HEADER_SIZE, size))
    return Section(tag, position, inflater.end - position, size, compressed=True, head=head), content


def _stream_head(source: Source, inflater: Inflater, total: int) -> bytes:
    while inflater.inflated < total:
        position = inflater.inflated
        tag, size = PAIR[source.order].unpack(_read_exactly(source, inflater, HEADER_SIZE))
        if size > total - inflater.inflated:
            raise source.error(
                f"a size of {size} bytes where {total - inflater.inflated} are left", position, tag
            )
        if tag == Tag.STATE_HEADER:
            if size > LARGEST_STATE_HEADER:
                raise source.error(f"a state header of {size} bytes", position, tag)
            return _read_exactly(source, inflater, size)
        inflater.skip(size)
    raise source.error("a state without a header", 0, Tag.STATE)


def _read_exactly(source: Source, inflater: Inflater, count: int) -> bytes:
    position = inflater.inflated
    got = inflater.read(count)
    if len(got) < count:
        if inflater.ended:
            raise source.error(f"{count} bytes expected, {len(got)} found", position)
        raise _CutOffError
    return got
