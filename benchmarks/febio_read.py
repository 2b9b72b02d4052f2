"""Measure the plot-file reader: index, values, compressed states, memory.

    python benchmarks/febio_read.py [--states 500] [--megabytes 1000] [--folder DIR]

Writes a raw plot file and a compressed one into the folder (a temporary one, unless given), reads them warm,
and prints what was measured beside what is aimed at. Times are the best of several runs; the reference for
values is numpy.fromfile of the same bytes, that for compressed states zlib alone, both in the same run.
"""

import argparse
import sys
import tempfile
import time
import tracemalloc
import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "febio_io"))  # its writers of made-up files

from xplt_writer import DomainOf, Item, MeshOf, Writer

from febio_io.xplt import open_plot

WRITER = Writer()
ITEMS = [Item("node", "displacement", "vec3f", "node"), Item("domain", "stress", "mat3fs", "item")]
BYTES_PER_NODE = 12 + 24 / 2  # a displacement, and half an element's stress
RUNS = 5


def states(n_states: int, n_nodes: int) -> Iterator[bytes]:
    """Make states of a node vector and an element tensor, rounded so that they can be compressed."""
    random = np.random.default_rng(0)
    shape = np.round(random.standard_normal((n_nodes, 3)), 3)
    stress = np.round(random.standard_normal((n_nodes // 2, 6)), 2)
    for number in range(n_states):
        scale = number / n_states
        yield WRITER.state(number, {("node", 1): {0: shape * scale}, ("domain", 1): {1: stress * scale}})


@dataclass(frozen=True)
class Written:
    """Where a state lies in the file, its size inflated, and where its node vector starts in it."""

    start: int
    stop: int
    size: int
    vector: int


def write_file(path: Path, n_states: int, n_nodes: int, *, compress: bool) -> list[Written]:
    """Write a plot file of nodes and two-node elements."""
    ends = np.arange(2 * (n_nodes // 2)).reshape(-1, 2)
    elements = np.column_stack([np.arange(1, len(ends) + 1), ends])
    mesh = MeshOf(np.zeros((n_nodes, 3)), [DomainOf(5, elements.tolist(), "Lines")])
    before_vector = WRITER.ints(0, 12 * n_nodes)  # region and size
    written = []
    with path.open("wb") as file:
        file.write(WRITER.file(WRITER.root(ITEMS, compression=int(compress)), WRITER.mesh(mesh)))
        for state in states(n_states, n_nodes):
            start = file.tell()
            file.write(zlib.compress(state) if compress else state)
            vector = state.index(before_vector) + len(before_vector)
            written.append(Written(start, file.tell(), len(state), vector))
    return written


def best(run: Callable[[], object]) -> float:
    """Give the shortest of several times, in seconds."""
    times = []
    for _ in range(RUNS):
        started = time.perf_counter()
        run()
        times.append(time.perf_counter() - started)
    return min(times)


def row(what: str, measured: str, aim: str, met: bool) -> None:
    print(f"{what:58} {measured:>16} {aim:>24}  {'met' if met else 'NOT MET'}")


def measure_raw(path: Path, written: list[Written], n_nodes: int) -> None:
    def index() -> None:
        open_plot(path).close()

    seconds = best(index)
    row(f"index of {path.stat().st_size / 1e9:.2f} GB", f"{1e3 * seconds:.1f} ms", "< 100 ms", seconds < 0.1)
    with open_plot(path) as plot:
        n_states, count = plot.n_states, 3 * n_nodes
        touched = 4 * count * n_states / 1e9
        first = plot.field("displacement", 0, copy=False)

        def fields() -> None:
            for state in range(n_states):
                plot.field("displacement", state)

        def plain() -> None:
            with path.open("rb") as file:
                for state in written:
                    file.seek(state.start + state.vector)
                    np.fromfile(file, "<f4", count)

        reference = touched / best(plain)
        for what, run in (("each state", fields), ("as one array", lambda: plot.series("displacement"))):
            speed = touched / best(run)
            share = speed / reference
            met = speed >= 1.5 or share >= 0.7
            measured = f"{speed:.2f} GB/s"
            row(f"node vector, {what} (fromfile: {reference:.2f} GB/s)", measured, ">= 1.5 GB/s or 70 %", met)
        size = first.nbytes
        peak = peak_memory(lambda: plot.field("displacement", n_states - 1))
        row("peak memory for one field", f"{peak / size:.2f} x its size", "<= 2 x", peak <= 2 * size)
        peak = peak_memory(lambda: plot.series("displacement"))
        ratio = peak / (size * n_states)
        row("peak memory for all states", f"{ratio:.2f} x its size", "<= 2 x", ratio <= 2)


def measure_compressed(path: Path, written: list[Written]) -> None:
    content = path.read_bytes()

    def plain() -> None:
        for state in written:
            zlib.decompress(content[state.start : state.stop], bufsize=state.size)

    def whole(keep: int) -> None:
        with open_plot(path, keep_inflated=keep) as plot:
            for state in range(plot.n_states):
                plot.field("displacement", state, copy=False)
                plot.field("stress", state, copy=False)

    def index() -> None:
        open_plot(path).close()

    reference, inflated = best(plain), sum(state.size for state in written)
    sizes = f"{len(content) / 1e6:.0f} MB, inflated {inflated / 1e6:.0f} MB"
    ratio = best(index) / reference
    row(f"index of compressed states ({sizes})", f"{ratio:.2f} x zlib", "<= 1.2 x", ratio <= 1.2)
    ratio = best(lambda: whole(inflated)) / reference
    row("index and all values, states kept", f"{ratio:.2f} x zlib", "<= 1.2 x", ratio <= 1.2)
    ratio = best(lambda: whole(0)) / reference
    row("index and all values, none kept", f"{ratio:.2f} x zlib", "<= 1.2 x", ratio <= 1.2)


def peak_memory(run: Callable[[], object]) -> int:
    tracemalloc.start()
    run()
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return peak


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--states", type=int, default=500)
    parser.add_argument("--megabytes", type=float, default=1000, help="size of the raw file")
    parser.add_argument("--folder", type=Path, help="where to write the files, to keep them")
    options = parser.parse_args()
    n_nodes = int(options.megabytes * 1e6 / options.states / BYTES_PER_NODE)
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.folder or Path(temporary)
        raw, packed = folder / "raw.xplt", folder / "compressed.xplt"
        measure_raw(raw, write_file(raw, options.states, n_nodes, compress=False), n_nodes)
        measure_compressed(packed, write_file(packed, max(options.states // 10, 1), n_nodes, compress=True))
    return 0


if __name__ == "__main__":
    sys.exit(main())
