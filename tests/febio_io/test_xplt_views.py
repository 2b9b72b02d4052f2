"""Plot files as labelled arrays, meshes with values, and meshes of meshio."""

import tomllib
from importlib.metadata import EntryPoint
from pathlib import Path

import meshio
import numpy as np
import pytest
import pyvista as pv
from numpy.testing import assert_allclose, assert_array_equal
from xplt_samples import ITEMS, MESH, SMALL_MESH, sample_file, sample_sections, state_values
from xplt_writer import DomainOf, FacesOf, Item, MeshOf, Writer

import febio_io.views.meshio_format  # noqa: F401 - registers the format
from febio_io import to_pyvista, to_xarray
from febio_io.errors import FebioError, FebioFileError, FebioFormatError, FebioKeyError
from febio_io.views.pyvista_reader import PlotReader
from febio_io.xplt import ELEMENT_TYPES, open_plot

WRITER = Writer()
ROOT = Path(__file__).parents[2]


def file_of(items, data, mesh=MESH, **options):
    return WRITER.file(WRITER.root(items), WRITER.mesh(mesh), WRITER.state(0.5, data), **options)


@pytest.fixture
def plot_of(write):
    """Open a plot of one state, with these variables and values."""
    opened = []

    def open_it(items, data, mesh=MESH):
        opened.append(open_plot(write(file_of(items, data, mesh))))
        return opened[-1]

    yield open_it
    for plot in opened:
        plot.close()


def test_arrays_have_states_first_and_components_last(write):
    with open_plot(write(sample_file())) as plot:
        data = to_xarray(plot)
        assert data["displacement"].dims == ("time", "node", "axis")
        for state in range(3):
            assert_array_equal(data["displacement"][state], plot.field("displacement", state))
        nan = np.nan
        assert_array_equal(data["pressure"][1], [1, 1.5, nan, -1, -1.5])
        assert_array_equal(data["element_id"], [11, 12, 21, 31, 32])
        assert_array_equal(data["element_domain"], [1, 1, 2, 3, 3])
        assert_array_equal(data["time"], plot.times)
        assert data["active"].all()
        assert data["displacement"].attrs["unit"] == "L"
        part = to_xarray(plot, variables=["pressure"], states=[-1, 0])
        assert set(part.data_vars) == {"pressure", "active"}
        assert part["state"].values.tolist() == [2, 0]
        with pytest.raises(FebioKeyError, match="no variable 'presure'; the file has 'pressure'"):
            to_xarray(plot, variables=["presure"])


@pytest.mark.parametrize(
    ("section", "storage", "value_type", "dims"),
    [
        ("global", "node", "float", ()),
        ("global", "node", "mat3fs", ("mat3fs",)),
        ("domain", "region", "float", ("domain",)),
        ("domain", "node", "vec3f", ("domain_node", "axis")),
        ("domain", "mult", "float", ("element", "element_node")),
        ("surface", "item", "float", ("face",)),
        ("surface", "node", "float", ("surface_node",)),
        ("surface", "mult", "vec3f", ("face", "face_node", "axis")),
        ("edge", "region", "float", ("edge",)),
        ("edge", "item", "float", ("line",)),
    ],
)
def test_arrays_have_the_axes_of_their_storage(plot_of, section, storage, value_type, dims):
    components = {"float": (), "vec3f": (3,), "mat3fs": (6,)}[value_type]
    rows = {
        "global": {"node": ()},
        "domain": {"region": (), "node": (12,), "mult": (2, 8)},
        "surface": {"item": (2,), "node": (7,), "mult": (2, 4)},
        "edge": {"region": (), "item": (2,)},
    }[section][storage]
    values = 1 + np.arange(np.prod(rows + components, dtype=int)).reshape(rows + components)
    region = 0 if section == "global" else 1
    plot = plot_of([Item(section, "q", value_type, storage)], {(section, 1): {region: values}})
    array = to_xarray(plot)["q"]
    assert array.dims == ("time", *dims)
    whole = array.values[0]
    assert_array_equal(whole[~np.isnan(whole)], values.ravel())


def test_nodes_of_domains_are_told_apart(plot_of):
    values = {1: np.arange(12), 2: np.arange(4) + 100}
    data = to_xarray(plot_of([Item("domain", "p", "float", "node")], {("domain", 1): values}))
    assert_array_equal(data["p"][0, 12:16], [100, 101, 102, 103])
    assert_array_equal(data["domain_node_domain"], [1] * 12 + [2] * 4 + [3] * 4)
    assert_array_equal(data["domain_node_id"][12:16], [4, 3, 2, 1])


def test_variables_of_one_name_are_one_where_they_agree(plot_of):
    items = [Item("surface", "flow", "float", "region")] * 2
    data = {("surface", 1): {1: np.array(1.0)}, ("surface", 2): {2: np.array(2.0)}}
    assert_array_equal(to_xarray(plot_of(items, data))["flow"], [[1, 2]])
    data["surface", 2] = {1: np.array(1.0), 2: np.array(3.0)}
    assert_array_equal(to_xarray(plot_of(items, data))["flow"], [[1, 3]])
    data["surface", 2] = {1: np.array(7.0)}
    with pytest.raises(FebioFormatError, match="two variables 'flow' have different values in surface"):
        to_xarray(plot_of(items, data))


def test_names_that_are_taken_have_a_count_added(plot_of):
    items = [Item("node", "x", "float", "node"), Item("domain", "x"), Item("domain", "time")]
    data = {("node", 1): {0: np.zeros(12)}, ("domain", 1): {1: np.zeros(2)}}
    assert list(to_xarray(plot_of(items, data)).data_vars) == ["x (2)", "x (3)", "time (2)", "active"]


def test_states_of_different_meshes_are_not_mixed(write):
    later = [WRITER.mesh(SMALL_MESH), WRITER.state(3, {("node", 1): {0: np.ones((8, 3))}})]
    with open_plot(write(WRITER.file(*sample_sections(), *later))) as plot:
        with pytest.raises(FebioKeyError, match="states 0 and 3 have different meshes"):
            to_xarray(plot)
        assert to_xarray(plot, states=[3]).sizes["node"] == 8
        assert to_pyvista(plot, 3).n_points == 8


def test_a_grid_has_the_mesh_and_the_values(write):
    with open_plot(write(sample_file())) as plot:
        grid = to_pyvista(plot, 1)
        assert_array_equal(grid.points, MESH.coordinates)
        assert grid.celltypes.tolist() == [12, 12, 9, 5, 5]
        assert grid.get_cell(1).point_ids == list(range(4, 12))
        assert_array_equal(grid.point_data["displacement"], state_values(1)["node", 1][0])
        assert_array_equal(grid.cell_data["pressure"], [1, 1.5, np.nan, -1, -1.5])
        assert_array_equal(grid.cell_data["element_id"], [11, 12, 21, 31, 32])
        assert_array_equal(grid.cell_data["part_id"], [1, 1, 2, 2, 2])
        assert grid.field_data["TimeValue"][0] == plot.times[1]
        assert to_pyvista(plot).field_data["state"][0] == 2
        moved = to_pyvista(plot, 1, deformed=True)
        assert_allclose(moved.points, MESH.coordinates + state_values(1)["node", 1][0])
        array = grid.point_data.VTKObject.GetAbstractArray("displacement")
        assert [array.GetComponentName(place) for place in range(3)] == ["x", "y", "z"]


def test_deforming_needs_a_displacement(plot_of):
    with pytest.raises(FebioKeyError, match="no displacement"):
        to_pyvista(plot_of([ITEMS[1]], {}), deformed=True)


def test_grids_of_other_storages(plot_of):
    items = [
        Item("domain", "one", "float", "region"),
        Item("domain", "corner", "vec3f", "mult"),
        Item("domain", "apart", "float", "node"),
        Item("domain", "alone", "float", "node"),
        Item("global", "energy", "float", "node"),
    ]
    data = {
        ("domain", 1): {1: np.array(5.0), 3: np.array(7.0)},
        ("domain", 2): {1: np.arange(48).reshape(2, 8, 3)},
        ("domain", 3): {1: np.arange(12), 2: np.arange(4) + 100},
        ("domain", 4): {2: np.arange(4)},
        ("global", 1): {0: np.array(2.5)},
    }
    grid = to_pyvista(plot_of(items, data), 0)
    assert_array_equal(grid.cell_data["one"], [5, 5, np.nan, 7, 7])
    assert grid.cell_data["corner"].shape == (5, 24)
    assert_array_equal(grid.cell_data["corner"][1], np.arange(24, 48))
    assert_array_equal(grid.point_data["apart (Block)"][[4, 0, 8]], [0, 4, 8])
    assert_array_equal(grid.point_data["apart (domain 2)"][[3, 0]], [100, 103])
    assert_array_equal(grid.point_data["alone"][[3, 2, 1, 0]], [0, 1, 2, 3])
    assert grid.field_data["energy"][0] == 2.5


def test_surfaces_and_edges_are_grids_of_their_own(plot_of):
    items = [
        ITEMS[0],
        Item("surface", "gap"),
        Item("surface", "force", "vec3f", "region"),
        Item("surface", "normal", "float", "node"),
        Item("edge", "line load"),
    ]
    data = {
        ("node", 1): {0: np.arange(36).reshape(12, 3)},
        ("surface", 1): {1: np.array([0.1, 0.2])},
        ("surface", 2): {1: np.array([1.0, 2.0, 3.0])},
        ("surface", 3): {1: np.arange(7)},
        ("edge", 1): {1: np.array([4.0, 5.0])},
    }
    plot = plot_of(items, data)
    surface = to_pyvista(plot, 0, surface="Mixed")
    assert surface.celltypes.tolist() == [5, 9]
    assert_array_equal(surface.point_data["node_id"], np.array([8, 9, 10, 3, 2, 1, 0]) + 1)
    assert_array_equal(surface.points, MESH.coordinates[[8, 9, 10, 3, 2, 1, 0]])
    assert_array_equal(surface.point_data["displacement"][0], [24, 25, 26])
    assert_allclose(surface.cell_data["gap"], [0.1, 0.2])
    assert_array_equal(surface.cell_data["force"], [[1, 2, 3], [1, 2, 3]])
    assert_array_equal(surface.point_data["normal"], np.arange(7))
    edge = to_pyvista(plot, 0, edge=1)
    assert edge.celltypes.tolist() == [3, 21]
    assert_array_equal(edge.cell_data["line load"], [4, 5])
    assert to_pyvista(plot, 0, surface="Empty").n_cells == 0
    with pytest.raises(FebioKeyError, match="no values in region 'Mixd'; it has some in 1"):
        to_pyvista(plot, 0, surface="Mixd")


def test_faces_that_vtk_does_not_know_are_refused(write):
    mesh = MeshOf(MESH.coordinates, [DomainOf(0, [[1, *range(8)]])], [FacesOf("Odd", [[0, 1, 2, 3, 4]], 5)])
    content = WRITER.file(WRITER.root(), WRITER.mesh(mesh), WRITER.state(0))
    with open_plot(write(content)) as plot, pytest.raises(FebioFormatError, match=r"'Odd' has .* of 5 nodes"):
        to_pyvista(plot, 0, surface="Odd")


@pytest.mark.parametrize("code", ELEMENT_TYPES)
def test_every_element_type_is_shown(write, code):
    n_nodes = ELEMENT_TYPES[code].nodes
    mesh = MeshOf(np.zeros((n_nodes, 3)), [DomainOf(code, [[5, *range(n_nodes)]])])
    with open_plot(write(WRITER.file(WRITER.root(), WRITER.mesh(mesh), WRITER.state(0)))) as plot:
        grid = to_pyvista(plot)
    assert grid.celltypes.tolist() == [ELEMENT_TYPES[code].vtk_type]
    assert grid.get_cell(0).point_ids == list(ELEMENT_TYPES[code].vtk_order)


def test_volumes_of_real_meshes_are_those_of_the_tube(reference_folder):
    with open_plot(reference_folder / "none.xplt") as plot:
        grid = to_pyvista(plot, 0)
    volumes = grid.compute_cell_sizes(length=False, area=False).cell_data["Volume"]
    assert (volumes > 0).all()
    outer = np.linalg.norm(grid.points[:, :2], axis=1).max()
    polygon = 24 * 0.5 * outer**2 * np.sin(2 * np.pi / 24)
    assert_allclose(volumes.sum(), polygon * 0.015, rtol=1e-6)


@pytest.fixture
def registered():
    pv.register_reader(".xplt", PlotReader, override=True)


def test_pyvista_reads_plot_files(registered, write):
    path = write(sample_file())
    assert_array_equal(pv.read(path).cell_data["pressure"], [2, 2.5, np.nan, -2, -2.5])
    first = pv.read(path, state=0, deformed=True)
    assert_allclose(first.points, MESH.coordinates + state_values(0)["node", 1][0])
    reader = pv.get_reader(path)
    assert reader.number_time_points == 3
    assert_allclose(reader.time_values, [0, 0.1, 0.2])
    assert reader.active_time_value == reader.time_values[2]
    reader.set_active_time_value(reader.time_values[1])
    assert reader.read().field_data["state"][0] == 1
    reader.set_active_time_point(0)
    assert reader.read().field_data["state"][0] == 0
    with pytest.raises(ValueError, match="no state of time 7"):
        reader.set_active_time_value(7)
    with pytest.raises(FebioFileError, match="not an FEBio plot file"):
        pv.read(write(b"no", "no.xplt"))


def test_the_entry_point_is_that_reader():
    table = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    ((extension, value),) = table["project"]["entry-points"]["pyvista.readers"].items()
    assert extension == ".xplt"
    assert EntryPoint(extension, value, "pyvista.readers").load() is PlotReader


def test_meshio_reads_plot_files(write):
    mesh = meshio.read(write(sample_file()))
    assert [block.type for block in mesh.cells] == ["hexahedron", "quad", "triangle"]
    assert_array_equal(mesh.points, MESH.coordinates)
    assert_array_equal(mesh.point_data["displacement"], state_values(2)["node", 1][0])
    assert_array_equal(mesh.cell_data["pressure"][0], [2, 2.5])
    assert np.isnan(mesh.cell_data["pressure"][1]).all()
    assert_array_equal(mesh.cell_sets["Blocks"][0], [0, 1])
    assert_array_equal(mesh.point_sets["Bottom"], [0, 1, 2, 3])


def test_every_corpus_file_has_all_views(shared_data):
    for path in sorted((shared_data / "xplt_corpus").glob("*.xplt")):
        with open_plot(path) as plot:
            data = to_xarray(plot)
            assert data.sizes["time"] == plot.n_states
            assert to_pyvista(plot).n_cells == plot.mesh.n_elements
            for surface in plot.mesh.surfaces:
                assert to_pyvista(plot, surface=surface.region).n_cells == surface.n_items


def test_views_of_damaged_values_raise_errors_of_the_family(write):
    content = file_of([ITEMS[1]], {("domain", 1): {1: np.zeros(3)}})
    with open_plot(write(content)) as plot:
        for view in (to_xarray, to_pyvista):
            with pytest.raises(FebioError, match="12 bytes where shape"):
                view(plot)
