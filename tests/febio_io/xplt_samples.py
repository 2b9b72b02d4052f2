"""Small models in the writer's terms, shared by the tests of the plot-file reader."""

import numpy as np
from xplt_writer import DomainOf, FacesOf, Item, MeshOf, Writer, compressed

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
