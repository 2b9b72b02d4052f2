"""The mesh of a thick-walled cylinder: a cross-section, swept along the axis."""

from dataclasses import dataclass

import numpy as np

from cases.arrays import Floats, Integers
from febio_io.feb.cross_section import CrossSection, cross_section
from febio_io.feb.model import Frame, MeshSize, Vessel

FACET_KINDS = {3: "tri3", 4: "quad4"}
ELEMENT_KINDS = {6: "penta6", 8: "hex8"}


@dataclass(frozen=True)
class Facets:
    """Facets of one kind, nodes counter-clockwise seen from outside: (n, 3 or 4), from 1 on."""

    nodes: Integers

    @property
    def kind(self) -> str:
        """FEBio's name."""
        return FACET_KINDS[self.nodes.shape[1]]


@dataclass(frozen=True, eq=False)
class TubeMesh:
    """Nodes and elements; all numbers count from 1.

    Attributes
    ----------
    nodes : (n_nodes, 3) float64 array
        Positions in FEBio's coordinates, m, plane by plane.
    core : (n, 6 or 8) int64 array
        Elements at the axis, plane by plane.
    lumen : (n, 8) int64 array
        Elements between those and the wall: outwards, then around, then plane by plane.
    wall : (n, 8) int64 array
        Elements of the wall, likewise.
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


def tube_mesh(vessel: Vessel, size: MeshSize, frame: Frame) -> TubeMesh:
    """Make the mesh.

    Parameters
    ----------
    vessel, size, frame
        Sizes in m, numbers of elements, and where the artery lies.
    """
    section = cross_section(vessel, size)
    sweep = _Sweep(len(section.points), size.n_z)
    lumen_rings, wall_rings = section.rings[: section.interface + 1], section.rings[section.interface :]
    lumen, wall = _quads(lumen_rings), _quads(wall_rings)
    inside = np.setdiff1d(np.arange(1, section.rings[section.interface, 0]), section.rings[section.interface])
    lumen_plane = np.concatenate([inside, section.rings[section.interface]])
    quarter = size.n_theta // 4
    last = size.n_z * sweep.per_plane
    return TubeMesh(
        nodes=_positions(section, vessel, size, frame),
        core=sweep.solids(section.core),
        lumen=sweep.solids(lumen),
        wall=sweep.solids(wall),
        axis=sweep.in_planes(np.array([section.axis])),
        interface=sweep.in_planes(section.rings[section.interface]),
        inlet=inside,
        across=sweep.in_planes(wall_rings[:, [quarter, 3 * quarter]].ravel()),
        along_zero=sweep.in_planes(wall_rings[:, [0, 2 * quarter]].ravel()),
        blood=sweep.in_planes(lumen_plane),
        surfaces={
            "Inlet": (Facets(section.core[:, ::-1]), Facets(lumen[:, ::-1])),
            "Outlet": (Facets(section.core + last), Facets(lumen + last)),
            "Interface": (Facets(sweep.sides(section.rings[section.interface])),),
        },
    )


def _quads(rings: Integers) -> Integers:
    """Faces between rings: outwards, then around."""
    inner, outer = rings[:-1].T, rings[1:].T
    corners = (inner, outer, np.roll(outer, -1, axis=0), np.roll(inner, -1, axis=0))
    return np.column_stack([corner.ravel() for corner in corners])


def _positions(section: CrossSection, vessel: Vessel, size: MeshSize, frame: Frame) -> Floats:
    along = vessel.length * np.arange(size.n_z + 1) / size.n_z
    local = np.empty((len(along), len(section.points), 3))
    local[:, :, :2], local[:, :, 2] = section.points, along[:, np.newaxis]
    return np.asarray(local.reshape(-1, 3) @ frame.rotation() + np.array(frame.origin))


@dataclass(frozen=True)
class _Sweep:
    """Repeats what is in the first plane: nodes of a plane, and planes but one."""

    per_plane: int
    n_z: int

    def solids(self, faces: Integers) -> Integers:
        """Elements between each plane and the next, from faces of the first plane."""
        return self._in_each(np.hstack([faces, faces + self.per_plane]), self.n_z)

    def sides(self, ring: Integers) -> Integers:
        """Faces between each plane and the next along a ring: around, then plane by plane."""
        edge = np.column_stack([ring, np.roll(ring, -1)])
        return self._in_each(np.hstack([edge, edge[:, ::-1] + self.per_plane]), self.n_z)

    def in_planes(self, nodes: Integers) -> Integers:
        """Repeat nodes of the first plane in all planes."""
        return self._in_each(nodes[:, np.newaxis], self.n_z + 1).ravel()

    def _in_each(self, first: Integers, count: int) -> Integers:
        shifts = self.per_plane * np.arange(count)[:, np.newaxis, np.newaxis]
        return np.asarray((first + shifts).reshape(-1, first.shape[1]))
