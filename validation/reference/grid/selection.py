"""Which cells of the files are blood, wall and calcified wall."""

from typing import NamedTuple

import numpy as np

from cases.arrays import Flags
from cases.sections.references.grid import GridReference, Selection
from validation.errors import UnusableReferenceError
from validation.reference.grid.contents import Grid

MOST_SHOWN = 12


class Chosen(NamedTuple):
    """Cells, (n_cells,) each; ``wall`` and ``calcified`` may have none."""

    lumen: Flags
    wall: Flags
    calcified: Flags
    notes: tuple[str, ...]


def choose_cells(grid: Grid, stated: GridReference) -> Chosen:
    """Cells that the case means.

    Raises
    ------
    UnusableReferenceError
        If there are none, or one is lumen and wall.
    """
    nothing = np.zeros(len(grid.types), dtype=bool)
    wall = nothing if stated.wall is None else _cells(grid, stated.wall, "wall")
    lumen = ~wall if stated.lumen is None else _cells(grid, stated.lumen, "lumen")
    calcified = nothing if stated.calcified is None else _cells(grid, stated.calcified, "calcified")
    for name, chosen in (("lumen", lumen), ("wall", wall)):
        if not chosen.any() and (name == "lumen" or stated.wall is not None):
            raise UnusableReferenceError(f"reference.{name}: no cells")
    both = int(np.count_nonzero(lumen & wall))
    if both:
        raise UnusableReferenceError(f"reference.lumen and reference.wall: {both} cells are in both")
    if np.any(calcified & ~wall):
        raise UnusableReferenceError(
            f"reference.calcified: {np.count_nonzero(calcified & ~wall)} cells are not in reference.wall"
        )
    left = int(np.count_nonzero(~(lumen | wall)))
    notes = (f"{left} of {left + int(np.count_nonzero(lumen | wall))} cells are neither lumen nor wall",)
    return Chosen(lumen, wall, calcified, notes if left else ())


def _cells(grid: Grid, stated: Selection, what: str) -> Flags:
    if stated.array is None:
        return _cells_of_pieces(grid, stated, what)
    if stated.array not in grid.of_cells:
        have = ", ".join(sorted(grid.of_cells)) or "none"
        raise UnusableReferenceError(
            f"reference.{what}.array: no array {stated.array!r} of cells; there are: {have}"
        )
    values = grid.of_cells[stated.array]
    if values.ndim != 1:
        raise UnusableReferenceError(
            f"reference.{what}.array: {stated.array!r} has {values.shape[1]} numbers a cell; allowed: one"
        )
    missing = [value for value in stated.values or () if not np.any(values == value)]
    if missing:
        there = np.unique(values[np.isfinite(values)])
        have = ", ".join(f"{value:g}" for value in there[:MOST_SHOWN])
        more = f" and {there.size - MOST_SHOWN} others" if there.size > MOST_SHOWN else ""
        raise UnusableReferenceError(
            f"reference.{what}.values: no cell has {stated.array} {missing[0]:g}; there are: {have}{more}"
        )
    return np.isin(values, stated.values or ())


def _cells_of_pieces(grid: Grid, stated: Selection, what: str) -> Flags:
    by_file = stated.file is not None
    names = [piece.file if by_file else piece.block for piece in grid.pieces]
    wanted = stated.file if by_file else stated.block
    if wanted not in names:
        have = ", ".join(dict.fromkeys(name for name in names if name)) or "none"
        key = "file" if by_file else "block"
        raise UnusableReferenceError(f"reference.{what}.{key}: no {key} {wanted!r}; there are: {have}")
    return np.isin(grid.piece, [k for k, name in enumerate(names) if name == wanted])
