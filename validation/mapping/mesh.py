"""The reference's mesh as the mapping needs it: lumen elements, lumen–wall interface, inlet and outlet."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cases.arrays import Floats, Integers
from validation.errors import UnusableReferenceError
from validation.mapping.elements import FACES, HEXAHEDRON, NODES, PYRAMID, TETRAHEDRON, WEDGE
from validation.mapping.interpolation import Topology, topology

KIND_NAMES = {HEXAHEDRON: "hex8", WEDGE: "penta6", TETRAHEDRON: "tet4", PYRAMID: "pyra5"}


@dataclass(frozen=True)
class Block:
    """Elements of one kind: ``nodes`` (n, nodes of the kind), indices into the mesh's coordinates."""

    kind: int
    nodes: Integers


@dataclass(frozen=True)
class LumenMesh:
    """The lumen and its boundary.

    Attributes
    ----------
    coordinates : ndarray (n_nodes, 3)
        Reference coordinates in the artery's frame, m.
    lumen : Topology
        Lumen elements, in the order of the blocks given.
    interface, inlet, outlet : ndarray (n_f, 4)
        Boundary faces of the lumen, normal outwards; triangles repeat their last node.
    lumen_nodes, interface_nodes : ndarray (m,)
        Nodes of the lumen and of the interface, sorted.
    length : float
        Extent along the axis, m.
    """

    coordinates: Floats
    lumen: Topology
    interface: Integers
    inlet: Integers
    outlet: Integers
    lumen_nodes: Integers
    interface_nodes: Integers
    length: float


def block_faces(block: Block) -> Integers:
    """All faces of a block's elements, (n · faces, 4), triangles with their last node repeated."""
    corners = np.array([face if len(face) == 4 else (*face, face[-1]) for face in FACES[block.kind]])
    return np.asarray(block.nodes[:, corners].reshape(-1, 4))


def _keys(faces: Integers) -> NDArray[np.void]:
    """One comparable key per face, whatever its orientation."""
    corners = faces.copy()
    corners[faces[:, 2] == faces[:, 3], 3] = -1  # a triangle, whichever of its nodes stands last
    ordered = np.sort(corners, axis=1)
    return ordered.view(np.dtype((np.void, ordered.itemsize * 4))).ravel()


def boundary_faces(blocks: Iterable[Block]) -> Integers:
    """Faces that belong to one element only, (n_f, 4), normals outwards."""
    faces = np.concatenate([block_faces(block) for block in blocks])
    _, inverse, counts = np.unique(_keys(faces), return_inverse=True, return_counts=True)
    return np.asarray(faces[counts[inverse] == 1])


def padded(blocks: Iterable[Block]) -> tuple[Integers, Integers]:
    """Kinds (n_e,) and nodes (n_e, 8), padded with −1, of all blocks in order."""
    kinds, nodes = [], []
    for block in blocks:
        count = len(block.nodes)
        rows = np.full((count, 8), -1, dtype=np.int64)
        rows[:, : NODES[block.kind]] = block.nodes
        kinds.append(np.full(count, block.kind, dtype=np.int64))
        nodes.append(rows)
    return np.concatenate(kinds), np.concatenate(nodes)


def _shared(boundary: Integers, wall: list[Block]) -> Integers:
    """Faces of the lumen's boundary that belong to the wall too."""
    return boundary[np.isin(_keys(boundary), np.unique(_keys(boundary_faces(wall))))]


def _other_than(boundary: Integers, *ends: Integers) -> Integers:
    """Faces of the lumen's boundary that are not at its ends."""
    return boundary[~np.isin(_keys(boundary), _keys(np.concatenate(ends)))]


def lumen_mesh(coordinates: Floats, lumen: list[Block], wall: list[Block]) -> LumenMesh:
    """Find the boundary of the lumen.

    Parameters
    ----------
    coordinates : ndarray (n_nodes, 3)
        Reference coordinates in the artery's frame (x along the axis from the inlet), m.
    lumen, wall : list of Block
        Elements of blood and of wall, which share the interface's nodes. Without wall elements the interface
        is the lumen's surface between its ends.

    Raises
    ------
    UnusableReferenceError
        If lumen and wall share no face, or inlet or outlet has none.
    """
    boundary = boundary_faces(lumen)
    kinds, nodes = padded(lumen)
    lumen_nodes = np.unique(nodes[nodes >= 0])
    along = coordinates[lumen_nodes, 0]
    first, last = float(along.min()), float(along.max())
    tolerance = 1e-6 * (last - first)
    face_x = coordinates[boundary, 0]
    inlet = boundary[np.all(np.abs(face_x - first) < tolerance, axis=1)]
    outlet = boundary[np.all(np.abs(face_x - last) < tolerance, axis=1)]
    for name, faces in (("inlet", inlet), ("outlet", outlet)):
        if not len(faces):
            raise UnusableReferenceError(f"the lumen has no plane {name} across the artery's axis")
    interface = _shared(boundary, wall) if wall else _other_than(boundary, inlet, outlet)
    if not len(interface):
        raise UnusableReferenceError("lumen and wall elements share no face: no lumen–wall interface")
    return LumenMesh(
        coordinates=coordinates,
        lumen=topology(kinds, nodes, len(coordinates)),
        interface=interface,
        inlet=inlet,
        outlet=outlet,
        lumen_nodes=lumen_nodes,
        interface_nodes=np.unique(interface),
        length=last - first,
    )
