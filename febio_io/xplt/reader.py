"""Opens a plot file and answers what it holds."""

from dataclasses import replace
from functools import lru_cache
from os import PathLike
from pathlib import Path
from types import TracebackType
from typing import Self

import numpy as np
from numpy.typing import NDArray

from febio_io.errors import FebioFileError, FebioFormatError, FebioKeyError
from febio_io.xplt.container import Chunk, Source, children_by_tag, required
from febio_io.xplt.dictionary import SectionName, Variable
from febio_io.xplt.fields import (
    StateData,
    Values,
    find_blocks,
    locate_variables,
    read_block,
    regions_of,
)
from febio_io.xplt.index import Section, open_section, read_index
from febio_io.xplt.lookup import find_region, find_state, find_variables
from febio_io.xplt.mesh import Mesh
from febio_io.xplt.mesh_reader import read_mesh
from febio_io.xplt.root import OLDEST_VERSION, map_file, read_root
from febio_io.xplt.tags import Tag

KNOWN_VERSIONS = (OLDEST_VERSION, *range(0x30, 0x36))
STATES_KEPT = 4


def open_plot(path: str | PathLike[str]) -> "Plot":
    """Open an FEBio plot file (.xplt).

    Only headers are read: the file is mapped into memory, and values are read when they are asked for.
    Compressed states are inflated once to find where each ends. A file that FEBio is still writing may be
    opened: the states complete by then are used. It must not be shortened or overwritten while it is open.

    Parameters
    ----------
    path : path-like
        The file.

    Returns
    -------
    Plot
        The open file; close it, or use it in a ``with`` statement.

    Raises
    ------
    FebioFileError
        If the file cannot be opened or is no plot file.
    FebioFormatError
        If its contents contradict the format.
    """
    return Plot(map_file(Path(path)))


class Plot:
    """An open plot file; :func:`open_plot` makes it.

    Parameters
    ----------
    source : Source
        The mapped file.

    Attributes
    ----------
    path : Path
        The file.
    version : int
        Version of the format, e.g. 0x35.
    software : str
        The program that wrote the file; empty where it does not say.
    units : str or None
        System of units, e.g. "SI"; None where the file has none.
    compressed : bool
        Whether any state or later mesh is compressed, whatever the header says.
    warnings : tuple of str
        What is odd about the file, e.g. that it is cut off.
    times : (n_states,) float64 array
        Time of each state, in the model's unit; stored in single precision.
    status : (n_states,) int64 array
        0: a converged step; 1: the first state of a new mesh; 2: written by another event, which does not
        mean that it is not converged. 0 throughout before file version 0x31.
    variables : tuple of Variable
        The variables, section by section.
    """

    def __init__(self, source: Source) -> None:
        self._source: Source | None = source
        self.path = source.path
        root = read_root(source)
        self.version, self.software, self.units = root.version, root.software, root.units
        self.variables = root.variables
        self._read_sections(source, root.end)
        self._open_state = lru_cache(STATES_KEPT)(self._locate_state)
        self._open_mesh = lru_cache(None)(self._read_mesh)

    def _read_sections(self, source: Source, start: int) -> None:
        index = read_index(source, start)
        self.compressed = any(section.compressed for section in index.sections)
        self._meshes = [section for section in index.sections if section.tag == Tag.MESH]
        self._states = [section for section in index.sections if section.tag == Tag.STATE]
        if not index.sections or index.sections[0].tag != Tag.MESH:
            cut = "the file is cut off in its mesh" if index.cut_at is not None else "the file has no mesh"
            raise source.error("a state before the first mesh" if self._states else cut, start)
        meshes_seen = np.cumsum([section.tag == Tag.MESH for section in index.sections])
        self._mesh_numbers = [
            int(seen) - 1
            for seen, section in zip(meshes_seen, index.sections, strict=True)
            if section.tag == Tag.STATE
        ]
        heads = [_read_head(source, section) for section in self._states]
        self.times: NDArray[np.float64] = np.array([time for time, _ in heads], dtype=np.float64)
        self.status: NDArray[np.int64] = np.array([status for _, status in heads], dtype=np.int64)
        self.warnings = tuple(self._oddities(index.cut_at is not None, index.skipped))

    def _oddities(self, cut_off: bool, skipped: tuple[int, ...]) -> list[str]:
        name, count = self.path.name, len(self._states)
        found = []
        if self.version not in KNOWN_VERSIONS:
            found.append(
                f"{name} has version {self.version:#04x}; "
                f"{KNOWN_VERSIONS[0]:#04x} and {KNOWN_VERSIONS[1]:#04x} to {KNOWN_VERSIONS[-1]:#04x} "
                "are known, and it is read as they are"
            )
        if skipped:
            tags = ", ".join(f"{tag:#010x}" for tag in skipped)
            found.append(f"{name} has chunks of an unknown kind, which are passed over: {tags}")
        if cut_off and not count:
            found.append(f"{name} is cut off in its first state: it has no complete state")
        elif cut_off:
            used = "1 complete state is used" if count == 1 else f"{count} complete states are used"
            found.append(f"{name} is cut off after state {count}: {used}")
        return found

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Let go of the file; arrays already read stay valid."""
        self._source = None
        self._open_state.cache_clear()

    @property
    def n_states(self) -> int:
        """Number of complete states."""
        return len(self._states)

    @property
    def mesh(self) -> Mesh:
        """The first mesh, which is that of state 0."""
        return self._open_mesh(0)

    @property
    def meshes(self) -> tuple[Mesh, ...]:
        """All meshes, in the file's order: more than one where FEBio remeshed."""
        return tuple(self._open_mesh(number) for number in range(len(self._meshes)))

    def mesh_of(self, state: int) -> Mesh:
        """Give the mesh that a state refers to.

        Raises
        ------
        FebioKeyError
            If there is no such state.
        FebioFormatError
            If the mesh contradicts the format.
        """
        return self._open_mesh(self._mesh_numbers[find_state(self.path, self.n_states, state)])

    def field(
        self,
        name: str | Variable,
        state: int,
        region: str | int | None = None,
        *,
        section: SectionName | None = None,
    ) -> Values:
        """Read the values of one variable in one state and region.

        Parameters
        ----------
        name : str or Variable
            The variable. Variables of one section and name count as one: FEBio writes them so for several
            surfaces.
        state : int
            Number of the state, 0-based; negative numbers count from the end.
        region : str or int, optional
            Name or number of the domain, surface or edge. Not needed for global and node variables and where
            only one region has values.
        section : str, optional
            Section of the variable, where variables of several sections have the name.

        Returns
        -------
        float32 array
            A copy of the stored values, with a last axis of components unless the variable is a scalar.
            Before it, node variables have the axis (n_nodes,), global variables none, others by storage:
            "node" (n_nodes of the region,) in the order of the region's `nodes`; "item" (n_items,), which
            are elements, faces or lines; "mult" (n_items, nodes_per_item); "region" none.

        Raises
        ------
        FebioKeyError
            If there is no such variable, state or region, or more than one.
        FebioFormatError
            If the values' size is not what the variable and the mesh require.
        """
        data, mesh, blocks = self._blocks(name, state, section)
        label = f"variable {blocks[0][0].name!r} in state {data.number}"
        regions = regions_of(blocks[0][0], mesh)
        present = {number for _, found in blocks for number in found}
        names = {key: value.name if value else "" for key, value in regions.items() if key in present}
        number = find_region(self.path, label, names, region)
        owners = [(variable, found[number]) for variable, found in blocks if number in found]
        if len(owners) > 1:
            raise FebioKeyError(
                f"{self.path}: {len(owners)} variables of this name have values in region {number}: "
                f"{label}; give one of Plot.variables instead of the name"
            )
        variable, block = owners[0]
        return read_block(data, variable, mesh, block)

    def regions(
        self, name: str | Variable, state: int, *, section: SectionName | None = None
    ) -> tuple[int, ...]:
        """Give the numbers of the regions in which a variable has values; 0 for global and node variables.

        Parameters are those of :meth:`field`.

        Raises
        ------
        FebioKeyError
            If there is no such variable or state.
        FebioFormatError
            If the values' size is not what the variable and the mesh require.
        """
        _, _, blocks = self._blocks(name, state, section)
        return tuple(sorted({number for _, found in blocks for number in found}))

    def _blocks(
        self, name: str | Variable, state: int, section: SectionName | None
    ) -> tuple[StateData, Mesh, list[tuple[Variable, dict[int, Chunk]]]]:
        variables = find_variables(self.path, self.variables, name, section)
        number = find_state(self.path, self.n_states, state)
        data, mesh = self._open_state(number), self.mesh_of(number)
        return data, mesh, [(variable, find_blocks(data, variable, mesh)) for variable in variables]

    def _locate_state(self, number: int) -> StateData:
        source, chunk = open_section(self._opened(), self._states[number])
        return locate_variables(source, chunk, number)

    def _read_mesh(self, number: int) -> Mesh:
        source, chunk = open_section(self._opened(), self._meshes[number])
        return read_mesh(source, chunk, self.version)

    def _opened(self) -> Source:
        if self._source is None:
            raise FebioFileError(f"{self.path}: the plot file has been closed")
        return self._source


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
