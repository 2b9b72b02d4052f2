"""Opens a plot file and answers what it holds."""

from collections.abc import Iterable
from functools import lru_cache
from os import PathLike
from pathlib import Path
from types import TracebackType
from typing import Self

import numpy as np

from cases.arrays import Flags, Singles
from febio_io.errors import FebioFileError, FebioKeyError
from febio_io.xplt.container import Chunk, Source
from febio_io.xplt.contents import read_contents
from febio_io.xplt.dictionary import SectionName, Variable
from febio_io.xplt.fields import (
    StateData,
    find_blocks,
    locate_variables,
    read_active_elements,
    regions_of,
    view_block,
)
from febio_io.xplt.index import open_section
from febio_io.xplt.lookup import find_region, find_state, find_variables
from febio_io.xplt.mesh import Mesh
from febio_io.xplt.mesh_reader import read_mesh
from febio_io.xplt.objects import ObjectState, read_object_states
from febio_io.xplt.root import map_file, read_root

STATES_KEPT = 4
KEEP_INFLATED = 512 << 20


def open_plot(path: str | PathLike[str], *, keep_inflated: int = KEEP_INFLATED) -> "Plot":
    """Open an FEBio plot file (.xplt).

    Only headers are read: the file is mapped into memory, and values are read when they are asked for.
    Compressed states must be inflated to find where each ends; the first of them are kept in memory, so that
    they need not be inflated again. Once no more may be kept, the next state is searched for by how it
    begins; damage of such states is then found when they, or those before, are read. A file that FEBio is
    still writing may be opened: the states complete by then are used. It must not be shortened or overwritten
    while it is open.

    Parameters
    ----------
    path : path-like
        The file.
    keep_inflated : int, optional
        Bytes of inflated states that may be kept while the file is open: half a gibibyte, unless given.

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
    return Plot(map_file(Path(path)), keep_inflated)


class Plot:
    """An open plot file; :func:`open_plot` makes it.

    Parameters
    ----------
    source : Source
        The mapped file.
    keep_inflated : int
        Bytes of inflated states that may be kept while the file is open.

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

    def __init__(self, source: Source, keep_inflated: int = KEEP_INFLATED) -> None:
        self._source: Source | None = source
        self.path = source.path
        root = read_root(source)
        self.version, self.software, self.units = root.version, root.software, root.units
        self.variables = root.variables
        contents = read_contents(source, root, keep_inflated)
        self._meshes, self._states = contents.meshes, contents.states
        self._mesh_numbers, self._inflated = contents.mesh_numbers, contents.inflated
        self.times, self.status, self.warnings = contents.times, contents.status, contents.warnings
        self.compressed = any(section.compressed for section in (*contents.meshes, *contents.states))
        self._open_state = lru_cache(STATES_KEPT)(self._locate_state)
        self._open_mesh = lru_cache(None)(self._read_mesh)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Let go of the file; arrays already read stay valid."""
        self._source, self._inflated = None, {}
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
        copy: bool = True,
    ) -> Singles:
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
        copy : bool, optional
            False for a read-only view of the file's own bytes, which costs nothing. It keeps the mapped file,
            or the inflated state, in memory for as long as it lives. Values of the other byte order are
            copied all the same.

        Returns
        -------
        float32 array
            The stored values, with a last axis of components unless the variable is a scalar.
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
        values = self._view(name, state, region, section)
        return values.copy() if copy else values

    def series(
        self,
        name: str | Variable,
        states: Iterable[int] | None = None,
        region: str | int | None = None,
        *,
        section: SectionName | None = None,
    ) -> Singles:
        """Read the values of one variable in one region over several states.

        Parameters
        ----------
        states : iterable of int, optional
            Numbers of the states; all, unless given.
        name, region, section
            As in :meth:`field`.

        Returns
        -------
        float32 array
            The values of :meth:`field`, with a first axis of states.

        Raises
        ------
        FebioKeyError
            If there is no such variable, state or region, or more than one; or if the states have different
            meshes, so that the shapes differ.
        FebioFormatError
            If the values' size is not what the variable and the mesh require.
        """
        numbers = range(self.n_states) if states is None else list(states)
        if not numbers:
            raise FebioKeyError(f"{self.path}: no states to read {name!r} in")
        first = self._view(name, numbers[0], region, section)
        series = np.empty((len(numbers), *first.shape), dtype=np.float32)
        for place, number in enumerate(numbers):
            values = self._view(name, number, region, section)
            if values.shape != first.shape:
                raise FebioKeyError(
                    f"{self.path}: states {numbers[0]} and {number} have different meshes; "
                    "read them one by one"
                )
            series[place] = values
        return series

    def active_elements(self, state: int) -> Flags:
        """Tell which elements take part in a state.

        Returns
        -------
        (n_elements,) bool array
            False for eroded elements; domain by domain, in the order of each domain's elements.

        Raises
        ------
        FebioKeyError
            If there is no such state.
        FebioFormatError
            If the state does not tell of as many elements as the mesh has.
        """
        number = find_state(self.path, self.n_states, state)
        return read_active_elements(self._open_state(number), self.mesh_of(number))

    def objects(self, state: int) -> tuple[ObjectState, ...]:
        """Give the rigid bodies, connectors and springs in a state; none where the state does not tell.

        Raises
        ------
        FebioKeyError
            If there is no such state.
        FebioFormatError
            If the objects contradict those of the first mesh.
        """
        data = self._open_state(find_state(self.path, self.n_states, state))
        return read_object_states(data.source, data.objects, self.mesh.objects) if data.objects else ()

    def _view(
        self, name: str | Variable, state: int, region: str | int | None, section: SectionName | None
    ) -> Singles:
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
        return view_block(data, variable, mesh, regions[number], block)

    def fields(self, variable: Variable, state: int) -> dict[int, Singles]:
        """View the values of one variable in one state, in all regions that have any.

        Parameters
        ----------
        variable : Variable
            One of the variables.
        state : int
            Number of the state, 0-based; negative numbers count from the end.

        Returns
        -------
        dict of int to float32 array
            Read-only values, shaped as those of :meth:`field`, by the number of the region; 0 for global and
            node variables.

        Raises
        ------
        FebioKeyError
            If there is no such variable or state.
        FebioFormatError
            If the values' size is not what the variable and the mesh require.
        """
        data, mesh, ((_, blocks),) = self._blocks(variable, state, None)
        regions = regions_of(variable, mesh)
        return {
            number: view_block(data, variable, mesh, regions[number], block)
            for number, block in blocks.items()
        }

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
        source, chunk = open_section(self._opened(), self._states[number], self._inflated)
        return locate_variables(source, chunk, number)

    def _read_mesh(self, number: int) -> Mesh:
        source, chunk = open_section(self._opened(), self._meshes[number], self._inflated)
        return read_mesh(source, chunk, self.version)

    def _opened(self) -> Source:
        if self._source is None:
            raise FebioFileError(f"{self.path}: the plot file has been closed")
        return self._source
