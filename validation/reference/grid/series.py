"""Files of named arrays as a series of states of a mesh."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from hashlib import blake2b
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cases.arrays import Floats, Indices, Integers
from cases.sections.references.grid import GridReference
from validation.errors import UnusableReferenceError
from validation.mapping.mesh import Block
from validation.reference.grid.cells import elements_of
from validation.reference.grid.coincident import representatives
from validation.reference.grid.contents import Grid, GridFiles
from validation.reference.grid.selection import choose_cells
from validation.reference.mesh.series import Account, MeshState, SeriesMesh, Where
from validation.runs.provenance import shown_path

APART = 1e-3  # share of the mesh's extent by which copies of a node may move apart


class _Taken(NamedTuple):
    """The mesh, and what is taken of each state: nodes, copies of nodes beside them, cells of the lumen."""

    mesh: SeriesMesh
    nodes: Integers
    copies: tuple[Integers, Integers]
    in_lumen: Indices
    cells: Integers
    size: float
    fingerprint: bytes
    points: Floats


@dataclass(frozen=True)
class GridSeries:
    """A :class:`validation.reference.mesh.series.MeshSeries` of open files."""

    files: GridFiles
    stated: GridReference

    @property
    def name(self) -> str:
        """File that messages name."""
        return self.files.name

    @property
    def times(self) -> Floats:
        """Times of the states, s."""
        return self.files.times

    def mesh(self) -> SeriesMesh:
        """Return the unloaded mesh, coincident nodes of lumen and wall as one."""
        return self._taken.mesh

    @cached_property
    def _taken(self) -> _Taken:
        stated, grid = self.stated, self.files.first()
        chosen = choose_cells(grid, stated)
        velocity_at = self._place(grid, stated.velocity, "velocity", 3)
        pressure_at = self._place(grid, stated.pressure, "pressure", 1)
        lumen = elements_of(grid, chosen.lumen, "lumen")
        wall = elements_of(grid, chosen.wall, "wall") if chosen.wall.any() else None
        calcified = elements_of(grid, chosen.calcified, "calcified") if chosen.calcified.any() else None
        inside = np.unique(np.concatenate([block.nodes.ravel() for block in lumen.blocks]))
        outside = [] if wall is None else [block.nodes.ravel() for block in wall.blocks]
        used = np.unique(np.concatenate([inside, *outside]))
        points = self._unloaded(grid)
        standing = representatives(points, used, inside)
        nodes = np.unique(standing)
        place = np.full(len(points), -1)
        place[used] = np.searchsorted(nodes, standing)
        twice = standing != used
        found = SeriesMesh(
            stated.length_unit * points[nodes],
            _renumbered(lumen.blocks, place),
            [] if wall is None else _renumbered(wall.blocks, place),
            None if stated.calcified is None else _renumbered(calcified.blocks if calcified else [], place),
            velocity_at=velocity_at,
            pressure_at=pressure_at,
            notes=(*chosen.notes, *lumen.notes, *(wall.notes if wall else ())),
            unloaded=stated.displacement is not None,
        )
        return _Taken(
            found,
            nodes,
            (used[twice], standing[twice]),
            np.flatnonzero(np.isin(nodes, inside)),
            lumen.cells,
            float(np.ptp(points[used], axis=0).max()),
            _fingerprint(grid),
            grid.points if stated.positions == "reference" else np.empty((0, 3)),
        )

    def state(self, number: int) -> MeshState:
        """Return a state; refuse one of another mesh, or without values on the lumen."""
        taken, stated = self._taken, self.stated
        grid = self.files.state(number)
        file = self.files.file_of(number)
        self._refuse_another_mesh(grid, taken, file)
        positions = self._positions(grid)
        here, there = taken.copies
        if np.isnan(positions[taken.nodes]).any() or np.isnan(positions[here]).any():
            raise UnusableReferenceError(f"{file}: nodes of lumen or wall have no {stated.displacement}")
        if here.size:
            apart = np.linalg.norm(positions[here] - positions[there], axis=1).max()
            if not apart <= APART * taken.size:
                raise UnusableReferenceError(
                    f"{file}: nodes of lumen and wall that coincide in the unloaded mesh are up to "
                    f"{stated.length_unit * apart:.3g} m apart: the wall does not move with the lumen; "
                    f"reference.displacement ({stated.displacement}) must be that of the mesh in both"
                )
        velocity = self._values(grid, stated.velocity, "velocity", taken.mesh.velocity_at, file)
        pressure = self._values(grid, stated.pressure, "pressure", taken.mesh.pressure_at, file)
        return MeshState(
            stated.length_unit * positions[taken.nodes],
            stated.length_unit / stated.time_unit * velocity,
            stated.pressure_factor * pressure,
        )

    def account(self) -> Account:
        """Return what the files tell."""
        mesh = self._taken.mesh
        elements = sum(len(block.nodes) for block in (*mesh.lumen, *mesh.wall))
        facts: dict[str, Any] = {
            "file": shown_path(Path(self.files.name)),
            "software": self.files.software,
            "nodes": len(mesh.coordinates),
            "elements": elements,
        }
        return Account(facts)

    def _place(self, grid: Grid, name: str, key: str, components: int) -> Where:
        """Where an array lies: nodes, else cells."""
        found = [where for where in (grid.of_points, grid.of_cells) if name in where]
        if not found:
            raise UnusableReferenceError(f"reference.{key}: no array {name!r}; there are: {_listed(grid)}")
        array = found[0][name]
        width = 1 if array.ndim == 1 else array.shape[1]
        if width != components:
            raise UnusableReferenceError(
                f"reference.{key}: array {name!r} has {width} components; allowed: {components}"
            )
        return "nodes" if name in grid.of_points else "cells"

    def _displacement(self, grid: Grid, name: str) -> Floats:
        if self._place(grid, name, "displacement", 3) == "cells":
            raise UnusableReferenceError(
                f"reference.displacement: array {name!r} is of cells; allowed: one of points "
                f"({', '.join(sorted(grid.of_points)) or 'there is none'})"
            )
        return np.asarray(grid.of_points[name], dtype=float)

    def _unloaded(self, grid: Grid) -> Floats:
        points = np.asarray(grid.points, dtype=float)
        name = self.stated.displacement if self.stated.positions == "deformed" else None
        return points if name is None else points - self._displacement(grid, name)

    def _positions(self, grid: Grid) -> Floats:
        points = np.asarray(grid.points, dtype=float)
        name = self.stated.displacement if self.stated.positions == "reference" else None
        return points if name is None else points + self._displacement(grid, name)

    def _values(self, grid: Grid, name: str, key: str, where: Where, file: str) -> Floats:
        """Return the values at nodes, zero where the lumen is not, or in the lumen's elements."""
        taken = self._taken
        arrays = grid.of_points if where == "nodes" else grid.of_cells
        if name not in arrays:
            raise UnusableReferenceError(
                f"{file}: reference.{key}: no array {name!r} of {where}, as in other states; "
                f"there are: {_listed(grid)}"
            )
        array = np.asarray(arrays[name], dtype=float)
        array = array[:, 0] if key == "pressure" and array.ndim == 2 else array
        values = array[taken.nodes] if where == "nodes" else array[taken.cells]
        inside = values[taken.in_lumen] if where == "nodes" else values
        bare = np.isnan(inside) if inside.ndim == 1 else np.isnan(inside).any(axis=1)
        if bare.any():
            raise UnusableReferenceError(
                f"{file}: {np.count_nonzero(bare)} of {len(bare)} {where} of the lumen have no {key} ({name})"
            )
        return np.asarray(np.where(np.isnan(values), 0.0, values))

    def _refuse_another_mesh(self, grid: Grid, taken: _Taken, file: str) -> None:
        if _fingerprint(grid) != taken.fingerprint:
            raise UnusableReferenceError(
                f"{file}: another mesh than in the first file ({len(grid.points)} points, "
                f"{len(grid.types)} cells); allowed: one mesh in all states"
            )
        if len(taken.points):
            moved = np.abs(grid.points - taken.points).max()
            if moved > APART * taken.size:
                raise UnusableReferenceError(
                    f"{file}: points differ by up to {self.stated.length_unit * moved:.3g} m from the first "
                    "file's, so that they are deformed ones; allowed: reference.positions deformed"
                )


def _listed(grid: Grid) -> str:
    """Names of the arrays."""

    def of(arrays: Mapping[str, NDArray[Any]]) -> str:
        return ", ".join(sorted(arrays)) or "none"

    return f"of points: {of(grid.of_points)}; of cells: {of(grid.of_cells)}"


def _renumbered(blocks: list[Block], place: Integers) -> list[Block]:
    return [Block(block.kind, place[block.nodes]) for block in blocks]


def _fingerprint(grid: Grid) -> bytes:
    digest = blake2b(len(grid.points).to_bytes(8, "little"), digest_size=16)
    for array in (grid.types, grid.starts, grid.nodes):
        digest.update(np.ascontiguousarray(array, dtype=np.int64).data)
    return digest.digest()
