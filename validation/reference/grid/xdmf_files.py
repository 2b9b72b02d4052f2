"""Series of XDMF, read by meshio; fields may lie in several files of one mesh.

meshio takes one mesh for the whole series and the last of several series in a file, without a word: both are
looked for here.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element, ParseError

import meshio
import numpy as np
from meshio.xdmf import TimeSeriesReader

from cases.arrays import Floats
from cases.sections.references.xdmf import XdmfReference
from validation.errors import UnusableReferenceError
from validation.reference.grid.contents import Grid, Piece

VTK_TYPES = {
    "vertex": 1,
    "line": 3,
    "triangle": 5,
    "quad": 9,
    "tetra": 10,
    "hexahedron": 12,
    "wedge": 13,
    "pyramid": 14,
    "triangle6": 22,
    "quad8": 23,
    "tetra10": 24,
    "hexahedron20": 25,
    "wedge15": 26,
    "pyramid13": 27,
    "hexahedron27": 29,
    "wedge18": 32,
}
UNREADABLE = (meshio.ReadError, ParseError, OSError, KeyError, ValueError, AssertionError, AttributeError)


class OpenFile(NamedTuple):
    """One file: a series' reader, or the mesh of one that has no times; and its own name."""

    name: str
    series: TimeSeriesReader | None
    mesh: meshio.Mesh


@contextmanager
def opened(path: Path) -> Iterator[OpenFile]:
    """Open a file of XDMF.

    Raises
    ------
    UnusableReferenceError
        If meshio cannot read it, or it holds several series.
    """
    with _telling(path.name):
        grids = list(_tree(path).iter("Grid"))
        series = [grid for grid in grids if grid.get("CollectionType") == "Temporal"]
        if len(series) > 1:
            names = ", ".join(str(grid.get("Name")) for grid in series)
            raise UnusableReferenceError(
                f"{path.name}: {len(series)} series in one file ({names}); allowed: a file for each"
            )
        if not series:
            yield OpenFile(path.name, None, meshio.read(path))
            return
    with TimeSeriesReader(path) as reader:
        with _telling(path.name):
            mesh = meshio.Mesh(*reader.read_points_cells())
        yield OpenFile(path.name, reader, mesh)


def _tree(path: Path) -> Element:
    from xml.etree import ElementTree

    return ElementTree.parse(path).getroot()  # noqa: S314 - the user's own file


@contextmanager
def _telling(name: str) -> Iterator[None]:
    try:
        yield
    except UNREADABLE as error:
        words = repr(error) if isinstance(error, KeyError) else str(error)
        reason = " ".join(words.split()) or type(error).__name__
        raise UnusableReferenceError(f"{name}: meshio cannot read it: {reason}") from error


@dataclass(frozen=True)
class XdmfFiles:
    """A :class:`validation.reference.grid.contents.GridFiles` of open files."""

    stated: XdmfReference
    files: Sequence[OpenFile]

    @property
    def name(self) -> str:
        """First file."""
        return str(self.stated.result_files[0].paths[0])

    @property
    def software(self) -> str:
        """Library that reads them: the files do not tell who wrote them."""
        return f"read by meshio {meshio.__version__}"

    @cached_property
    def times(self) -> Floats:
        """Times of the states, s, which all series must share."""
        found: dict[str, Floats] = {}
        for file in self.files:
            if file.series is not None:
                with _telling(file.name):
                    found[file.name] = np.array([_time(step) for step in file.series.collection])
        if not found:
            raise UnusableReferenceError(f"{self.files[0].name}: no series (no temporal collection) in it")
        (first, times), *others = found.items()
        for name, own in others:
            if own.shape != times.shape or not np.allclose(own, times, rtol=1e-9, atol=0):
                raise UnusableReferenceError(f"{name}: other times than {first}")
        return self.stated.time_unit * times

    @property
    def times_if_told(self) -> Floats:
        """Times of the states."""
        return self.times

    def first(self) -> Grid:
        """Return the first state."""
        return self.state(0)

    def state(self, number: int) -> Grid:
        """Return a state."""
        grids = [_grid(file, number) for file in self.files]
        whole = grids[0]
        for file, grid in zip(self.files[1:], grids[1:], strict=True):
            same = np.array_equal(grid.nodes, whole.nodes) and np.array_equal(grid.points, whole.points)
            if not same:
                raise UnusableReferenceError(
                    f"{file.name}: another mesh than {self.files[0].name}; allowed: one mesh in all files"
                )
            whole = whole._replace(
                of_points={**grid.of_points, **whole.of_points},
                of_cells={**grid.of_cells, **whole.of_cells},
            )
        return whole

    def file_of(self, number: int) -> str:
        """Return the name of the first file with the state."""
        return f"{self.files[0].name}, state {number + 1}"


def _time(step: Element) -> float:
    found = step.find("Time")
    if found is None:
        raise meshio.ReadError("a state without time")
    return float(found.attrib["Value"])


def _grid(file: OpenFile, number: int) -> Grid:
    mesh = file.mesh
    points, cells = mesh.points, [(block.type, block.data) for block in mesh.cells]
    of_points: dict[str, Any] = dict(mesh.point_data)
    of_cells: dict[str, Any] = dict(mesh.cell_data)
    if file.series is not None:
        with _telling(file.name):
            _, of_points, of_cells = file.series.read_data(number)
            points, cells = _own_mesh(file.series, number, points, cells)
    unknown = sorted({kind for kind, _ in cells} - set(VTK_TYPES))
    if unknown:
        raise UnusableReferenceError(
            f"{file.name}: cells of type {', '.join(unknown)}; allowed: {', '.join(VTK_TYPES)}"
        )
    if points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    counts = np.concatenate([np.full(len(nodes), nodes.shape[1]) for _, nodes in cells])
    return Grid(
        points,
        np.concatenate([np.full(len(nodes), VTK_TYPES[kind]) for kind, nodes in cells]),
        np.concatenate([[0], np.cumsum(counts)]),
        np.concatenate([np.asarray(nodes, dtype=np.int64).ravel() for _, nodes in cells]),
        of_points,
        {name: _flat(np.concatenate(parts)) for name, parts in of_cells.items()},
        (Piece(file.name, ""),),
        np.zeros(len(counts), dtype=np.int64),
    )


def _flat(values: Any) -> Any:
    return values[:, 0] if values.ndim == 2 and values.shape[1] == 1 else values


def _own_mesh(
    series: TimeSeriesReader, number: int, points: Floats, cells: list[tuple[str, Any]]
) -> tuple[Floats, list[tuple[str, Any]]]:
    """Return the mesh that a state holds itself, if it does: meshio gives the first state's for all."""
    step = series.collection[number]
    if step is series.mesh_grid or step.find("Geometry") is None:
        return points, cells
    other = TimeSeriesReader(series.filename)
    with other:
        other.mesh_grid = other.collection[number]
        own_points, blocks = other.read_points_cells()
    return own_points, [(block.type, block.data) for block in blocks] or cells
