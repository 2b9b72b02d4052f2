"""What a mesh is: nodes, domains, surfaces, edges, sets and parts."""

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from cases.arrays import Floats, Integers
from febio_io.xplt.elements import ElementType
from febio_io.xplt.objects import ModelObject

PADDING = -1


class Region(Protocol):
    """What a block of values belongs to: a domain, a surface or an edge."""

    @property
    def region(self) -> int:
        """Number by which blocks refer to it."""

    @property
    def name(self) -> str:
        """Name; empty where the file has none."""

    @property
    def n_items(self) -> int:
        """Elements, faces or lines."""

    @property
    def nodes_per_item(self) -> int:
        """Nodes of an item, padding included."""

    @property
    def nodes(self) -> Integers:
        """Nodes in the order of their first appearance."""


def first_appearances(nodes: Integers) -> Integers:
    """Keep each value once, in the order of first appearance.

    Parameters
    ----------
    nodes : (n,) int64 array
        Values ≥ 0.

    Returns
    -------
    (m,) int64 array
        The distinct values.
    """
    if not nodes.size:
        return nodes
    first = np.empty(int(nodes.max()) + 1, dtype=np.int64)
    places = np.arange(nodes.size)
    # Written backwards: where a value repeats, the last write, which is its first place, stays.
    first[nodes[::-1]] = places[::-1]
    distinct: Integers = nodes[first[nodes] == places]
    return distinct


@dataclass(frozen=True, eq=False)
class Domain:
    """Elements of one type and one part.

    Attributes
    ----------
    region : int
        1-based place among the domains.
    name : str
        Name; empty where the file has none (shells, beams).
    part_id : int
        Number of its part; several domains may share one.
    part_name : str
        Name of the part, which is the material's; empty where the file has none.
    element_type : ElementType
        Type of all its elements.
    element_ids : (n_elements,) int64 array
        Element numbers of the FEBio model.
    connectivity : (n_elements, n_nodes) int64 array
        Places of each element's nodes in the mesh's node list, 0-based.
    """

    region: int
    name: str
    part_id: int
    part_name: str
    element_type: ElementType
    element_ids: Integers
    connectivity: Integers

    @property
    def n_items(self) -> int:
        """Number of elements."""
        return len(self.connectivity)

    @property
    def nodes_per_item(self) -> int:
        """Nodes of an element."""
        return self.element_type.nodes

    @cached_property
    def nodes(self) -> Integers:
        """Nodes in the order in which values of storage "node" are stored: of first appearance."""
        return first_appearances(self.connectivity.ravel())


@dataclass(frozen=True, eq=False)
class Surface:
    """Faces of one surface, or of one facet set.

    Attributes
    ----------
    region : int
        Number of the surface.
    name : str
        Name; empty where the file has none.
    face_ids : (n_faces,) int64 array
        Numbers of the faces.
    faces : (n_faces, n_nodes) int64 array
        Places of each face's nodes in the mesh's node list, 0-based; −1 after a smaller face's last node.
    """

    region: int
    name: str
    face_ids: Integers
    faces: Integers

    @property
    def n_items(self) -> int:
        """Number of faces."""
        return len(self.faces)

    @property
    def nodes_per_item(self) -> int:
        """Nodes of the largest face the surface could have, to which values of storage "mult" are padded."""
        return int(self.faces.shape[1])

    @cached_property
    def nodes(self) -> Integers:
        """Nodes in the order in which values of storage "node" are stored: of first appearance."""
        return first_appearances(self.faces[self.faces != PADDING])


@dataclass(frozen=True, eq=False)
class Edge:
    """Lines of one edge.

    Attributes
    ----------
    region : int
        Number of the edge.
    name : str
        Name; empty where the file has none.
    lines : (n_lines, n_nodes) int64 array
        Places of each line's nodes in the mesh's node list, 0-based; −1 after a smaller line's last node.
    """

    region: int
    name: str
    lines: Integers

    @property
    def n_items(self) -> int:
        """Number of lines."""
        return len(self.lines)

    @property
    def nodes_per_item(self) -> int:
        """Nodes to which values of storage "mult" are padded."""
        return int(self.lines.shape[1])

    @cached_property
    def nodes(self) -> Integers:
        """Nodes in the order in which values of storage "node" are stored: of first appearance."""
        return first_appearances(self.lines[self.lines != PADDING])


@dataclass(frozen=True, eq=False)
class NodeSet:
    """A named set of nodes: 0-based places in the mesh's node list."""

    set_id: int
    name: str
    nodes: Integers


@dataclass(frozen=True, eq=False)
class ElementSet:
    """A named set of elements: element numbers of the FEBio model."""

    set_id: int
    name: str
    element_ids: Integers


@dataclass(frozen=True)
class Part:
    """A part, which FEBio names after its material."""

    part_id: int
    name: str


@dataclass(frozen=True, eq=False)
class Mesh:
    """One mesh of a plot file.

    Attributes
    ----------
    node_ids : (n_nodes,) int64 array
        Node numbers of the FEBio model; 1-based places before file version 0x33, which does not store them.
    coordinates : (n_nodes, 3) float64 array
        Reference positions, in the file's unit of length.
    domains, surfaces, edges, facet_sets, node_sets, element_sets, parts : tuple
        What else the mesh has, in the file's order.
    objects : tuple of ModelObject
        Rigid bodies, connectors and springs; only the first mesh of a file has them.
    """

    node_ids: Integers
    coordinates: Floats
    domains: tuple[Domain, ...] = ()
    surfaces: tuple[Surface, ...] = ()
    edges: tuple[Edge, ...] = ()
    facet_sets: tuple[Surface, ...] = ()
    node_sets: tuple[NodeSet, ...] = ()
    element_sets: tuple[ElementSet, ...] = ()
    parts: tuple[Part, ...] = ()
    objects: tuple[ModelObject, ...] = ()

    @property
    def n_elements(self) -> int:
        """Elements of all domains."""
        return sum(domain.n_items for domain in self.domains)
