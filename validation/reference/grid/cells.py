"""Cells of VTK's types as the elements that the mapping interpolates in.

Quadratic tetrahedra, and hexahedra and wedges with nodes in all their faces, are cut into eight linear
elements each, so that every node counts; of other quadratic ones the corners are taken.
"""

from itertools import pairwise, product
from typing import NamedTuple

import numpy as np
import pyvista as pv

from cases.arrays import Flags, Floats, Integers
from validation.errors import UnusableReferenceError
from validation.mapping.elements import HEXAHEDRON, KIND_OF_VTK_TYPE, NODES, PYRAMID, TETRAHEDRON, WEDGE
from validation.mapping.mesh import KIND_NAMES, Block
from validation.reference.grid.contents import Grid

VOXEL = (0, 1, 3, 2, 4, 5, 7, 6)  # a hexahedron's nodes in a voxel's order
CORNERS = {25: HEXAHEDRON, 33: HEXAHEDRON, 26: WEDGE, 31: WEDGE, 27: PYRAMID}
AT_HALF = 0.25  # share of its length by which an edge's node may lie off its middle


class Elements(NamedTuple):
    """Elements of chosen cells: ``blocks`` by kind, ``cells`` (n_elements,) each one's cell, and notes."""

    blocks: list[Block]
    cells: Integers
    notes: tuple[str, ...]


def _tetrahedra_of_10() -> Integers:
    """Four corners, and the octahedron between cut along the edge from node 4 to node 9."""
    corners = [(0, 4, 6, 7), (4, 1, 5, 8), (6, 5, 2, 9), (7, 8, 9, 3)]
    ring = [5, 6, 7, 8]
    inner = [(4, a, b, 9) for a, b in zip(ring, [*ring[1:], ring[0]], strict=True)]
    points = np.array([[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    points = np.vstack([points, [[0, 0, 1], [1, 0, 1], [0, 1, 1]]])
    found = np.array(corners + inner)
    edges = points[found[:, 1:]] - points[found[:, :1]]
    turned = np.linalg.det(edges) < 0
    found[turned] = found[turned][:, [1, 0, 2, 3]]
    return found


def _hexahedra_of_27() -> Integers:
    """Eight on the lattice of 3 × 3 × 3 nodes."""
    bottom = {(0, 0): 0, (2, 0): 1, (2, 2): 2, (0, 2): 3, (1, 0): 8, (2, 1): 9, (1, 2): 10, (0, 1): 11}
    middle = {(0, 0): 16, (2, 0): 17, (2, 2): 18, (0, 2): 19, (1, 0): 22, (2, 1): 21, (1, 2): 23, (0, 1): 20}
    top = {(0, 0): 4, (2, 0): 5, (2, 2): 6, (0, 2): 7, (1, 0): 12, (2, 1): 13, (1, 2): 14, (0, 1): 15}
    levels = (bottom | {(1, 1): 24}, middle | {(1, 1): 26}, top | {(1, 1): 25})
    square = ((0, 0), (1, 0), (1, 1), (0, 1))
    return np.array(
        [
            [levels[k + up][i + a, j + b] for up in (0, 1) for a, b in square]
            for i, j, k in product((0, 1), repeat=3)
        ]
    )


def _wedges_of_18() -> Integers:
    """Four on each of the two levels."""
    levels = ((0, 1, 2, 6, 7, 8), (12, 13, 14, 15, 16, 17), (3, 4, 5, 9, 10, 11))
    triangles = ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5))
    return np.array(
        [
            [low[n] for n in three] + [high[n] for n in three]
            for low, high in pairwise(levels)
            for three in triangles
        ]
    )


# kind of the elements, and their nodes in the cell's
PIECES = {
    **{kind: (own, np.arange(NODES[own])[None, :]) for kind, own in KIND_OF_VTK_TYPE.items()},
    **{kind: (own, np.arange(NODES[own])[None, :]) for kind, own in CORNERS.items()},
    11: (HEXAHEDRON, np.array([VOXEL])),
    24: (TETRAHEDRON, _tetrahedra_of_10()),
    29: (HEXAHEDRON, _hexahedra_of_27()),
    32: (WEDGE, _wedges_of_18()),
}
# nodes at half of edges that begin at node 0, with the edges' ends: they tell a foreign order of nodes
HALVES = {24: ((4, 1), (6, 2), (7, 3)), 29: ((8, 1), (11, 3), (16, 4)), 32: ((6, 1), (8, 2), (12, 3))}


def elements_of(grid: Grid, chosen: Flags, what: str) -> Elements:
    """Elements of the chosen cells, of each type in the cells' order.

    Raises
    ------
    UnusableReferenceError
        For a type that the mapping cannot interpolate in, or nodes in another order than VTK's.
    """
    types = np.unique(grid.types[chosen])
    _refuse_unknown(grid, chosen, what)
    blocks, cells, notes = [], [], []
    for cell_type in types.tolist():
        which = np.flatnonzero(chosen & (grid.types == cell_type))
        kind, pieces = PIECES[cell_type]
        size = int(pieces.max()) + 1
        table = grid.nodes[grid.starts[which][:, None] + np.arange(max(size, _size(grid, which)))]
        _check_order(grid.points, table, cell_type)
        blocks.append(Block(kind, table[:, pieces].reshape(-1, pieces.shape[1])))
        cells.append(np.repeat(which, len(pieces)))
        if cell_type in CORNERS:
            notes.append(f"{what}: of {len(which)} {type_name(cell_type)} cells the corners are taken")
    return Elements(blocks, np.concatenate(cells), tuple(notes))


def _size(grid: Grid, which: Integers) -> int:
    return int(grid.starts[which[0] + 1] - grid.starts[which[0]])


def type_name(cell_type: int) -> str:
    """Name of a type of cells, as "quadratic tetra"."""
    return pv.CellType(cell_type).name.replace("_", " ").lower()


def _refuse_unknown(grid: Grid, chosen: Flags, what: str) -> None:
    types, counts = np.unique(grid.types[chosen], return_counts=True)
    odd = [(t, n) for t, n in zip(types.tolist(), counts.tolist(), strict=True) if t not in PIECES]
    if odd:
        found = ", ".join(f"{n} {type_name(t)}" for t, n in odd)
        solid = sum(counts) - sum(n for _, n in odd)
        beside = f" beside {solid} of other types" if solid else ""
        raise UnusableReferenceError(
            f"reference.{what}: cells of type {found}{beside}; allowed: {', '.join(KIND_NAMES.values())} and "
            "quadratic ones; others are left out where reference.lumen and reference.wall do not take them"
        )


def _check_order(points: Floats, table: Integers, cell_type: int) -> None:
    for middle, end in HALVES.get(cell_type, ()):
        first, last = points[table[:, 0]], points[table[:, end]]
        off = np.linalg.norm(points[table[:, middle]] - 0.5 * (first + last), axis=1)
        if np.any(off > AT_HALF * np.linalg.norm(last - first, axis=1)):
            raise UnusableReferenceError(
                f"nodes of {type_name(cell_type)} cells are not in VTK's order: node {middle + 1} of a "
                f"cell is not at half of its edge from node 1 to node {end + 1}"
            )
