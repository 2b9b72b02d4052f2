"""Writes plot files for ParaView: a .vtu file for each state and a .pvd file, or one VTKHDF file."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np
import pyvista as pv
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from febio_io.errors import FebioFileError, FebioKeyError
from febio_io.views.grids import to_pyvista
from febio_io.views.staging import safe_name
from febio_io.views.vtk_times import write_over_time
from febio_io.xplt import Plot, Variable
from febio_io.xplt.dictionary import SectionName
from febio_io.xplt.whole import quantities, regions_in, values_in

Grid = Callable[[int], pv.UnstructuredGrid]
Advance = Callable[[], None]
REGION_SECTIONS: tuple[SectionName, ...] = ("surface", "edge")


def write_vtu(
    plot: Plot, folder: Path, variables: tuple[Variable, ...], states: list[int], advance: Advance
) -> None:
    """Write a .vtu file for each state, and a .pvd file that tells their times; surfaces with values apart.

    Raises
    ------
    FebioFileError
        If a file cannot be written.
    FebioKeyError
        If states of one time are to be written, which ParaView cannot tell apart.
    """
    check_times(plot, states)
    for part in _parts(plot, variables, states):
        entries = []
        for state in part.states:
            file = f"{part.name}_{state:04d}.vtu"
            _write_grid(part.grid(state), folder / file)
            advance()
            entries.append(
                f'    <DataSet timestep="{plot.times[state]:.9g}" part="0" file={quoteattr(file)}/>\n'
            )
        text = '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n  <Collection>\n'
        text += "".join(entries) + "  </Collection>\n</VTKFile>\n"
        (folder / f"{part.name}.pvd").write_text(text, encoding="utf-8")


def write_vtkhdf(
    plot: Plot, folder: Path, variables: tuple[Variable, ...], states: list[int], advance: Advance
) -> None:
    """Write one VTKHDF file with all states; surfaces with values apart.

    Raises
    ------
    FebioFileError
        If a file cannot be written.
    FebioKeyError
        If there are no states, or several of one time, which the format cannot tell apart.
    """
    check_times(plot, states)
    if not states:
        raise FebioKeyError(f"{plot.path}: no states to write")
    for part in _parts(plot, variables, states):
        path = folder / f"{part.name}.vtkhdf"
        times = plot.times[part.states].tolist()
        write_over_time(path, times, part.mesh, advance)


def check_times(plot: Plot, states: list[int]) -> None:
    """Refuse states whose times do not increase.

    Raises
    ------
    FebioKeyError
        If they do not.
    """
    times = plot.times[states]
    for place in np.flatnonzero(~(np.diff(times) > 0))[:1]:
        raise FebioKeyError(
            f"{plot.path}: states {states[place]} and {states[place + 1]} have times {times[place]:g} and "
            f"{times[place + 1]:g}; choose states whose times increase"
        )


@dataclass(frozen=True)
class _Part:
    """One series of meshes: name of its files, its states, and how to make the mesh of one."""

    name: str
    states: list[int]
    grid: Grid

    def mesh(self, place: int) -> pv.UnstructuredGrid:
        """Make the mesh of one of its states, by its place among them."""
        return self.grid(self.states[place])


def _parts(plot: Plot, variables: tuple[Variable, ...], states: list[int]) -> list[_Part]:
    """List what is written: the whole mesh, and each surface and edge that has values in some state."""
    stem = safe_name(plot.path.stem)
    parts = [_Part(stem, states, lambda state: to_pyvista(plot, state, variables=variables))]
    for section in REGION_SECTIONS:
        found: dict[int, list[int]] = {}
        for state in states:
            for quantity in quantities(variables, (section,)):
                for number in values_in(plot, quantity, state):
                    found.setdefault(number, [])
        for state in states:
            for region in regions_in(plot.mesh_of(state), section):
                if region.region in found:
                    found[region.region].append(state)
        for number, present in sorted(found.items()):
            name = _region_name(plot, present[0], section, number)
            taken = {part.name for part in parts}
            unique = f"{stem}_{name}" if f"{stem}_{name}" not in taken else f"{stem}_{name}_{number}"
            parts.append(_Part(unique, present, _region_grid(plot, variables, section, number)))
    return parts


def _region_name(plot: Plot, state: int, section: SectionName, number: int) -> str:
    regions = regions_in(plot.mesh_of(state), section)
    name = next(region.name for region in regions if region.region == number)
    return safe_name(name) if name else f"{section}_{number}"


def _region_grid(plot: Plot, variables: tuple[Variable, ...], section: SectionName, number: int) -> Grid:
    surface, edge = (number, None) if section == "surface" else (None, number)
    return lambda state: to_pyvista(plot, state, surface=surface, edge=edge, variables=variables)


def _write_grid(grid: pv.UnstructuredGrid, path: Path) -> None:
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetFileName(str(path))
    if not writer.Write() or not path.is_file():
        raise FebioFileError(f"{path.name}: cannot be written")
