"""Compressed files too large to keep: sections are searched for, and verified when they are read."""

import random
import zlib

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from xplt_samples import ITEMS, MESH, SMALL_MESH, sample_sections, state_values
from xplt_writer import Writer, compressed

from febio_io.errors import FebioFormatError
from febio_io.xplt import open_plot
from febio_io.xplt.container import Source
from febio_io.xplt.section_starts import BLOCK_SIZE, section_starts


def states_of(writer, count, n_nodes=12):
    return [writer.state(0.1 * number, state_values(number, n_nodes)) for number in range(count)]


def check(path, count):
    with open_plot(path, keep_inflated=0) as searched, open_plot(path) as strict:
        assert searched.n_states == strict.n_states == count
        assert_array_equal(searched.times, strict.times)
        assert searched.warnings == strict.warnings
        for state in range(count):
            for variable in strict.variables:
                for region, values in strict.fields(variable, state).items():
                    assert_array_equal(searched.fields(variable, state)[region], values)


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("level", [0, 1, 6, 9])
def test_states_of_every_level_are_found(write, order, level):
    writer = Writer(order)
    packed = [zlib.compress(state, level) for state in states_of(writer, 5)]
    check(write(writer.file(writer.root(ITEMS), writer.mesh(MESH), *packed)), 5)


@pytest.mark.parametrize("order", ["<", ">"])
def test_raw_and_compressed_sections_and_later_meshes_may_alternate(write, order):
    writer = Writer(order)
    first, second, third = states_of(writer, 3)
    later = writer.state(1, state_values(7, 8) | {("domain", 1): {1: [5.0]}})
    mesh = writer.mesh(SMALL_MESH)
    sections = [compressed(first), second, compressed(third), compressed(mesh), compressed(later)]
    sections += [mesh, later, compressed(later)]
    path = write(writer.file(writer.root(ITEMS), writer.mesh(MESH), *sections))
    check(path, 6)
    with open_plot(path, keep_inflated=0) as plot:
        assert [len(mesh.node_ids) for mesh in plot.meshes] == [12, 8, 8]


def test_an_error_in_one_beginning_shows_in_the_state_before(write):
    root, mesh, *packed = sample_sections(zlib=True, states=3)
    content = Writer().file(root, mesh, packed[0], b"\x78\x9c" + packed[1][2:8] + b"\xff" * 60, packed[2])
    with open_plot(write(content), keep_inflated=0) as plot:
        assert plot.n_states == 2
        with pytest.raises(FebioFormatError, match="68 bytes after the compressed data belong to no section"):
            plot.field("pressure", 0, 1)


def test_every_length_of_a_cut_file(write):
    sections = sample_sections(zlib=True, states=4)
    whole = Writer().file(*sections)
    ends = np.cumsum([4, *map(len, sections)])[2:]
    for length in range(int(ends[0]), len(whole)):
        complete = int(np.searchsorted(ends[1:], length, side="right"))
        with open_plot(write(whole[:length]), keep_inflated=0) as plot:
            assert plot.n_states == complete
            assert bool(plot.warnings) == (length not in ends)


@pytest.mark.parametrize(
    ("damage", "said"),
    [
        (lambda state: state[:-1], "cut off where the next section begins"),
        (lambda state: state[:-6] + b"\xff" * 6, "damaged compressed data"),
        (lambda state: state + b"left over", "9 bytes after the compressed data belong to no section"),
        (lambda state: compressed(zlib.decompress(state) + b"more"), "but more are there"),
        (lambda state: compressed(zlib.decompress(state)[:-4]), r"\d+ bytes expected, but \d+ are there"),
    ],
)
def test_damage_between_whole_states_is_refused_when_it_is_read(write, damage, said):
    root, mesh, *packed = sample_sections(zlib=True, states=3)
    content = Writer().file(root, mesh, packed[0], damage(packed[1]), packed[2])
    with open_plot(write(content), keep_inflated=0) as plot:
        assert plot.n_states == 3
        for state in (0, 2):
            assert_array_equal(plot.field("pressure", state, 1), [state, state + 0.5])
        with pytest.raises(FebioFormatError, match=said) as caught:
            plot.field("pressure", 1, 1)
        assert caught.value.offset == 4 + sum(map(len, (root, mesh, packed[0])))


def test_what_only_looks_like_a_beginning_is_passed_over(write):
    writer, noise = Writer(), random.Random(1).randbytes(3 * BLOCK_SIZE)  # noqa: S311 - nothing secret
    state = compressed(writer.state(0))
    # Across a block's end, and preceded by bytes that begin alike.
    content = noise[: BLOCK_SIZE - 3] + b"\x78\x9c" + state + b"\x78" + noise + state
    path = write(content)
    found = list(section_starts(Source(path, path.read_bytes(), "<"), BLOCK_SIZE - 3))
    assert found == [BLOCK_SIZE - 1, len(content) - len(state)]
