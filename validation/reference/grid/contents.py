"""What a library reads of one state: points, cells, named arrays, and which file or block each cell is of."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from cases.arrays import Floats, Integers
from validation.errors import UnusableReferenceError


class Piece(NamedTuple):
    """Where cells come from: the text of the case that names the file, and the block ("" without blocks)."""

    file: str
    block: str


class Grid(NamedTuple):
    """One state.

    Attributes
    ----------
    points : ndarray (n_points, 3)
        In the files' unit.
    types, starts, nodes : ndarray
        VTK types of the cells, (n_cells,); nodes of cell c are ``nodes[starts[c]:starts[c + 1]]``.
    of_points, of_cells : mapping of str to ndarray
        Arrays by name, a row for each point or cell; NaN where a piece lacks one.
    pieces : sequence of Piece
    piece : ndarray (n_cells,)
        Number of each cell's piece.
    """

    points: Floats
    types: Integers
    starts: Integers
    nodes: Integers
    of_points: Mapping[str, NDArray[Any]]
    of_cells: Mapping[str, NDArray[Any]]
    pieces: Sequence[Piece]
    piece: Integers


class GridFiles(Protocol):
    """Open files of a series; all raise an UnusableReferenceError that names the file."""

    @property
    def name(self) -> str:
        """File that messages name."""

    @property
    def software(self) -> str:
        """What tells of the program that wrote them, if anything does."""

    @property
    def times(self) -> Floats:
        """Times of the states, (n_states,), s."""

    def first(self) -> Grid:
        """Return the mesh with the arrays that tell its cells apart: of the first state there is."""

    def state(self, number: int) -> Grid:
        """Return a state, counted from 0."""

    def file_of(self, number: int) -> str:
        """Return the name of a state's file."""


def joined(grids: Sequence[Grid]) -> Grid:
    """Return several grids as one; what is coincident stays apart."""
    if len(grids) == 1:
        return grids[0]
    points_before = np.cumsum([0, *(len(grid.points) for grid in grids)])
    nodes_before = np.cumsum([0, *(len(grid.nodes) for grid in grids)])
    pieces_before = np.cumsum([0, *(len(grid.pieces) for grid in grids)])
    starts = [grid.starts[:-1] + before for grid, before in zip(grids, nodes_before[:-1], strict=True)]
    return Grid(
        np.concatenate([grid.points for grid in grids]),
        np.concatenate([grid.types for grid in grids]),
        np.append(np.concatenate(starts), nodes_before[-1]),
        np.concatenate([grid.nodes + before for grid, before in zip(grids, points_before, strict=False)]),
        _joined_arrays([grid.of_points for grid in grids], [len(grid.points) for grid in grids]),
        _joined_arrays([grid.of_cells for grid in grids], [len(grid.types) for grid in grids]),
        tuple(piece for grid in grids for piece in grid.pieces),
        np.concatenate([grid.piece + before for grid, before in zip(grids, pieces_before, strict=False)]),
    )


def _joined_arrays(arrays: list[Mapping[str, NDArray[Any]]], counts: list[int]) -> dict[str, NDArray[Any]]:
    found = {}
    for name in dict.fromkeys(name for each in arrays for name in each):
        shapes = {each[name].shape[1:] for each in arrays if name in each}
        if len(shapes) > 1:
            raise UnusableReferenceError(f"array {name!r} has as many components here as it has not there")
        width = shapes.pop()
        parts = [
            each.get(name, np.full((count, *width), np.nan))
            for each, count in zip(arrays, counts, strict=True)
        ]
        found[name] = np.concatenate(parts)
    return found
