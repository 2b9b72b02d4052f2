"""A small writer of plot files, for tests: every chunk by hand, so that each can also be wrong."""

import struct
import zlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from febio_io.xplt.tags import MAGIC, Tag

GARBAGE = 0x7FAB0001
HDR_COMPRESSION = 0x01010004  # FEBio writes it; each section tells by itself
TYPE_CODES = {
    "float": 0,
    "vec3f": 1,
    "mat3fs": 2,
    "mat3fd": 3,
    "tens4fs": 4,
    "mat3f": 5,
    "array": 6,
    "array_vec3f": 7,
}
STORAGE_CODES = {"node": 0, "item": 1, "mult": 2, "region": 3}
DICTIONARY_TAGS = {
    "global": Tag.DIC_GLOBAL,
    "node": Tag.DIC_NODE,
    "domain": Tag.DIC_DOMAIN,
    "surface": Tag.DIC_SURFACE,
    "edge": Tag.DIC_EDGE,
}
DATA_TAGS = {
    "global": Tag.GLOBAL_DATA,
    "node": Tag.NODE_DATA,
    "domain": Tag.DOMAIN_DATA,
    "surface": Tag.SURFACE_DATA,
    "edge": Tag.EDGE_DATA,
}


@dataclass
class Item:
    """One entry of the dictionary."""

    section: str
    name: str
    value_type: str | int = "float"
    storage: str | int = "item"
    array_size: int = 0
    array_names: Sequence[str] = ()
    unit: str | None = None


@dataclass
class DomainOf:
    type_code: int
    elements: Sequence[Sequence[int]]  # id, nodes
    name: str | None = None
    part: int = 1


@dataclass
class FacesOf:
    name: str
    faces: Sequence[Sequence[int]]
    width: int


@dataclass
class MeshOf:
    coordinates: np.ndarray
    domains: Sequence[DomainOf] = ()
    surfaces: Sequence[FacesOf] = ()
    edges: Sequence[FacesOf] = ()
    node_sets: dict[str, Sequence[int]] = field(default_factory=dict)
    element_sets: dict[str, Sequence[int]] = field(default_factory=dict)
    parts: dict[int, str] = field(default_factory=dict)
    node_ids: Sequence[int] | None = None


class Writer:
    """Makes the bytes of chunks in one byte order."""

    def __init__(self, order: Literal["<", ">"] = "<") -> None:
        self.order = order

    def chunk(self, tag: int, *payloads: bytes) -> bytes:
        payload = b"".join(payloads)
        return struct.pack(self.order + "II", tag, len(payload)) + payload

    def ints(self, *values: int) -> bytes:
        return struct.pack(f"{self.order}{len(values)}I", *(value & 0xFFFFFFFF for value in values))

    def floats(self, values: Iterable[float] | np.ndarray) -> bytes:
        return np.asarray(values, dtype=self.order + "f4").tobytes()

    def integer(self, tag: int, value: int) -> bytes:
        return self.chunk(tag, self.ints(value))

    def counted(self, tag: int, text: str) -> bytes:
        raw = text.encode()
        return self.chunk(tag, self.ints(len(raw)), raw)

    def fixed(self, tag: int, text: str) -> bytes:
        return self.chunk(tag, (text.encode() + b"\0" + b"\xff\x9d~garbage" * 8)[:64])

    def root(
        self,
        items: Sequence[Item] = (),
        *,
        version: int = 0x35,
        compression: int = 0,
        software: str | None = "Writer of tests",
        units: str | None = None,
    ) -> bytes:
        header = self.integer(Tag.HDR_VERSION, version) + self.integer(HDR_COMPRESSION, compression)
        if software is not None:
            header += self.counted(Tag.HDR_SOFTWARE, software)
        if units is not None:
            header += self.counted(Tag.HDR_UNITS, units)
        lists = b"".join(
            self.chunk(tag, *(self.item(item) for item in items if item.section == section))
            for section, tag in DICTIONARY_TAGS.items()
            if any(item.section == section for item in items)
        )
        return self.chunk(Tag.ROOT, self.chunk(Tag.HEADER, header), self.chunk(Tag.DICTIONARY, lists))

    def item(self, item: Item) -> bytes:
        value_type = TYPE_CODES.get(item.value_type, item.value_type)
        storage = STORAGE_CODES.get(item.storage, item.storage)
        return self.chunk(
            Tag.DIC_ITEM,
            self.integer(Tag.ITEM_TYPE, value_type),
            self.integer(Tag.ITEM_FORMAT, storage),
            self.integer(Tag.ITEM_ARRAY_SIZE, item.array_size),
            *(self.fixed(Tag.ITEM_ARRAY_NAME, name) for name in item.array_names),
            self.fixed(Tag.ITEM_NAME, item.name),
            self.fixed(Tag.ITEM_UNITS, item.unit) if item.unit else b"",
        )

    def mesh(self, mesh: MeshOf, *extra: bytes) -> bytes:
        n_nodes = len(mesh.coordinates)
        ids = mesh.node_ids or range(1, n_nodes + 1)
        nodes = b"".join(
            self.ints(node) + self.floats(place) for node, place in zip(ids, mesh.coordinates, strict=True)
        )
        header = self.integer(Tag.NODE_SIZE, n_nodes) + self.integer(Tag.NODE_DIM, 3)
        sections = [
            self.chunk(
                Tag.NODE_SECTION, self.chunk(Tag.NODE_HEADER, header), self.chunk(Tag.NODE_COORDS, nodes)
            ),
            self.chunk(Tag.DOMAIN_SECTION, *map(self.domain, mesh.domains)),
        ]
        if mesh.surfaces:
            numbered = list(enumerate(mesh.surfaces, start=1))
            sections += [
                self.chunk(Tag.SURFACE_SECTION, *(self.surface(k, item) for k, item in numbered)),
                self.chunk(Tag.FACETSET_SECTION, *(self.facet_set(k, item) for k, item in numbered)),
            ]
        if mesh.edges:
            edges = (self.edge(k, edge) for k, edge in enumerate(mesh.edges, start=1))
            sections.append(self.chunk(Tag.EDGE_SECTION, *edges))
        sections.append(self.chunk(Tag.NODESET_SECTION, *self.sets(mesh.node_sets, Tag.NODESET)))
        sections.append(self.chunk(Tag.ELEMENTSET_SECTION, *self.sets(mesh.element_sets, Tag.ELEMENTSET)))
        parts = (
            self.chunk(Tag.PART, self.integer(Tag.PART_ID, part), self.fixed(Tag.PART_NAME, name))
            for part, name in mesh.parts.items()
        )
        return self.chunk(Tag.MESH, *sections, self.chunk(Tag.PARTS_SECTION, *parts), *extra)

    def domain(self, domain: DomainOf) -> bytes:
        name = b"" if domain.name is None else self.counted(Tag.DOMAIN_NAME, domain.name)
        header = (
            self.integer(Tag.DOMAIN_ELEM_TYPE, domain.type_code),
            self.integer(Tag.DOMAIN_PART_ID, domain.part),
            self.integer(Tag.DOMAIN_ELEMS, len(domain.elements)),
            name,
        )
        elements = (self.chunk(Tag.ELEMENT, self.ints(*element)) for element in domain.elements)
        return self.chunk(
            Tag.DOMAIN, self.chunk(Tag.DOMAIN_HEADER, *header), self.chunk(Tag.ELEMENT_LIST, *elements)
        )

    def padded(self, tag: int, number: int, nodes: Sequence[int], width: int) -> bytes:
        padding = [GARBAGE] * (width - len(nodes))
        return self.chunk(tag, self.ints(number, len(nodes), *nodes, *padding))

    def surface(self, number: int, surface: FacesOf) -> bytes:
        header = (
            self.integer(Tag.SURFACE_ID, number),
            self.integer(Tag.SURFACE_FACES, len(surface.faces)),
            self.counted(Tag.SURFACE_NAME, surface.name),
            self.integer(Tag.SURFACE_MAX_NODES, surface.width),
        )
        faces = (
            self.padded(Tag.FACE, k, face, surface.width) for k, face in enumerate(surface.faces, start=1)
        )
        return self.chunk(
            Tag.SURFACE, self.chunk(Tag.SURFACE_HEADER, *header), self.chunk(Tag.FACE_LIST, *faces)
        )

    def facet_set(self, number: int, surface: FacesOf) -> bytes:
        header = (
            self.integer(Tag.FACETSET_ID, number),
            self.counted(Tag.FACETSET_NAME, surface.name),
            self.integer(Tag.FACETSET_SIZE, len(surface.faces)),
            self.integer(Tag.FACETSET_MAX_NODES, 10),
        )
        faces = (self.padded(Tag.FACET, k, face, 10) for k, face in enumerate(surface.faces, start=1))
        return self.chunk(
            Tag.FACETSET, self.chunk(Tag.FACETSET_HEADER, *header), self.chunk(Tag.FACETSET_LIST, *faces)
        )

    def edge(self, number: int, edge: FacesOf) -> bytes:
        header = (
            self.integer(Tag.EDGE_ID, number),
            self.integer(Tag.EDGE_LINES, len(edge.faces)),
            self.counted(Tag.EDGE_NAME, edge.name),
            self.integer(Tag.EDGE_MAX_NODES, edge.width),
        )
        lines = (self.padded(Tag.LINE, number, line, edge.width) for line in edge.faces)
        return self.chunk(Tag.EDGE, self.chunk(Tag.EDGE_HEADER, *header), self.chunk(Tag.EDGE_LIST, *lines))

    def sets(self, sets: dict[str, Sequence[int]], tag: Tag) -> list[bytes]:
        # Of both kinds the tags follow each other alike: header, number, name, size.
        return [
            self.chunk(
                tag,
                self.chunk(
                    tag + 1,
                    self.integer(tag + 2, number),
                    self.integer(tag + 4, len(members)),
                    self.counted(tag + 3, name),
                ),
                self.chunk(tag + 0x100, self.ints(*members)),
            )
            for number, (name, members) in enumerate(sets.items(), start=1)
        ]

    def state(
        self,
        time: float,
        data: dict[tuple[str, int], dict[int, np.ndarray]] | None = None,
        *,
        status: int | None = 0,
    ) -> bytes:
        """Write a state: values by (section, index), then by region."""
        header = self.chunk(Tag.STATE_TIME, self.floats([time]))
        if status is not None:
            header += self.integer(Tag.STATE_STATUS, status)
        sections = []
        for section, tag in DATA_TAGS.items():
            variables = [
                self.chunk(
                    Tag.STATE_VARIABLE,
                    self.integer(Tag.VARIABLE_ID, index),
                    self.chunk(
                        Tag.VARIABLE_DATA,
                        *(self.chunk(region, self.floats(values)) for region, values in blocks.items()),
                    ),
                )
                for (owner, index), blocks in (data or {}).items()
                if owner == section
            ]
            if variables:
                sections.append(self.chunk(tag, *variables))
        return self.chunk(
            Tag.STATE, self.chunk(Tag.STATE_HEADER, header), self.chunk(Tag.STATE_DATA, *sections)
        )

    def file(self, *sections: bytes) -> bytes:
        return self.ints(MAGIC) + b"".join(sections)


def compressed(section: bytes) -> bytes:
    return zlib.compress(section)
