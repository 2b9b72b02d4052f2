"""The mesh of a thick-walled cylinder: wedges at the axis, hexahedra around them, plane after plane."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from febio_io.feb.model import Floats, Frame, MeshSize, Vessel

Integers = NDArray[np.int64]


@dataclass(frozen=True)
class Facets:
    """Facets of one kind, nodes counter-clockwise seen from outside: FEBio's name, (n, n_nodes) from 1 on."""

    kind: str
    nodes: Integers


@dataclass(frozen=True, eq=False)
class TubeMesh:
    """Nodes and elements; all numbers count from 1.

    Attributes
    ----------
    nodes : (n_nodes, 3) float64 array
        Positions in FEBio's coordinates, m; in each plane the axis, then ring by ring from φ = 0 on.
    core : (n, 6) int64 array
        Wedges at the axis: around, then plane by plane.
    lumen : (n, 8) int64 array
        Hexahedra between those and the wall: outwards, then around, then plane by plane.
    wall : (n, 8) int64 array
        Hexahedra of the wall, likewise.
    axis, interface, inlet, across, along_zero : int64 arrays
        Nodes: on the axis; between lumen and wall; inside the lumen in the first plane; of the wall at
        φ = ±π/2; of the wall at φ = 0 and π.
    blood : int64 array
        Nodes of the lumen, the interface's among them.
    surfaces : dict of str to tuple of Facets
        "Inlet", "Outlet" and "Interface" of the lumen.
    """

    nodes: Floats
    core: Integers
    lumen: Integers
    wall: Integers
    axis: Integers
    interface: Integers
    inlet: Integers
    across: Integers
    along_zero: Integers
    blood: Integers
    surfaces: dict[str, tuple[Facets, ...]]


def radii(vessel: Vessel, size: MeshSize) -> Floats:
    """Radii of the rings of nodes, from the innermost to the outer face of the wall, m."""
    widths = np.geomspace(size.bias, 1.0, size.n_r)
    lumen = vessel.radius * np.cumsum(widths) / widths.sum()
    lumen[-1] = vessel.radius
    wall = vessel.radius + vessel.thickness * np.arange(1, size.n_wall + 1) / size.n_wall
    return np.concatenate([lumen, wall])


def tube_mesh(vessel: Vessel, size: MeshSize, frame: Frame) -> TubeMesh:
    """Make the mesh.

    Parameters
    ----------
    vessel, size, frame
        Sizes in m, numbers of elements, and where the artery lies.

    Returns
    -------
    TubeMesh
        The mesh.
    """
    numbers = _Numbering(size)
    sectors = np.arange(size.n_theta)
    core = np.column_stack([np.ones_like(sectors), numbers.node(1, sectors), numbers.node(1, sectors + 1)])
    inside, wall = numbers.quads(1, size.n_r), numbers.quads(size.n_r, size.n_r + size.n_wall)
    quarter = size.n_theta // 4
    across, along_zero = np.array([quarter, 3 * quarter]), np.array([0, 2 * quarter])
    wall_rings = np.arange(size.n_r, size.n_r + size.n_wall + 1)[:, np.newaxis]
    rings = np.arange(1, size.n_r + 1)[:, np.newaxis]
    lumen_plane = np.concatenate([[1], numbers.node(rings, sectors).ravel()])
    last = size.n_z * numbers.per_plane
    return TubeMesh(
        nodes=_positions(vessel, size, frame),
        core=numbers.swept(core),
        lumen=numbers.swept(inside),
        wall=numbers.swept(wall),
        axis=numbers.in_planes(np.array([1])),
        interface=numbers.in_planes(numbers.node(size.n_r, sectors)),
        inlet=lumen_plane[: -size.n_theta],
        across=numbers.in_planes(numbers.node(wall_rings, across).ravel()),
        along_zero=numbers.in_planes(numbers.node(wall_rings, along_zero).ravel()),
        blood=numbers.in_planes(lumen_plane),
        surfaces={
            "Inlet": (Facets("tri3", core[:, ::-1]), Facets("quad4", inside[:, ::-1])),
            "Outlet": (Facets("tri3", core + last), Facets("quad4", inside + last)),
            "Interface": (Facets("quad4", numbers.interface_quads()),),
        },
    )


@dataclass(frozen=True)
class _Numbering:
    """Numbers of nodes: plane by plane; in each the axis, then ring by ring."""

    size: MeshSize

    @property
    def per_plane(self) -> int:
        return 1 + self.size.n_theta * (self.size.n_r + self.size.n_wall)

    def node(self, ring: Integers | int, sector: Integers) -> Integers:
        """Nodes of the first plane; ring 1 is the innermost, sectors count from 0."""
        return np.asarray(2 + (ring - 1) * self.size.n_theta + sector % self.size.n_theta)

    def quads(self, first: int, last: int) -> Integers:
        """Faces of the first plane between two rings: outwards, then around."""
        sector, ring = np.meshgrid(np.arange(self.size.n_theta), np.arange(first, last), indexing="ij")
        corners = ((ring, sector), (ring + 1, sector), (ring + 1, sector + 1), (ring, sector + 1))
        return np.column_stack([self.node(*corner).ravel() for corner in corners])

    def interface_quads(self) -> Integers:
        """Faces between lumen and wall, seen from the wall: around, then plane by plane."""
        sectors = np.arange(self.size.n_theta)
        edge = np.column_stack([self.node(self.size.n_r, sectors), self.node(self.size.n_r, sectors + 1)])
        return self._in_each(np.hstack([edge, edge[:, ::-1] + self.per_plane]), self.size.n_z)

    def swept(self, faces: Integers) -> Integers:
        """Elements between each plane and the next, from faces of the first plane."""
        return self._in_each(np.hstack([faces, faces + self.per_plane]), self.size.n_z)

    def in_planes(self, nodes: Integers) -> Integers:
        """Repeat nodes of the first plane in all planes."""
        return self._in_each(nodes[:, np.newaxis], self.size.n_z + 1).ravel()

    def _in_each(self, first: Integers, count: int) -> Integers:
        shifts = self.per_plane * np.arange(count)[:, np.newaxis, np.newaxis]
        return np.asarray((first + shifts).reshape(-1, first.shape[1]))


def _positions(vessel: Vessel, size: MeshSize, frame: Frame) -> Floats:
    angles = 2.0 * np.pi * np.arange(size.n_theta) / size.n_theta
    # The quarters are exact, so that a node on a plane of symmetry lies on it.
    cosines, sines = np.cos(angles), np.sin(angles)
    quarter = size.n_theta // 4
    cosines[[quarter, 3 * quarter]], sines[[0, 2 * quarter]] = 0.0, 0.0
    rings = radii(vessel, size)[:, np.newaxis]
    plane = np.zeros((1 + rings.size * size.n_theta, 2))
    plane[1:, 0], plane[1:, 1] = (rings * cosines).ravel(), (rings * sines).ravel()
    along = vessel.length * np.arange(size.n_z + 1) / size.n_z
    local = np.empty((len(along), len(plane), 3))
    local[:, :, :2], local[:, :, 2] = plane, along[:, np.newaxis]
    return np.asarray(local.reshape(-1, 3) @ frame.rotation() + np.array(frame.origin))
