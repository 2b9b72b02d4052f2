"""Files that are cut off, lie or are broken: whole states are used, contradictions refused."""

import struct
from contextlib import suppress

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from xplt_samples import ITEMS, MESH, rich_file, sample_file, sample_sections, state_values
from xplt_writer import DomainOf, FacesOf, Item, MeshOf, Writer, compressed

from febio_io import to_xarray
from febio_io.errors import FebioError, FebioFileError, FebioFormatError
from febio_io.xplt import open_plot
from febio_io.xplt.mesh import first_appearances
from febio_io.xplt.summary import summarize, summary_lines
from febio_io.xplt.tags import Tag

WRITER = Writer()


def read_everything(path):
    with open_plot(path) as plot:
        "\n".join(summary_lines(summarize(plot)))
        for state in range(plot.n_states):
            plot.active_elements(state)
            plot.objects(state)
            for variable in plot.variables:
                for region in plot.regions(variable, state):
                    plot.field(variable, state, region)
        to_xarray(plot)
        return plot.n_states


@pytest.mark.slow
@pytest.mark.parametrize("zlib", [False, True])
def test_a_file_cut_anywhere_gives_its_complete_states(write, zlib):
    sections = sample_sections(zlib=zlib)
    whole = WRITER.file(*sections)
    ends = np.cumsum([4, *map(len, sections)])
    first_state = ends[2]
    steps = 1 if zlib else 7
    for length in {*range(first_state, len(whole), steps), *ends[2:-1], *(ends[3:] - 1)}:
        complete = int(np.searchsorted(ends[3:], length, side="right"))
        path = write(whole[:length])
        assert read_everything(path) == complete
        with open_plot(path) as plot:
            if length in ends:
                assert plot.warnings == ()
            elif complete:
                verb = "1 complete state is used" if complete == 1 else f"{complete} complete states are used"
                assert plot.warnings == (f"case.xplt is cut off after state {complete}: {verb}",)
            else:
                assert plot.warnings == ("case.xplt is cut off in its first state: it has no complete state",)


def test_a_file_cut_before_its_states_is_refused(write):
    whole = WRITER.file(*sample_sections(states=0))
    for length in {*range(1, len(whole), 11), len(whole) - 1}:
        with pytest.raises((FebioFormatError, FebioFileError), match=r"cut off|not an FEBio plot file"):
            open_plot(write(whole[:length]))


@pytest.mark.parametrize("zlib", [False, True])
def test_room_that_was_never_written_to_counts_as_cut_off(write, zlib):
    with open_plot(write(sample_file(zlib=zlib) + bytes(5000))) as plot:
        assert plot.warnings == ("case.xplt is cut off after state 3: 3 complete states are used",)


def test_remeshing_cut_off_in_the_new_mesh(write):
    whole = sample_file() + WRITER.mesh(MESH)
    with open_plot(write(whole[:-5])) as plot:
        assert plot.n_states == 3
        assert len(plot.warnings) == 1


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "it is empty"),
        (b"<?xml version='1.0'?>", r"not an FEBio plot file: it starts with b'<\?xml'"),
        (b"BE", "it starts with b'BE'"),
    ],
)
def test_other_files_are_refused_by_what_they_are(write, content, message):
    with pytest.raises(FebioFileError, match=message):
        open_plot(write(content))


def test_missing_files_and_folders(tmp_path):
    with pytest.raises(FebioFileError, match="No such file"):
        open_plot(tmp_path / "none.xplt")
    with pytest.raises(FebioFileError, match="Is a directory"):
        open_plot(tmp_path)


def with_mesh(mesh):
    return WRITER.file(WRITER.root(), WRITER.mesh(mesh))


def with_state(blocks, item=ITEMS[1]):
    return WRITER.file(WRITER.root([item]), WRITER.mesh(MESH), WRITER.state(0, {(item.section, 1): blocks}))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (with_state({1: np.zeros(3)}), r"'pressure', domain region 1, state 0: 12 bytes where shape \(2,\)"),
        (with_state({4: np.zeros(2)}), "domain region 4, state 0: the mesh has no such region"),
        (with_state({0: np.zeros((11, 3))}, ITEMS[0]), r"132 bytes where shape \(12, 3\)"),
        (with_state({1: np.zeros((12, 3))}, ITEMS[0]), "node region 1, state 0: the mesh has no such region"),
        (with_mesh(MeshOf(np.zeros((2, 3)), [DomainOf(5, [[1, 0, 2]])])), "node 2 of a mesh with 2 nodes"),
        (with_mesh(MeshOf(np.zeros((2, 3)), [DomainOf(5, [[1, 0, -1]])])), "node -1 of a mesh with 2 nodes"),
        (
            with_mesh(MeshOf(np.zeros((2, 3)), [DomainOf(20, [[1, 0, 1]])])),
            "element type 20; 0 to 19 are known",
        ),
        (with_mesh(MeshOf(np.zeros((2, 3)), [DomainOf(5, [[1, 0, 1, 1]])])), "LINE|ELEMENTs of 3 numbers"),
        (
            with_mesh(MeshOf(np.zeros((2, 3)), [], [FacesOf("S", [[0, 7]], 4)])),
            "node 7 of a mesh with 2 nodes",
        ),
        (with_mesh(MeshOf(np.zeros((2, 3)), [], [FacesOf("S", [[]], 4)])), "without 1 to 4 nodes"),
        (with_mesh(MeshOf(np.zeros((2, 3)), [], [FacesOf("S", [], 2**30)])), "up to 1073741824 nodes"),
        (with_mesh(MeshOf(np.zeros((2, 3)), node_sets={"N": [5]})), "node 5 of a mesh with 2 nodes"),
        (
            WRITER.file(
                WRITER.root([Item("node", "a", "array", "node", array_size=2**31 - 1)]), WRITER.mesh(MESH)
            ),
            "an array of 2147483647",
        ),
        (WRITER.file(WRITER.root(), WRITER.state(0)), "a state before the first mesh"),
        (WRITER.file(WRITER.root()), "the file has no mesh"),
        (
            WRITER.file(
                WRITER.root(), WRITER.mesh(MESH), WRITER.chunk(Tag.STATE, WRITER.chunk(Tag.STATE_HEADER))
            ),
            "header lacks its time",
        ),
        (WRITER.file(WRITER.root(), WRITER.mesh(MESH), b"no chunk at all"), "neither a mesh, a state nor"),
        (WRITER.file(WRITER.root(), WRITER.mesh(MESH), WRITER.chunk(Tag.STATE)), "a state without a header"),
        (
            WRITER.file(WRITER.root(), WRITER.mesh(MESH), compressed(WRITER.chunk(Tag.STATE))),
            "a state without a header",
        ),
        (
            WRITER.file(WRITER.root(), WRITER.mesh(MESH), compressed(WRITER.state(0) + b"more")),
            "bytes, but more are there",
        ),
        (
            WRITER.file(WRITER.root(), WRITER.mesh(MESH), compressed(WRITER.state(0)[:-4])),
            r"a size of 40 bytes, but 36 are there|expected|are left",
        ),
        (
            WRITER.file(WRITER.root(), WRITER.mesh(MESH), b"\x78\x9c" + b"\xff" * 40),
            "damaged compressed data",
        ),
        (
            WRITER.file(
                WRITER.root(), WRITER.mesh(MESH), compressed(struct.pack("<II", Tag.STATE, 2**32 - 1))
            ),
            "8 bytes expected, 0 found",
        ),
    ],
)
def test_contradictions_are_named(write, content, message):
    with pytest.raises(FebioFormatError, match=message) as caught:
        read_everything(write(content))
    assert caught.value.path.name == "case.xplt"
    assert caught.value.offset is not None


def test_a_region_or_variable_may_not_come_twice(write):
    block = WRITER.chunk(1, WRITER.floats([1, 2]))
    data = WRITER.chunk(Tag.VARIABLE_DATA, block, block)
    variable = WRITER.chunk(Tag.STATE_VARIABLE, WRITER.integer(Tag.VARIABLE_ID, 1), data)
    head = WRITER.chunk(Tag.STATE_HEADER, WRITER.chunk(Tag.STATE_TIME, WRITER.floats([0])))
    start = [WRITER.root([ITEMS[1]]), WRITER.mesh(MESH)]
    for variables, message in (
        ([variable], "region occurs twice"),
        ([variable] * 2, "variable 1 occurs twice"),
    ):
        section = WRITER.chunk(Tag.STATE_DATA, WRITER.chunk(Tag.DOMAIN_DATA, *variables))
        with pytest.raises(FebioFormatError, match=message):
            read_everything(write(WRITER.file(*start, WRITER.chunk(Tag.STATE, head, section))))


def test_offsets_point_at_the_fault(write):
    whole = bytearray(WRITER.file(*sample_sections()))
    place = whole.index(struct.pack("<I", Tag.ELEMENT_LIST)) + 8 + 4
    whole[place : place + 4] = struct.pack("<I", 77)
    with open_plot(write(bytes(whole))) as plot, pytest.raises(FebioFormatError) as caught:
        plot.mesh.domains  # noqa: B018
    assert (caught.value.tag, caught.value.offset) == (Tag.ELEMENT_LIST, place - 4)
    assert f"{Tag.ELEMENT_LIST:#010x} at byte {place - 4}" in str(caught.value)


def test_faults_in_compressed_states_say_where_the_state_is(write):
    sections = sample_sections(states=1)
    bad = WRITER.state(1, {("domain", 1): {1: np.zeros(5)}})
    content = WRITER.file(*sections, compressed(bad))
    with open_plot(write(content)) as plot, pytest.raises(FebioFormatError) as caught:
        plot.regions("pressure", 1)
    assert caught.value.stream_offset == 4 + sum(map(len, sections))


SAMPLES = [
    rich_file(),
    sample_file(states=2),
    sample_file(zlib=True, states=2),
    sample_file(order=">", states=1),
]
NUMBERS = st.sampled_from(
    [0, 1, 2, 7, 0x7F, 0xFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFF0, 0xFFFFFFFF, *map(int, Tag)]
)
EDITS = st.lists(
    st.tuples(st.sampled_from(["byte", "number", "cut", "drop", "repeat"]), st.integers(0, 10**6), NUMBERS),
    min_size=1,
    max_size=4,
)


def mutate(content, edits):
    result = bytearray(content)
    for kind, place, value in edits:
        at = place % max(len(result), 1)
        if kind == "byte":
            result[at : at + 1] = bytes([value % 256])
        elif kind == "number":
            result[at : at + 4] = struct.pack("<I", value)
        elif kind == "cut":
            del result[at:]
        elif kind == "drop":
            del result[at : at + value % 16]
        else:
            result[at:at] = result[at : at + value % 64]
    return bytes(result)


@settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(sample=st.sampled_from(range(len(SAMPLES))), edits=EDITS)
@example(sample=1, edits=[("number", 8, 0xFFFFFFFF)])
def test_mutated_files_raise_only_errors_of_the_family(write, sample, edits):
    with suppress(FebioError):
        read_everything(write(mutate(SAMPLES[sample], edits)))


@settings(max_examples=200, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(edits=EDITS)
def test_mutations_inside_compressed_states_raise_only_errors_of_the_family(write, edits):
    state = mutate(WRITER.state(0, state_values(0)), edits)
    content = WRITER.file(WRITER.root(ITEMS), WRITER.mesh(MESH), compressed(state))
    with suppress(FebioError):
        read_everything(write(content))


@settings(max_examples=60, deadline=None)
@given(st.lists(st.integers(0, 30), max_size=60))
def test_first_appearances_match_a_plain_loop(values):
    found = first_appearances(np.array(values, dtype=np.int64))
    assert_array_equal(found, list(dict.fromkeys(values)))
