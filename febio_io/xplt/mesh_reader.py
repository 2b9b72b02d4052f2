"""Reads a mesh chunk: each list of equal chunks is viewed as one table."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from cases.arrays import Floats, Integers
from febio_io.xplt.container import Chunk, Source, children, children_by_tag, required
from febio_io.xplt.elements import ELEMENT_TYPES, ElementType
from febio_io.xplt.mesh import PADDING, Domain, Edge, ElementSet, Mesh, NodeSet, Part, Region, Surface
from febio_io.xplt.objects import read_objects
from febio_io.xplt.tags import Tag

VERSION_WITH_NODE_IDS = 0x33
LARGEST_FACE = 32  # FEBio writes up to 10 nodes a face
NODE_RECORD = np.dtype([("id", "i4"), ("position", "f4", (3,))])

T = TypeVar("T")
R = TypeVar("R", bound=Region)


@dataclass(frozen=True)
class _ItemTags:
    """Tags of one kind of list of faces or lines."""

    header: Tag
    id: Tag
    name: Tag
    count: Tag
    width: Tag
    list: Tag
    item: Tag


_SURFACE = _ItemTags(
    Tag.SURFACE_HEADER,
    Tag.SURFACE_ID,
    Tag.SURFACE_NAME,
    Tag.SURFACE_FACES,
    Tag.SURFACE_MAX_NODES,
    Tag.FACE_LIST,
    Tag.FACE,
)
_FACETSET = _ItemTags(
    Tag.FACETSET_HEADER,
    Tag.FACETSET_ID,
    Tag.FACETSET_NAME,
    Tag.FACETSET_SIZE,
    Tag.FACETSET_MAX_NODES,
    Tag.FACETSET_LIST,
    Tag.FACET,
)
_EDGE = _ItemTags(
    Tag.EDGE_HEADER,
    Tag.EDGE_ID,
    Tag.EDGE_NAME,
    Tag.EDGE_LINES,
    Tag.EDGE_MAX_NODES,
    Tag.EDGE_LIST,
    Tag.LINE,
)


def read_mesh(source: Source, mesh: Chunk, version: int) -> Mesh:
    """Read a mesh.

    Raises
    ------
    FebioFormatError
        If counts, sizes and node numbers do not agree.
    """
    sections = children_by_tag(source, mesh)
    node_ids, coordinates = _read_nodes(source, required(source, mesh, sections, Tag.NODE_SECTION), version)
    n_nodes = len(node_ids)

    def read_list(section: Tag, item: Tag, read: Callable[[Source, Chunk, int], T]) -> Iterator[T]:
        if section in sections:
            for child in children(source, sections[section]):
                if child.tag == item:
                    yield read(source, child, n_nodes)

    parts = tuple(read_list(Tag.PARTS_SECTION, Tag.PART, _read_part))
    objects = sections.get(Tag.OBJECTS_SECTION)
    part_names = {part.part_id: part.name for part in parts}
    domains: list[Domain] = []
    if Tag.DOMAIN_SECTION in sections:
        for child in children(source, sections[Tag.DOMAIN_SECTION]):
            if child.tag == Tag.DOMAIN:
                domains.append(_read_domain(source, child, n_nodes, len(domains) + 1, part_names))
    return Mesh(
        node_ids=node_ids,
        coordinates=coordinates,
        domains=tuple(domains),
        surfaces=_distinct(source, mesh, read_list(Tag.SURFACE_SECTION, Tag.SURFACE, _read_surface)),
        edges=_distinct(source, mesh, read_list(Tag.EDGE_SECTION, Tag.EDGE, _read_edge)),
        facet_sets=tuple(read_list(Tag.FACETSET_SECTION, Tag.FACETSET, _read_facet_set)),
        node_sets=tuple(read_list(Tag.NODESET_SECTION, Tag.NODESET, _read_node_set)),
        element_sets=tuple(read_list(Tag.ELEMENTSET_SECTION, Tag.ELEMENTSET, _read_element_set)),
        parts=parts,
        objects=read_objects(source, objects) if objects else (),
    )


def _distinct(source: Source, mesh: Chunk, regions: Iterator[R]) -> tuple[R, ...]:
    found = tuple(regions)
    if len({region.region for region in found}) != len(found):
        raise source.error_in(mesh, "two surfaces, or two edges, have the same number")
    return found


def _read_nodes(source: Source, section: Chunk, version: int) -> tuple[Integers, Floats]:
    parts = children_by_tag(source, section)
    header = required(source, section, parts, Tag.NODE_HEADER)
    sizes = children_by_tag(source, header)
    if Tag.NODE_DIM in sizes and (dimensions := source.integer(sizes[Tag.NODE_DIM])) != 3:
        raise source.error_in(header, f"nodes of {dimensions} dimensions; 3 are known")
    coordinates = required(source, section, parts, Tag.NODE_COORDS)
    records = source.array(coordinates, NODE_RECORD)
    _check_count(
        source,
        coordinates,
        "nodes",
        source.integer(required(source, header, sizes, Tag.NODE_SIZE)),
        len(records),
    )
    if version < VERSION_WITH_NODE_IDS:
        ids = np.arange(1, len(records) + 1)
    else:
        ids = records["id"].astype(np.int64)
    return ids, records["position"].astype(np.float64)


def _read_part(source: Source, part: Chunk, _n_nodes: int) -> Part:
    found = children_by_tag(source, part)
    name = source.fixed_text(found[Tag.PART_NAME]) if Tag.PART_NAME in found else ""
    return Part(source.integer(required(source, part, found, Tag.PART_ID)), name)


def _read_domain(
    source: Source, domain: Chunk, n_nodes: int, region: int, part_names: dict[int, str]
) -> Domain:
    found = children_by_tag(source, domain)
    header = required(source, domain, found, Tag.DOMAIN_HEADER)
    entries = children_by_tag(source, header)
    element_type = _element_type(source, required(source, header, entries, Tag.DOMAIN_ELEM_TYPE), region)
    part_id = source.integer(required(source, header, entries, Tag.DOMAIN_PART_ID))
    name = source.counted_text(entries[Tag.DOMAIN_NAME]) if Tag.DOMAIN_NAME in entries else ""
    elements = required(source, domain, found, Tag.ELEMENT_LIST)
    table = _equal_chunks(source, elements, Tag.ELEMENT, 1 + element_type.nodes)
    declared = source.integer(required(source, header, entries, Tag.DOMAIN_ELEMS))
    _check_count(source, elements, f"elements of domain {region}", declared, len(table))
    connectivity = table[:, 1:]
    _check_nodes(source, elements, connectivity, n_nodes)
    return Domain(
        region,
        name,
        part_id,
        part_names.get(part_id, ""),
        element_type,
        table[:, 0].copy(),
        connectivity.copy(),
    )


def _element_type(source: Source, chunk: Chunk, region: int) -> ElementType:
    code = source.integer(chunk)
    if code not in ELEMENT_TYPES:
        raise source.error_in(
            chunk, f"domain {region} has element type {code}; 0 to {max(ELEMENT_TYPES)} are known"
        )
    return ELEMENT_TYPES[code]


def _read_surface(source: Source, surface: Chunk, n_nodes: int) -> Surface:
    region, name, table = _read_items(source, surface, n_nodes, _SURFACE)
    return Surface(region, name, table[:, 0].copy(), table[:, 2:].copy())


def _read_facet_set(source: Source, facet_set: Chunk, n_nodes: int) -> Surface:
    region, name, table = _read_items(source, facet_set, n_nodes, _FACETSET)
    return Surface(region, name, table[:, 0].copy(), table[:, 2:].copy())


def _read_edge(source: Source, edge: Chunk, n_nodes: int) -> Edge:
    region, name, table = _read_items(source, edge, n_nodes, _EDGE)
    return Edge(region, name, table[:, 2:].copy())


def _read_items(source: Source, parent: Chunk, n_nodes: int, tags: _ItemTags) -> tuple[int, str, Integers]:
    found = children_by_tag(source, parent)
    header = required(source, parent, found, tags.header)
    entries = children_by_tag(source, header)
    region = source.integer(required(source, header, entries, tags.id))
    name = source.counted_text(entries[tags.name]) if tags.name in entries else ""
    width = source.integer(required(source, header, entries, tags.width))
    if not 0 <= width <= LARGEST_FACE:
        raise source.error_in(header, f"{name!r} with up to {width} nodes a face or line")
    items = found.get(tags.list, Chunk(tags.list, parent.end, 0))
    table = _equal_chunks(source, items, tags.item, 2 + width)
    declared = source.integer(required(source, header, entries, tags.count))
    _check_count(source, items, f"faces or lines of {name!r}", declared, len(table))
    counts, nodes = table[:, 1], table[:, 2:]
    if not ((counts >= 1) & (counts <= width)).all():
        raise source.error_in(items, f"{name!r} has a face or line without 1 to {width} nodes")
    used = np.arange(width) < counts[:, np.newaxis]
    _check_nodes(source, items, nodes[used], n_nodes)
    nodes[~used] = PADDING  # the file has uninitialised numbers there
    return region, name, table


def _read_node_set(source: Source, node_set: Chunk, n_nodes: int) -> NodeSet:
    tags = (Tag.NODESET_HEADER, Tag.NODESET_ID, Tag.NODESET_NAME, Tag.NODESET_SIZE, Tag.NODESET_LIST)
    set_id, name, nodes = _read_set(source, node_set, *tags)
    _check_nodes(source, node_set, nodes, n_nodes)
    return NodeSet(set_id, name, nodes)


def _read_element_set(source: Source, element_set: Chunk, _n_nodes: int) -> ElementSet:
    tags = (
        Tag.ELEMENTSET_HEADER,
        Tag.ELEMENTSET_ID,
        Tag.ELEMENTSET_NAME,
        Tag.ELEMENTSET_SIZE,
        Tag.ELEMENTSET_LIST,
    )
    return ElementSet(*_read_set(source, element_set, *tags))


def _read_set(
    source: Source, parent: Chunk, header_tag: Tag, id_tag: Tag, name_tag: Tag, size_tag: Tag, list_tag: Tag
) -> tuple[int, str, Integers]:
    found = children_by_tag(source, parent)
    header = required(source, parent, found, header_tag)
    entries = children_by_tag(source, header)
    name = source.counted_text(entries[name_tag]) if name_tag in entries else ""
    members = found.get(list_tag, Chunk(list_tag, parent.end, 0))
    numbers = source.array(members, "i4").astype(np.int64)
    declared = source.integer(required(source, header, entries, size_tag))
    _check_count(source, members, f"members of the set {name!r}", declared, len(numbers))
    return source.integer(required(source, header, entries, id_tag)), name, numbers


def _equal_chunks(source: Source, parent: Chunk, tag: Tag, columns: int) -> Integers:
    """Read a list of chunks of one tag and size as one table (n_chunks, columns)."""
    table = source.array(parent, "i4")
    if table.size % (2 + columns):
        raise source.error_in(
            parent, f"{parent.size} bytes are not a whole number of {tag.name}s of {columns} numbers"
        )
    table = table.reshape(-1, 2 + columns)
    if not ((table[:, 0] == tag) & (table[:, 1] == 4 * columns)).all():
        raise source.error_in(parent, f"not all are {tag.name}s of {columns} numbers")
    return table[:, 2:].astype(np.int64)


def _check_count(source: Source, chunk: Chunk, what: str, declared: int, found: int) -> None:
    if declared != found:
        raise source.error_in(chunk, f"{declared} {what} declared, {found} found")


def _check_nodes(source: Source, chunk: Chunk, nodes: Integers, n_nodes: int) -> None:
    if nodes.size and not 0 <= nodes.min() <= nodes.max() < n_nodes:
        wrong = nodes.min() if nodes.min() < 0 else nodes.max()
        raise source.error_in(chunk, f"node {wrong} of a mesh with {n_nodes} nodes")
