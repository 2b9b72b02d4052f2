"""Rigid bodies, connectors and springs, eroded elements, views and series."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from xplt_samples import ITEMS, MESH, SMALL_MESH, sample_file, sample_sections, state_values
from xplt_writer import Item, Writer, compressed

from febio_io.errors import FebioError, FebioFormatError, FebioKeyError
from febio_io.xplt import open_plot
from febio_io.xplt.tags import Tag

WRITER = Writer()
FORCE = WRITER.item(Item("", "Force", "vec3f"))[8:]
ANGLE = WRITER.item(Item("", "Angle", "float"))[8:]


def an_object(kind, number, *data, position=(1, 2, 3), name=None, ends=range(6)):
    parts = [WRITER.integer(Tag.OBJECT_ID, number)]
    if name is not None:
        parts += [WRITER.counted(Tag.OBJECT_NAME, name), WRITER.integer(Tag.OBJECT_TAG, 4)]
    parts += [
        WRITER.chunk(Tag.OBJECT_POSITION, WRITER.floats(position)),
        WRITER.chunk(Tag.OBJECT_ROTATION, WRITER.floats([0, 0, 0, 1])),
    ]
    if kind == Tag.LINE_OBJECT:
        parts.append(WRITER.chunk(Tag.LINE_COORDS, WRITER.floats(ends)))
    return WRITER.chunk(kind, *parts, *(WRITER.chunk(Tag.OBJECT_DATA, item) for item in data))


def values(index, *numbers):
    return WRITER.chunk(index, WRITER.floats(numbers))


BODY = an_object(Tag.POINT_OBJECT, 1, FORCE, ANGLE, FORCE, name="Body")
SPRING = an_object(Tag.LINE_OBJECT, 1, FORCE, name="Spring")


def with_objects(*in_state, in_mesh=(BODY, SPRING)):
    state = WRITER.state(0, state_values(0))[8:] + WRITER.chunk(Tag.OBJECTS_STATE, *in_state)
    mesh = WRITER.mesh(MESH, WRITER.chunk(Tag.OBJECTS_SECTION, *in_mesh))
    return WRITER.file(WRITER.root(ITEMS), mesh, WRITER.chunk(Tag.STATE, state))


def test_objects_are_where_mesh_and_state_put_them(write):
    body = an_object(Tag.POINT_OBJECT, 1, values(0, 7, 8, 9) + values(1, 5), position=(4, 5, 6))
    spring = an_object(Tag.LINE_OBJECT, 1, values(0, 1, 0, 0), ends=range(6, 12))
    with open_plot(write(with_objects(body, spring))) as plot:
        point, line = plot.mesh.objects
        assert (point.kind, point.object_id, point.name, point.tag) == ("point", 1, "Body", 4)
        assert [variable.name for variable in point.variables] == ["Force", "Angle", "Force (2)"]
        assert_array_equal(point.position, [1, 2, 3])
        assert_array_equal(line.ends, [[0, 1, 2], [3, 4, 5]])
        moved, stretched = plot.objects(0)
        assert moved.model_object is point
        assert_array_equal(moved.position, [4, 5, 6])
        assert_array_equal(moved.rotation, [0, 0, 0, 1])
        assert_array_equal(moved.values["Force"], [7, 8, 9])
        assert moved.values["Angle"].shape == ()
        assert set(moved.values) == {"Force", "Angle"}
        assert_array_equal(stretched.ends, [[6, 7, 8], [9, 10, 11]])


def test_files_without_objects_have_none(write):
    with open_plot(write(sample_file())) as plot:
        assert plot.mesh.objects == ()
        assert plot.objects(0) == ()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (with_objects(an_object(Tag.POINT_OBJECT, 2)), "the mesh has no point object 2"),
        (with_objects(an_object(Tag.POINT_OBJECT, 1, values(3, 1))), "'Body' has no variable 3"),
        (with_objects(an_object(Tag.POINT_OBJECT, 1, values(0, 1))), "4 bytes for 'Force' of object 'Body'"),
        (with_objects(an_object(Tag.POINT_OBJECT, 1, position=(1, 2))), "3 numbers expected, 8 bytes"),
        (with_objects(in_mesh=(BODY, BODY)), "two point objects have the number 1"),
        (with_objects(WRITER.chunk(Tag.LINE_OBJECT)), "OBJECT_ID .* is missing"),
    ],
)
def test_contradictions_of_objects_are_named(write, content, message):
    with open_plot(write(content)) as plot, pytest.raises(FebioFormatError, match=message):
        plot.objects(0)


def with_flags(flags):
    chunk = WRITER.chunk(Tag.MESH_STATE, WRITER.chunk(Tag.ELEMENT_STATE, WRITER.ints(*flags)))
    state = WRITER.chunk(Tag.STATE, WRITER.state(0)[8:] + chunk)
    return WRITER.file(WRITER.root(ITEMS), WRITER.mesh(MESH), state)


def test_eroded_elements(write):
    with open_plot(write(with_flags([1, 0, 3, 2, 1]))) as plot:
        assert_array_equal(plot.active_elements(0), [True, False, True, False, True])
    with open_plot(write(with_flags([1, 0]))) as plot, pytest.raises(FebioFormatError, match="2 elements"):
        plot.active_elements(0)
    with open_plot(write(sample_file())) as plot:
        assert plot.active_elements(-1).tolist() == [True] * 5


@pytest.mark.parametrize(("order", "zlib"), [("<", False), ("<", True), (">", False)])
def test_views_are_read_only_and_outlive_the_plot(write, order, zlib):
    with open_plot(write(sample_file(order=order, zlib=zlib))) as plot:
        copy = plot.field("displacement", 1)
        view = plot.field("displacement", 1, copy=False)
        again = plot.field("displacement", 1, copy=False)
        assert np.shares_memory(view, again) == (order == "<")
    copy[:] = 0
    with pytest.raises(ValueError, match="read-only"):
        view[0] = 0
    assert_array_equal(view, state_values(1)["node", 1][0])


@pytest.mark.parametrize("zlib", [False, True])
def test_series_are_the_fields_of_the_states(write, zlib):
    with open_plot(write(sample_file(zlib=zlib))) as plot:
        assert_array_equal(
            plot.series("displacement"), [plot.field("displacement", state) for state in range(3)]
        )
        assert_array_equal(plot.series("pressure", [2, 0], "Block"), [[2, 2.5], [0, 0.5]])
        with pytest.raises(FebioKeyError, match="no states"):
            plot.series("pressure", [])


def test_a_series_over_different_meshes_is_refused(write):
    values = {("node", 1): {0: np.ones((8, 3))}}
    later = [WRITER.mesh(SMALL_MESH), WRITER.state(1, values)]
    with (
        open_plot(write(WRITER.file(*sample_sections(), *later))) as plot,
        pytest.raises(FebioKeyError, match="states 0 and 3 have different meshes"),
    ):
        plot.series("displacement")


@pytest.mark.parametrize("keep", [0, 500, 1000, 10**6])
def test_what_is_kept_inflated_changes_nothing(write, keep):
    later = [compressed(WRITER.mesh(MESH)), compressed(WRITER.state(3, state_values(3)))]
    path = write(WRITER.file(*sample_sections(zlib=True), *later))
    with open_plot(path, keep_inflated=keep) as plot:
        assert plot.times.tolist()[-1] == 3
        for state in (3, 0, 2, 1):
            assert_array_equal(plot.field("displacement", state), state_values(state)["node", 1][0])


@pytest.mark.parametrize("keep", [0, 10**6])
def test_damage_is_found_however_much_is_kept(write, keep):
    for section in (WRITER.state(0)[:-4], WRITER.chunk(Tag.STATE), WRITER.state(0) + b"x"):
        path = write(WRITER.file(WRITER.root(), WRITER.mesh(MESH), compressed(section)))
        with pytest.raises(FebioError, match=r"expected|are left|are there|without a header"):
            open_plot(path, keep_inflated=keep)
