"""The start of a plot file: magic number, header and dictionary."""

import mmap
from dataclasses import dataclass
from pathlib import Path

from febio_io.errors import FebioFileError
from febio_io.files import open_file
from febio_io.xplt.container import HEADER_SIZE, PAIR, Chunk, Source, children_by_tag, required
from febio_io.xplt.dictionary import Variable, read_dictionary
from febio_io.xplt.tags import MAGIC, Tag

MAGIC_SIZE = 4
OLDEST_VERSION = 0x08


@dataclass(frozen=True)
class Root:
    """What a plot file says of itself.

    Attributes
    ----------
    version : int
        Version of the format.
    software : str
        The program that wrote the file; empty where it does not say.
    units : str or None
        System of units; None where the file has none.
    variables : tuple of Variable
        The variables, section by section.
    end : int
        First byte after the root chunk.
    """

    version: int
    software: str
    units: str | None
    variables: tuple[Variable, ...]
    end: int


def map_file(path: Path) -> Source:
    """Map a plot file into memory.

    Raises
    ------
    FebioFileError
        If the file cannot be opened or is no plot file.
    """
    try:
        with open_file(path) as file:
            if not file.seek(0, 2):
                raise FebioFileError(f"{path}: not an FEBio plot file: it is empty")
            data = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
    except OSError as error:
        raise FebioFileError(f"{path}: cannot be read: {error.strerror}") from error
    start = data[:MAGIC_SIZE]
    if start == MAGIC.to_bytes(MAGIC_SIZE, "little"):
        return Source(path, data, "<")
    if start == MAGIC.to_bytes(MAGIC_SIZE, "big"):
        return Source(path, data, ">")
    raise FebioFileError(f"{path}: not an FEBio plot file: it starts with {data[:5]!r}")


def read_root(source: Source) -> Root:
    """Read header and dictionary.

    Raises
    ------
    FebioFormatError
        If they are incomplete, or the version is that of the layout of FEBio 1 and 2.
    """
    root = _root_chunk(source)
    parts = children_by_tag(source, root)
    header = required(source, root, parts, Tag.HEADER)
    entries = children_by_tag(source, header)
    version = source.integer(required(source, header, entries, Tag.HDR_VERSION))
    if version < OLDEST_VERSION:
        raise source.error(
            f"version {version:#04x}, the layout of FEBio 1 and 2, is not supported; "
            f"versions from {OLDEST_VERSION:#04x} on are",
            header.start,
            Tag.HDR_VERSION,
        )
    return Root(
        version=version,
        software=source.counted_text(entries[Tag.HDR_SOFTWARE]) if Tag.HDR_SOFTWARE in entries else "",
        units=source.counted_text(entries[Tag.HDR_UNITS]) if Tag.HDR_UNITS in entries else None,
        variables=read_dictionary(source, parts[Tag.DICTIONARY]) if Tag.DICTIONARY in parts else (),
        end=root.end,
    )


def _root_chunk(source: Source) -> Chunk:
    start = MAGIC_SIZE + HEADER_SIZE
    if len(source.data) < start:
        raise source.error("the file is cut off before its header", len(source.data))
    tag, size = PAIR[source.order].unpack_from(source.data, MAGIC_SIZE)
    if tag != Tag.ROOT:
        raise source.error(f"the first chunk is not the root, {Tag.ROOT:#010x}", MAGIC_SIZE, tag)
    if size > len(source.data) - start:
        raise source.error("the file is cut off in its header", MAGIC_SIZE, tag)
    return Chunk(tag, start, size)
