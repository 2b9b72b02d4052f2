"""The list of a file's meshes and states, with the times, and what is odd about it."""

from dataclasses import dataclass, replace

import numpy as np

from cases.arrays import Floats, Integers
from febio_io.errors import FebioFormatError
from febio_io.xplt.container import Chunk, Source, children_by_tag, required
from febio_io.xplt.index import Index, Section, read_index
from febio_io.xplt.root import OLDEST_VERSION, Root
from febio_io.xplt.tags import Tag

KNOWN_VERSIONS = (OLDEST_VERSION, *range(0x30, 0x36))


@dataclass(frozen=True, eq=False)
class Contents:
    """What follows the root chunk.

    Attributes
    ----------
    meshes, states : tuple of Section
        Where they lie.
    mesh_numbers : tuple of int
        Number of each state's mesh, 0-based.
    times : (n_states,) float64 array
        Time of each state.
    status : (n_states,) int64 array
        Status of each state.
    warnings : tuple of str
        What is odd about the file.
    inflated : dict of int to bytes
        Inflated sections that are kept, by offset.
    """

    meshes: tuple[Section, ...]
    states: tuple[Section, ...]
    mesh_numbers: tuple[int, ...]
    times: Floats
    status: Integers
    warnings: tuple[str, ...]
    inflated: dict[int, bytes]


def read_contents(source: Source, root: Root, keep_inflated: int) -> Contents:
    """List the meshes and states.

    Parameters
    ----------
    source : Source
        The file.
    root : Root
        Its root chunk.
    keep_inflated : int
        Bytes of inflated sections that may be kept.

    Raises
    ------
    FebioFormatError
        If something else is found, no mesh comes first, or a state has no time.
    """
    index = read_index(source, root.end, keep_inflated)
    sections = index.sections
    states = tuple(section for section in sections if section.tag == Tag.STATE)
    if not sections or sections[0].tag != Tag.MESH:
        cut = "the file is cut off in its mesh" if index.cut_at is not None else "the file has no mesh"
        raise source.error("a state before the first mesh" if states else cut, root.end)
    meshes_seen = np.cumsum([section.tag == Tag.MESH for section in sections])
    heads = [_read_head(source, section) for section in states]
    return Contents(
        meshes=tuple(section for section in sections if section.tag == Tag.MESH),
        states=states,
        mesh_numbers=tuple(
            int(seen) - 1
            for seen, section in zip(meshes_seen, sections, strict=True)
            if section.tag == Tag.STATE
        ),
        times=np.array([time for time, _ in heads], dtype=np.float64),
        status=np.array([status for _, status in heads], dtype=np.int64),
        warnings=tuple(_oddities(source.path.name, root.version, index, len(states))),
        inflated=index.inflated,
    )


def _oddities(name: str, version: int, index: Index, n_states: int) -> list[str]:
    found = []
    if version not in KNOWN_VERSIONS:
        found.append(
            f"{name} has version {version:#04x}; "
            f"{KNOWN_VERSIONS[0]:#04x} and {KNOWN_VERSIONS[1]:#04x} to {KNOWN_VERSIONS[-1]:#04x} "
            "are known, and it is read as they are"
        )
    if index.skipped:
        tags = ", ".join(f"{tag:#010x}" for tag in index.skipped)
        found.append(f"{name} has chunks of an unknown kind, which are passed over: {tags}")
    if index.cut_at is not None and not n_states:
        found.append(f"{name} is cut off in its first state: it has no complete state")
    elif index.cut_at is not None:
        used = "1 complete state is used" if n_states == 1 else f"{n_states} complete states are used"
        found.append(f"{name} is cut off after state {n_states}: {used}")
    return found


def _read_head(source: Source, section: Section) -> tuple[float, int]:
    head = replace(source, data=section.head)
    whole = Chunk(Tag.STATE_HEADER, 0, len(section.head))
    try:
        found = children_by_tag(head, whole)
        time = head.real(required(head, whole, found, Tag.STATE_TIME))
        status = head.integer(found[Tag.STATE_STATUS]) if Tag.STATE_STATUS in found else 0
    except FebioFormatError as error:
        # The offset within the header alone would mislead; that of the state does not.
        raise source.error(
            "the state's header lacks its time or is damaged", section.offset, Tag.STATE
        ) from error
    return time, status
