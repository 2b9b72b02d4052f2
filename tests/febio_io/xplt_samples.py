"""Small models in the writer's terms, shared by the tests of the plot-file reader."""

import numpy as np
from xplt_writer import DomainOf, FacesOf, Item, MeshOf, Writer, compressed

from febio_io.xplt.tags import Tag

CUBE = [4, 5, 6, 7, 0, 1, 2, 3]
MESH = MeshOf(
    coordinates=np.array(
        [[x, y, z] for z in (0, 1, 2) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], dtype=float
    ),
    domains=[
        DomainOf(0, [[11, *CUBE], [12, *range(4, 12)]], "Block", part=1),
        DomainOf(3, [[21, 3, 2, 1, 0]], None, part=2),
        DomainOf(4, [[31, 8, 9, 10], [32, 8, 10, 11]], None, part=2),
    ],
    surfaces=[FacesOf("Mixed", [[8, 9, 10], [3, 2, 1, 0]], 4), FacesOf("Empty", [], 4)],
    edges=[FacesOf("Rim", [[1, 0], [0, 3, 2]], 3)],
    node_sets={"Bottom": [0, 1, 2, 3]},
    element_sets={"Blocks": [11, 12]},
    parts={1: "Rubber", 2: "Cloth"},
)
SMALL_MESH = MeshOf(MESH.coordinates[:8], [DomainOf(0, [[1, *range(8)]], "Block")], parts={1: "Rubber"})
ITEMS = [
    Item("node", "displacement", "vec3f", "node", unit="L"),
    Item("domain", "pressure", "float", "item", unit="P"),
]


def state_values(number: int, n_nodes: int = 12) -> dict:
    """Values of ITEMS in one state: displacement counts up from 100 × number, pressure in domains 1 and 3."""
    return {
        ("node", 1): {0: 100.0 * number + np.arange(3 * n_nodes).reshape(n_nodes, 3)},
        ("domain", 1): {1: np.array([number, number + 0.5]), 3: np.array([-number, -number - 0.5])},
    }


def sample_sections(*, order: str = "<", zlib: bool = False, states: int = 3) -> list[bytes]:
    """Root, mesh and states of MESH and ITEMS, to be put into a file."""
    writer = Writer(order)
    written = [writer.state(0.1 * number, state_values(number)) for number in range(states)]
    if zlib:
        written = [compressed(state) for state in written]
    return [writer.root(ITEMS, compression=int(zlib)), writer.mesh(MESH), *written]


def sample_file(**options) -> bytes:
    return Writer(options.get("order", "<")).file(*sample_sections(**options))


def rich_file() -> bytes:
    """Write a file with objects, eroded elements, and values of every section and storage."""
    writer = Writer()
    items = [
        Item("global", "energy", "float", "node"),
        Item("node", "displacement", "vec3f", "node"),
        *(Item("domain", name, kind, name) for name, kind in (("node", "float"), ("mult", "mat3fs"))),
        Item("domain", "array", "array", "item", array_size=2, array_names=["a", "b"]),
        Item("surface", "flow", "float", "region"),
        Item("edge", "load", "array_vec3f", "item", array_size=1),
    ]
    place = [
        writer.integer(Tag.OBJECT_ID, 1),
        writer.counted(Tag.OBJECT_NAME, "Body"),
        writer.chunk(Tag.OBJECT_POSITION, writer.floats([0, 0, 0])),
        writer.chunk(Tag.OBJECT_ROTATION, writer.floats([0, 0, 0, 1])),
    ]
    force = writer.chunk(Tag.OBJECT_DATA, writer.item(Item("", "Force", "vec3f"))[8:])
    data = writer.chunk(Tag.OBJECT_DATA, writer.chunk(0, writer.floats([1, 2, 3])))
    objects = writer.chunk(Tag.OBJECTS_SECTION, writer.chunk(Tag.POINT_OBJECT, *place, force))
    values = {
        ("global", 1): {0: [1.0]},
        ("node", 1): {0: range(36)},
        ("domain", 1): {2: range(4)},
        ("domain", 2): {3: range(36)},
        ("domain", 3): {1: range(4)},
        ("surface", 1): {1: [5.0]},
        ("edge", 1): {1: range(6)},
    }
    state = writer.state(0, values)[8:]
    state += writer.chunk(Tag.MESH_STATE, writer.chunk(Tag.ELEMENT_STATE, writer.ints(1, 0, 1, 1, 1)))
    state += writer.chunk(Tag.OBJECTS_STATE, writer.chunk(Tag.POINT_OBJECT, *place, data))
    return writer.file(writer.root(items), writer.mesh(MESH, objects), writer.chunk(Tag.STATE, state))
