"""What the format allows, in files written for it."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from xplt_samples import ITEMS, MESH, SMALL_MESH, sample_file, sample_sections, state_values
from xplt_writer import DomainOf, Item, MeshOf, Writer, compressed

from febio_io.errors import FebioFileError, FebioFormatError, FebioKeyError
from febio_io.xplt import ELEMENT_TYPES, open_plot

# Of MESH, counted by hand: domains "Block" (hex8), a quad and two triangles; surface "Mixed"; edge "Rim".
AXES = {
    ("global", 0): dict.fromkeys(("node", "item", "mult", "region"), ()),
    ("node", 0): {"node": (12,)},
    ("domain", 1): {"node": (12,), "item": (2,), "mult": (2, 8), "region": ()},
    ("domain", 2): {"node": (4,), "item": (1,), "mult": (1, 4), "region": ()},
    ("domain", 3): {"node": (4,), "item": (2,), "mult": (2, 3), "region": ()},
    ("surface", 1): {"node": (7,), "item": (2,), "mult": (2, 4), "region": ()},
    ("edge", 1): {"node": (4,), "item": (2,), "mult": (2, 3), "region": ()},
}
COMPONENTS = {
    "float": (),
    "vec3f": (3,),
    "mat3fs": (6,),
    "mat3fd": (3,),
    "tens4fs": (21,),
    "mat3f": (9,),
    "array": (2,),
    "array_vec3f": (6,),
}


@pytest.mark.parametrize("value_type", COMPONENTS)
@pytest.mark.parametrize(
    ("section", "region", "storage"),
    [(section, region, storage) for (section, region), axes in AXES.items() for storage in axes],
)
def test_every_storage_and_type_has_its_shape(write, section, region, storage, value_type):
    shape = AXES[section, region][storage] + COMPONENTS[value_type]
    values = np.arange(np.prod(shape, dtype=int), dtype=np.float32).reshape(shape) + 0.5
    writer = Writer()
    array_size = 2 if "array" in value_type else 0
    item = Item(section, "quantity", value_type, storage, array_size=array_size)
    state = writer.state(0, {(section, 1): {region: values}})
    with open_plot(write(writer.file(writer.root([item]), writer.mesh(MESH), state))) as plot:
        read = plot.field("quantity", 0, region)
        assert read.dtype == np.float32
        assert_array_equal(read, values)
        assert len(plot.variables[0].components) == np.prod(COMPONENTS[value_type], dtype=int)
        assert (plot.variables[0].value_type, plot.variables[0].storage) == (value_type, storage)


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("zlib", [False, True])
def test_byte_orders_and_compression_give_the_same(write, order, zlib):
    with open_plot(write(sample_file(order=order, zlib=zlib))) as plot:
        assert plot.compressed == zlib
        assert plot.warnings == ()
        assert (plot.version, plot.software, plot.units) == (0x35, "Writer of tests", None)
        assert_array_equal(plot.times, np.float32([0, 0.1, 0.2]).astype(float))
        for state in range(3):
            expected = state_values(state)
            assert_array_equal(plot.field("displacement", state), expected["node", 1][0])
            assert_array_equal(plot.field("pressure", state, "Block"), expected["domain", 1][1])
            assert_array_equal(plot.field("pressure", state, 3), expected["domain", 1][3])
            assert plot.regions("pressure", state) == (1, 3)
            assert plot.regions("displacement", state) == (0,)


def test_mesh_is_read_whole(write):
    with open_plot(write(sample_file())) as plot:
        mesh = plot.mesh
    assert_array_equal(mesh.coordinates, MESH.coordinates)
    assert_array_equal(mesh.node_ids, np.arange(1, 13))
    block, quad, triangles = mesh.domains
    assert (block.region, block.name, block.part_id, block.part_name) == (1, "Block", 1, "Rubber")
    assert (quad.name, quad.part_name, quad.element_type.name) == ("", "Cloth", "quad4")
    assert_array_equal(block.element_ids, [11, 12])
    assert_array_equal(block.connectivity, [[4, 5, 6, 7, 0, 1, 2, 3], list(range(4, 12))])
    assert_array_equal(block.nodes, [4, 5, 6, 7, 0, 1, 2, 3, 8, 9, 10, 11])
    assert_array_equal(triangles.nodes, [8, 9, 10, 11])
    mixed, empty = mesh.surfaces
    assert (mixed.region, mixed.name, empty.n_items) == (1, "Mixed", 0)
    assert_array_equal(mixed.faces, [[8, 9, 10, -1], [3, 2, 1, 0]])
    assert_array_equal(mixed.face_ids, [1, 2])
    assert_array_equal(mixed.nodes, [8, 9, 10, 3, 2, 1, 0])
    assert_array_equal(mesh.facet_sets[0].nodes, mixed.nodes)
    assert mesh.facet_sets[0].faces.shape == (2, 10)
    assert_array_equal(mesh.edges[0].lines, [[1, 0, -1], [0, 3, 2]])
    assert_array_equal(mesh.node_sets[0].nodes, [0, 1, 2, 3])
    assert_array_equal(mesh.element_sets[0].element_ids, [11, 12])
    assert [(part.part_id, part.name) for part in mesh.parts] == [(1, "Rubber"), (2, "Cloth")]


@pytest.mark.parametrize("code", ELEMENT_TYPES)
def test_every_element_type(write, code):
    writer, n_nodes = Writer(), ELEMENT_TYPES[code].nodes
    mesh = MeshOf(np.zeros((n_nodes, 3)), [DomainOf(code, [[5, *reversed(range(n_nodes))]])])
    with open_plot(write(writer.file(writer.root(), writer.mesh(mesh)))) as plot:
        (domain,) = plot.mesh.domains
    assert domain.element_type is ELEMENT_TYPES[code]
    assert_array_equal(domain.nodes, np.arange(n_nodes)[::-1])


def test_fixed_texts_end_at_nul_and_aliases_count(write):
    writer = Writer()
    items = [
        Item("node", "velocity", "vec3f", "node", unit="L/t"),
        Item("node", "old=shells", "float", "node"),
    ]
    with open_plot(write(writer.file(writer.root(items, units="SI"), writer.mesh(MESH)))) as plot:
        assert [(variable.name, variable.unit) for variable in plot.variables] == [
            ("velocity", "L/t"),
            ("shells", None),
        ]
        assert plot.units == "SI"


def test_array_members_keep_their_names(write):
    writer = Writer()
    items = [
        Item("domain", "named", "array", array_size=2, array_names=["Na", "Cl"]),
        Item("domain", "plain", "array_vec3f", array_size=1),
    ]
    with open_plot(write(writer.file(writer.root(items), writer.mesh(MESH)))) as plot:
        assert [variable.components for variable in plot.variables] == [("Na", "Cl"), ("1 x", "1 y", "1 z")]


@pytest.mark.parametrize(
    ("value_type", "components"),
    [
        ("mat3fs", "xx yy zz xy yz xz"),
        ("mat3f", "xx xy xz yx yy yz zx zy zz"),
        ("tens4fs", "xxxx xxyy yyyy xxzz yyzz zzzz xxxy yyxy zzxy xyxy"),
    ],
)
def test_component_order(write, value_type, components):
    writer = Writer()
    with open_plot(
        write(writer.file(writer.root([Item("node", "t", value_type)]), writer.mesh(MESH)))
    ) as plot:
        names = components.split()
        assert list(plot.variables[0].components[: len(names)]) == names


def test_flag_says_compressed_but_states_are_raw(write):
    writer = Writer()
    content = writer.file(
        writer.root(ITEMS, compression=1), writer.mesh(MESH), writer.state(0, state_values(0))
    )
    with open_plot(write(content)) as plot:
        assert not plot.compressed
        assert_array_equal(plot.field("displacement", 0), state_values(0)["node", 1][0])


def test_raw_and_compressed_states_may_alternate_whatever_the_flag_says(write):
    writer = Writer()
    states = [writer.state(number, state_values(number)) for number in range(4)]
    states[1], states[2] = compressed(states[1]), compressed(states[2])
    with open_plot(write(writer.file(writer.root(ITEMS), writer.mesh(MESH), *states))) as plot:
        assert plot.compressed
        assert [plot.field("displacement", state)[0, 0] for state in range(4)] == [0, 100, 200, 300]


def test_large_compressed_states_span_many_blocks(write):
    writer, rng = Writer(), np.random.default_rng(1)
    mesh = MeshOf(np.zeros((100_000, 3)))
    values = rng.standard_normal((2, 100_000, 3)).astype(np.float32)
    item = Item("node", "u", "vec3f", "node")
    states = [compressed(writer.state(k, {("node", 1): {0: values[k]}})) for k in range(2)]
    with open_plot(write(writer.file(writer.root([item]), writer.mesh(mesh), *states))) as plot:
        assert plot.n_states == 2
        assert_array_equal(plot.field("u", 1), values[1])


@pytest.mark.parametrize("zlib", [False, True])
def test_states_after_remeshing_use_the_new_mesh(write, zlib):
    writer = Writer()
    small_values = {("node", 1): {0: np.ones((8, 3))}, ("domain", 1): {1: np.array([7.0])}}
    later = [writer.mesh(SMALL_MESH), writer.state(1, small_values, status=1)]
    if zlib:
        later = [compressed(section) for section in later]
    content = writer.file(writer.root(ITEMS), writer.mesh(MESH), writer.state(0, state_values(0)), *later)
    with open_plot(write(content)) as plot:
        assert plot.field("displacement", 0).shape == (12, 3)
        assert plot.field("displacement", 1).shape == (8, 3)
        assert plot.field("pressure", 1, "Block").tolist() == [7]
        assert plot.mesh is plot.mesh_of(0)
        assert len(plot.mesh_of(-1).node_ids) == 8
        assert len(plot.meshes) == 2
        assert plot.status.tolist() == [0, 1]


def test_variables_of_one_name_are_told_apart_by_region(write):
    writer = Writer()
    items = [Item("domain", "flow", "float", "region"), Item("domain", "flow", "float", "region")]
    state = writer.state(0, {("domain", 1): {1: np.array(1.5)}, ("domain", 2): {3: np.array(2.5)}})
    with open_plot(write(writer.file(writer.root(items), writer.mesh(MESH), state))) as plot:
        assert plot.field("flow", 0, 1) == 1.5
        assert plot.field("flow", 0, 3) == 2.5
        assert plot.regions("flow", 0) == (1, 3)
        assert plot.field(plot.variables[1], 0) == 2.5


def test_variables_of_one_name_and_region_must_be_chosen(write):
    writer = Writer()
    items = [Item("domain", "flow", "float", "region"), Item("domain", "flow", "float", "region")]
    state = writer.state(0, {("domain", 1): {1: np.array(1.5)}, ("domain", 2): {1: np.array(2.5)}})
    with open_plot(write(writer.file(writer.root(items), writer.mesh(MESH), state))) as plot:
        with pytest.raises(FebioKeyError, match=r"2 variables of this name .* region 1"):
            plot.field("flow", 0, 1)
        assert plot.field(plot.variables[1], 0, 1) == 2.5


def test_variables_of_one_name_in_two_sections(write):
    writer = Writer()
    items = [Item("node", "velocity", "float", "node"), Item("domain", "velocity", "float", "item")]
    state = writer.state(0, {("node", 1): {0: np.arange(12)}, ("domain", 1): {2: np.array([5.0])}})
    with open_plot(write(writer.file(writer.root(items), writer.mesh(MESH), state))) as plot:
        with pytest.raises(FebioKeyError, match="give one section: 'node', 'domain'"):
            plot.field("velocity", 0)
        assert plot.field("velocity", 0, section="domain") == [5]
        assert len(plot.field("velocity", 0, section="node")) == 12


def test_empty_variables_have_no_regions(write):
    writer = Writer()
    state = writer.state(0, {("node", 1): {}, ("domain", 1): {}})
    with open_plot(write(writer.file(writer.root(ITEMS), writer.mesh(MESH), state, writer.state(1)))) as plot:
        for number in (0, 1):
            assert plot.regions("pressure", number) == ()
            with pytest.raises(FebioKeyError, match=rf"'pressure' in state {number} has no values"):
                plot.field("pressure", number, 1)
            with pytest.raises(FebioKeyError, match="'displacement'"):
                plot.field("displacement", number)


def test_status_is_zero_before_files_had_it(write):
    writer = Writer()
    root, mesh = writer.root(version=0x30), writer.mesh(MESH)
    with open_plot(write(writer.file(root, mesh, writer.state(2.5, status=None)))) as plot:
        assert plot.status.tolist() == [0]
        assert plot.times.tolist() == [2.5]


@pytest.mark.parametrize(("version", "ids"), [(0x08, [1, 2]), (0x32, [1, 2]), (0x33, [7, 9]), (0x35, [7, 9])])
def test_node_numbers_are_stored_from_version_0x33_on(write, version, ids):
    writer = Writer()
    mesh = MeshOf(np.zeros((2, 3)), node_ids=[7, 9])
    with open_plot(write(writer.file(writer.root(version=version), writer.mesh(mesh)))) as plot:
        assert plot.mesh.node_ids.tolist() == ids
        assert plot.warnings == ()


@pytest.mark.parametrize("version", [0x36, 0x40, 0x20])
def test_unknown_versions_are_read_with_a_warning(write, version):
    writer = Writer()
    content = writer.file(writer.root(version=version), writer.mesh(MESH), writer.state(0))
    with open_plot(write(content)) as plot:
        (warning,) = plot.warnings
        assert f"{version:#04x}" in warning
        assert plot.n_states == 1


@pytest.mark.parametrize("version", [0x01, 0x05, 0x07])
def test_old_layouts_are_refused_by_name(write, version):
    with pytest.raises(FebioFormatError, match=f"version {version:#04x}, the layout of FEBio 1 and 2"):
        open_plot(write(Writer().file(Writer().root(version=version))))


def test_unknown_chunks_are_passed_over(write):
    writer = Writer()
    strange = writer.chunk(0x0109F000, b"anything")
    later = writer.chunk(0x01060000, b"\xff" * 40)
    content = writer.file(
        writer.root(ITEMS), writer.mesh(MESH, strange, later), strange, writer.state(0, state_values(0))
    )
    with open_plot(write(content)) as plot:
        assert len(plot.mesh.domains) == 3
        assert plot.field("displacement", 0).shape == (12, 3)
        assert plot.warnings == (
            "case.xplt has chunks of an unknown kind, which are passed over: 0x0109f000",
        )


def test_unknown_value_types_and_storages_harm_only_themselves(write):
    writer = Writer()
    items = [Item("domain", "new type", 9), Item("domain", "new storage", "float", 4), Item("domain", "p")]
    blocks = {1: np.zeros(2)}
    state = writer.state(0, {("domain", k): blocks for k in (1, 2, 3)})
    with open_plot(write(writer.file(writer.root(items), writer.mesh(MESH), state))) as plot:
        assert plot.field("p", 0).tolist() == [0, 0]
        assert plot.variables[0].components == ()
        with pytest.raises(FebioFormatError, match=r"'new type'.*type unknown \(9\)"):
            plot.field("new type", 0)
        with pytest.raises(FebioFormatError, match=r"'new storage'.*storage unknown \(4\)"):
            plot.field("new storage", 0)


def test_arrays_outlive_the_file(write):
    with open_plot(write(sample_file())) as plot:
        values = plot.field("displacement", 1)
    assert values[0].tolist() == [100, 101, 102]
    assert values.flags.aligned
    assert values.flags.writeable
    with pytest.raises(FebioFileError, match="has been closed"):
        plot.field("displacement", 1)


def test_what_is_missing_is_named_with_what_is_there(write):
    with open_plot(write(sample_file())) as plot:
        with pytest.raises(
            FebioKeyError, match="no variable 'presure'; the file has 'pressure', 'displacement'"
        ):
            plot.field("presure", 0)
        with pytest.raises(FebioKeyError, match=r"no node variable 'pressure'; the file has 'displacement'$"):
            plot.regions("pressure", 0, section="node")
        with pytest.raises(FebioKeyError, match="no state 3; the file has states 0 to 2"):
            plot.field("pressure", 3, 1)
        with pytest.raises(FebioKeyError, match=r"no values in region 'Blok'; it has some in 1 \(Block\), 3"):
            plot.field("pressure", 0, "Blok")
        with pytest.raises(FebioKeyError, match=r"several regions; give one: 1 \(Block\), 3"):
            plot.field("pressure", 0)
        with pytest.raises(FebioKeyError, match="region 2;"):
            plot.field("pressure", 0, 2)
        with pytest.raises(FebioKeyError, match="not a variable of this file"):
            plot.field(plot.variables[0].__class__("node", 1, "other", "float", "node"), 0)
    assert issubclass(FebioKeyError, LookupError)


def test_a_region_name_that_two_domains_share_must_be_a_number(write):
    writer = Writer()
    mesh = MeshOf(np.zeros((8, 3)), [DomainOf(0, [[k, *range(8)]], "Twin") for k in (1, 2)])
    state = writer.state(0, {("domain", 1): {1: [1.0], 2: [2.0]}})
    with open_plot(write(writer.file(writer.root([Item("domain", "p")]), writer.mesh(mesh), state))) as plot:
        with pytest.raises(FebioKeyError, match="2 regions named 'Twin'; give a number"):
            plot.field("p", 0, "Twin")
        assert plot.field("p", 0, 2) == [2]


def test_negative_states_count_from_the_end(write):
    with open_plot(write(sample_file(zlib=True))) as plot:
        assert_array_equal(plot.field("displacement", -1), plot.field("displacement", 2))
        with pytest.raises(FebioKeyError, match="no state -4"):
            plot.mesh_of(-4)


def test_a_file_without_states(write):
    with open_plot(write(Writer().file(*sample_sections(states=0)))) as plot:
        assert plot.times.shape == plot.status.shape == (0,)
        assert plot.warnings == ()
        with pytest.raises(FebioKeyError, match="the file has no states"):
            plot.field("displacement", 0)
