"""What files of a 3D result hold, in lines, and the section of a case file that reads them."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cases.arrays import Flags, Floats
from validation.reference.grid.cells import type_name
from validation.reference.grid.contents import Grid
from validation.reference.inspection.files import Contents, looked_at
from validation.reference.inspection.guesses import (
    PRESSURE,
    VELOCITY,
    Domains,
    Ends,
    displacement_of,
    domains_of,
    ends_of,
    length_unit,
    named,
    nodes_of,
    pressure_unit,
)


def page(names: Sequence[str]) -> list[str]:
    """Lines about the files of one result.

    Raises
    ------
    UnusableReferenceError, FebioError
        If they cannot be read, or have no velocity.
    """
    with looked_at(names) as contents:
        return [*_held(contents), *_proposed(contents)]


def _held(contents: Contents) -> list[str]:
    grid, times = contents.last, contents.times
    told = "not in the files" if times is None else f"{times[0]:.6g} to {times[-1]:.6g}"
    kinds, counts = np.unique(grid.types, return_counts=True)
    cells = ", ".join(f"{n} {type_name(t)}" for t, n in zip(kinds.tolist(), counts.tolist(), strict=True))
    low, high = grid.points.min(axis=0), grid.points.max(axis=0)
    box = ", ".join(f"{axis} {a:.6g} to {b:.6g}" for axis, a, b in zip("xyz", low, high, strict=True))
    return [
        f"states: {contents.count}; times: {told}",
        f"mesh: {len(grid.points)} points; cells: {cells}",
        f"bounding box of the points: {box}",
        *_arrays("of points", grid.of_points),
        *_arrays("of cells", grid.of_cells),
        *([f"blocks: {', '.join(p.block for p in grid.pieces)}"] if grid.pieces[0].block else []),
    ]


def _arrays(where: str, arrays: Mapping[str, NDArray[Any]]) -> list[str]:
    lines = [f"arrays {where} in the last state:" + ("" if arrays else " none")]
    for name, values in arrays.items():
        parts = f"{values.shape[1]} components" if values.ndim == 2 else "1 component"
        finite = values[np.isfinite(values)]
        spread = f"{finite.min():.6g} to {finite.max():.6g}" if finite.size else "nothing finite"
        lines.append(f"  {name}: {parts}, {spread}")
    return lines


def _proposed(contents: Contents) -> list[str]:
    grid, last = contents.first, contents.last
    both = dict(last.of_points) | dict(last.of_cells)
    velocities, pressures = named(both, VELOCITY, 3), named(both, PRESSURE, 1)
    if not velocities or not pressures:
        missing = "velocity" if not velocities else "pressure"
        return ["", f"no section: no array is named as a {missing} would be; allowed: one of those above"]
    velocity, pressure = velocities[0], pressures[0]
    domains = domains_of(grid, last, velocity)
    lumen = np.ones(len(grid.types), dtype=bool)
    if domains is not None:
        lumen = np.isin(grid.of_cells[domains.array], domains.lumen)
    ends = ends_of(grid, last, lumen, velocity)
    stated = _files(contents) + _frame(ends) + _units(contents, lumen, pressure, ends)
    if contents.kind == "febio":
        stated += _febio_domains(contents, domains)
    else:
        stated += _named_arrays(contents, velocity, pressure) + _selections(domains)
    about = [] if domains is None else _extents(grid, domains)
    return [*about, "", "reference: # guesses by names and values; check each", *(f"  {s}" for s in stated)]


def _files(contents: Contents) -> list[str]:
    if contents.kind == "febio":
        return ["kind: febio", f"plot_file: {contents.stated}"]
    listed = contents.stated if isinstance(contents.stated, str) else ", ".join(contents.stated)
    files = f'"{listed}"' if isinstance(contents.stated, str) else f"[{listed}]"
    untold = contents.times is None
    rule = (
        ["time_step: to be stated # not in the files: time between numbers that differ by one"]
        if untold
        else []
    )
    return [f"kind: {contents.kind}", f"result_files: {files}", *rule, "time_offset: 0 s # start of a cycle"]


def _frame(ends: Ends) -> list[str]:
    inlet = ends.centres[0 if ends.forward else 1]
    axis = ends.axis
    backwards = [0 if name != axis else -1 for name in "xyz"]
    stated = axis if ends.forward else str(backwards)
    planes = f"{ends.nodes[0]} and {ends.nodes[1]} nodes in the planes of its ends"
    lines = [f"axis: {stated} # the lumen's longest extent, along the flow of the last state; {planes}"]
    if np.abs(inlet).max() > 1e-3 * ends.length:
        unit = length_unit(ends.radius)
        lines.append("origin: [" + ", ".join(f"{x:.6g} {unit}" for x in inlet) + "]")
    return lines


def _units(contents: Contents, lumen: Flags, pressure: str, ends: Ends) -> list[str]:
    last = contents.last
    if pressure in last.of_points:
        values = last.of_points[pressure][nodes_of(last, lumen)]
    else:
        values = last.of_cells[pressure][lumen]
    mean = float(np.nanmean(np.abs(values)))
    length, unit = length_unit(ends.radius), pressure_unit(mean)
    sizes = f"length {ends.length:.4g}, radius {ends.radius:.4g}; pressure {mean:.4g} on average"
    return [f"length_unit: {length} # lumen: {sizes}", f"pressure_unit: {unit}"]


def _named_arrays(contents: Contents, velocity: str, pressure: str) -> list[str]:
    lines = [f"velocity: {velocity} # must be absolute", f"pressure: {pressure}"]
    displacement = displacement_of(contents.last)
    if displacement is not None:
        lines.append(f"displacement: {displacement}")
    moved = _moved(contents)
    if moved or displacement is not None:
        lines.append(f"positions: {'deformed' if moved else 'reference'}")
    return lines


def _moved(contents: Contents) -> bool:
    first, last = contents.first.points, contents.last.points
    return first.shape == last.shape and bool(np.abs(last - first).max() > 1e-6 * np.ptp(first))


def _selections(domains: Domains | None) -> list[str]:
    if domains is None:
        return ["# no array tells lumen from wall: the surface of all cells is taken as the wall"]
    parts = (("lumen", domains.lumen), ("wall", domains.wall))
    return [
        f"{name}: {{array: {domains.array}, values: [{', '.join(f'{v:g}' for v in values)}]}}"
        for name, values in parts
        if values
    ]


def _febio_domains(contents: Contents, domains: Domains | None) -> list[str]:
    if domains is None:
        return []
    parts = (("lumen", domains.lumen), ("wall", domains.wall))
    return [
        f"{name}: [{', '.join(contents.domains.get(int(v), str(v)) for v in values)}]"
        for name, values in parts
        if values
    ]


def _extents(grid: Grid, domains: Domains) -> list[str]:
    """Lines of where each domain lies."""
    lines = [f"domains by {domains.array}:"]
    for value in domains.values.tolist():
        cells = grid.of_cells[domains.array] == value
        points: Floats = grid.points[nodes_of(grid, cells)]
        low, high = points.min(axis=0), points.max(axis=0)
        box = ", ".join(f"{axis} {a:.4g} to {b:.4g}" for axis, a, b in zip("xyz", low, high, strict=True))
        what = "blood" if value in domains.lumen else "wall"
        lines.append(f"  {value:g}: {int(cells.sum())} cells, {box}; by its speed {what}")
    return lines
