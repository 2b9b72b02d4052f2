"""One file with all that FEBio's test problems have: read whole, and written in every format."""

import meshio
import numpy as np
import pandas as pd
import pytest
import pyvista as pv
import xarray as xr
from numpy.testing import assert_array_equal
from xplt_writer import DomainOf, FacesOf, Item, MeshOf, Writer, compressed

import febio_io.views.meshio_format  # noqa: F401 - registers the format
from febio_io import to_pyvista, to_xarray
from febio_io.views.export import export_plot
from febio_io.xplt import ELEMENT_TYPES, open_plot
from febio_io.xplt.summary import summarize, summary_lines
from febio_io.xplt.tags import Tag

N_NODES = 40
FACES = (
    3,
    4,
    6,
    7,
    8,
    9,
    10,
)  # contact surfaces of any elements: tri3, quad4, tri6, tri7, quad8, quad9, tri10
STORAGES = ("node", "item", "mult", "region")
WIDTH = {
    "float": 1,
    "vec3f": 3,
    "mat3fs": 6,
    "mat3fd": 3,
    "tens4fs": 21,
    "mat3f": 9,
    "array": 2,
    "array_vec3f": 6,
}
TYPES = tuple(WIDTH)


def domains():
    """One of each element type, some of them without a name, and two without elements."""
    found = []
    for code, kind in ELEMENT_TYPES.items():
        name = None if kind.name.startswith(("quad", "tri", "line")) else f"Part {kind.name}"
        nodes = [list(range(first, first + kind.nodes)) for first in (0, 5)]
        found.append(
            DomainOf(code, [[2 * code + k + 1, *n] for k, n in enumerate(nodes)], name, part=code % 3)
        )
    return [*found, DomainOf(0, [], "Lost"), DomainOf(5, [], None)]


def distinct(lists):
    return len(set().union(*lists)) if lists else 0


def items():
    found = [
        Item("global", "kinetic energy", "float", "node"),
        Item("node", "displacement", "vec3f", "node", unit="L"),
    ]
    found += [Item("node", f"nodal {kind}", kind, "node", array_size=2) for kind in TYPES]
    for section in ("domain", "surface", "edge"):
        for storage in STORAGES:
            found += [Item(section, f"{storage} {kind}", kind, storage, array_size=2) for kind in TYPES]
    found += [Item("domain", "at points", "float", 4), Item("surface", "contact gap", "float", "item")]
    return [
        *found,
        Item("surface", "contact gap", "float", "item"),
        Item("domain", "n" * 64, "float", "region"),
    ]


def counts(section, mesh):
    """Of each region: nodes, items, nodes of an item."""
    if section == "domain":
        kinds = [ELEMENT_TYPES[domain.type_code] for domain in mesh.domains]
        return [
            (distinct([element[1:] for element in domain.elements]), len(domain.elements), kind.nodes)
            for domain, kind in zip(mesh.domains, kinds, strict=True)
        ]
    regions = mesh.surfaces if section == "surface" else mesh.edges
    return [(distinct(region.faces), len(region.faces), region.width) for region in regions]


def values(mesh, number):
    """Values of every variable in every second region that has items, none for some."""
    place, found = {}, {("global", 1): {0: [number]}}
    for item in items():
        place[item.section] = place.get(item.section, 0) + 1
        key, width = (item.section, place[item.section]), WIDTH[item.value_type]
        if item.section == "node":
            found[key] = {0: np.arange(len(mesh.coordinates) * width) + number}
        elif item.section != "global" and item.storage in STORAGES:
            blocks = {}
            for region, (nodes, n_items, of_item) in enumerate(counts(item.section, mesh), start=1):
                size = {"node": nodes, "item": n_items, "mult": n_items * of_item, "region": 1}[item.storage]
                if region % 2 == number % 2:
                    blocks[region] = np.arange(size * width) + number
            found[key] = blocks if "contact" not in item.name else {}
    return found


@pytest.fixture(scope="module")
def everything(tmp_path_factory):
    writer = Writer()
    coordinates = np.random.default_rng(0).random((N_NODES, 3))
    faces = [list(range(k, k + count)) for k, count in enumerate(FACES)]
    mesh = MeshOf(
        coordinates,
        domains(),
        surfaces=[FacesOf("Contact", faces, 10), FacesOf("", [], 0), FacesOf("Contact", [[1, 2, 3]], 4)],
        edges=[FacesOf("Rim", [[0, 1], [1, 2, 3]], 3)],
        node_sets={"None": [], "All": list(range(N_NODES))},
        element_sets={"Gone": [10**6]},
        parts={0: "Rigid", 1: "Cloth", 2: "Springs"},
        node_ids=list(range(100, 100 + N_NODES)),
    )
    coarse = MeshOf(coordinates[:8], [DomainOf(0, [[1, *range(8)]], "Block")])
    n_elements = sum(len(domain.elements) for domain in mesh.domains)
    states = []
    for number in (0, 1):
        flags = writer.chunk(Tag.ELEMENT_STATE, writer.ints(*(k % 3 > 0 for k in range(n_elements))))
        body = writer.state(0.5 * number, values(mesh, number))[8:]
        states.append(writer.chunk(Tag.STATE, body, writer.chunk(Tag.MESH_STATE, flags)))
    later = [
        compressed(writer.mesh(coarse)),
        compressed(writer.state(2, {("node", 1): {0: np.ones(24)}}, status=1)),
    ]
    path = tmp_path_factory.mktemp("everything") / "everything.xplt"
    path.write_bytes(writer.file(writer.root(items()), writer.mesh(mesh), *states, *later))
    return path, mesh


def test_all_of_it_is_read(everything):
    path, mesh = everything
    with open_plot(path) as plot:
        assert (plot.n_states, plot.warnings, len(plot.meshes)) == (3, (), 2)
        assert any("Contact" in line for line in summary_lines(summarize(plot)))
        for state in (0, 1):
            expected = values(mesh, state)
            for variable in plot.variables:
                if variable.storage in STORAGES:
                    blocks = plot.fields(variable, state)
                    written = expected[variable.section, variable.index]
                    assert sorted(blocks) == sorted(written)
                    for region, block in blocks.items():
                        assert_array_equal(block.ravel(), written[region])
            assert plot.active_elements(state).tolist() == [k % 3 > 0 for k in range(plot.mesh.n_elements)]
        assert "n" * 64 in {variable.name for variable in plot.variables}


def test_all_of_it_is_shown(everything):
    with open_plot(everything[0]) as plot:
        grid = to_pyvista(plot, 1, deformed=True)
        assert (grid.n_cells, grid.n_points) == (2 * len(ELEMENT_TYPES), N_NODES)
        for number, faces in ((1, len(FACES)), (2, 0), (3, 1)):
            assert to_pyvista(plot, 1, surface=number).n_cells == faces
        assert to_pyvista(plot, 1, edge="Rim").n_cells == 2
        assert to_xarray(plot, states=[0, 1]).sizes["element"] == 2 * len(ELEMENT_TYPES)
        assert to_xarray(plot, states=[2]).sizes["element"] == 1
    assert meshio.read(everything[0]).points.shape == (8, 3)


@pytest.mark.parametrize("file_format", ["vtu", "csv"])
def test_all_of_it_is_written_state_by_state(everything, tmp_path, file_format):
    with open_plot(everything[0]) as plot:
        export_plot(plot, tmp_path, file_format)
    if file_format == "vtu":
        assert pv.read(tmp_path / "everything_0001.vtu").n_cells == 2 * len(ELEMENT_TYPES)
        assert pv.read(tmp_path / "everything_0002.vtu").n_cells == 1
        assert pv.read(tmp_path / "everything_Contact_0000.vtu").n_cells in (1, len(FACES))
    else:
        table = pd.read_csv(tmp_path / "everything_item_float.csv", keep_default_na=False)
        assert set(table["state"]) == {0, 1}


@pytest.mark.parametrize("file_format", ["vtkhdf", "nc"])
def test_states_of_one_mesh_are_written_into_one_file(everything, tmp_path, file_format):
    with open_plot(everything[0]) as plot:
        export_plot(plot, tmp_path, file_format, states=[0, 1])
    if file_format == "nc":
        with xr.open_dataset(tmp_path / "everything.nc") as data:
            assert data.sizes["time"] == 2
    else:
        assert (tmp_path / "everything.vtkhdf").is_file()
