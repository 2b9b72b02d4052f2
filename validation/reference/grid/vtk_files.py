"""Files that VTK reads, one state at a time."""

import re
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pyvista as pv
from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from cases.arrays import Floats
from cases.sections.references.vtk import VtkReference
from cases.values.file_series import FileSeries
from validation.errors import UnusableReferenceError
from validation.reference.grid.contents import Grid, Piece, joined

TIME_STEPS = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
ERROR = re.compile(r"(?:ERROR: In [^\n]*\n|ERR\|)[^\n]*?\): ([^\n]+)")  # in VTK's output window
ONE_AT_A_TIME = threading.Lock()  # VTK's output window, which errors go to, is one for all threads


class NoTimeError(UnusableReferenceError):
    """Neither the files nor the case state times."""


@dataclass(frozen=True)
class VtkFiles:
    """A :class:`validation.reference.grid.contents.GridFiles` of what VTK reads."""

    stated: VtkReference

    @property
    def name(self) -> str:
        """First file."""
        return str(self.stated.parts[0].paths[0])

    @property
    def software(self) -> str:
        """Library that read them: the files do not tell who wrote them."""
        return f"read by VTK {pv.vtk_version_info}".replace(" (", " ").replace(", ", ".").rstrip(")")

    @cached_property
    def times(self) -> Floats:
        """Times of the states, s.

        Raises
        ------
        UnusableReferenceError
            If neither the files nor the case state them.
        """
        stated = self.stated
        part = stated.parts[0]
        own = part.times if part.times is not None else self._own_times
        if stated.time_step is not None:
            if own is not None:
                raise UnusableReferenceError(
                    "reference.time_step: the files state their times; allowed: no time_step"
                )
            return stated.time_step * np.array(part.numbers, dtype=float)
        if own is None:
            own = tuple(_time_value(path) for path in part.paths)
        return stated.time_unit * np.array(own, dtype=float)

    @property
    def count(self) -> int:
        """Number of states."""
        return len(self._own_times or self.stated.parts[0].paths)

    @property
    def times_if_told(self) -> Floats | None:
        """Times of the states in the files' unit; None where they do not tell."""
        try:
            return self.times
        except NoTimeError:
            return None

    @cached_property
    def _own_times(self) -> tuple[float, ...] | None:
        """Times in files of all states, which must be the same; None where there is a file for each state."""
        alone = [part.paths[0] for part in self.stated.parts if len(part.paths) == 1]
        times = {path.name: times for path in alone if (times := _times_in(path))}
        for name, other in times.items():
            if other != next(iter(times.values())):
                raise UnusableReferenceError(f"{name}: other times than {next(iter(times))}")
        return next(iter(times.values()), None)

    def first(self) -> Grid:
        """Return the first state of all files there are, also of those before ``first``."""
        return self._read(tuple((part, 0) for part in self.stated.result_files), 0)

    def state(self, number: int) -> Grid:
        """Return a state."""
        return self._read(
            tuple((part, number if len(part.paths) > 1 else 0) for part in self.stated.parts), number
        )

    def file_of(self, number: int) -> str:
        """Return the name of a state's file, with the state in a file of several."""
        paths = self.stated.parts[0].paths
        return paths[number].name if len(paths) > 1 else f"{paths[0].name}, state {number + 1}"

    def _read(self, files: tuple[tuple[FileSeries, int], ...], number: int) -> Grid:
        grids: list[Grid] = []
        for part, place in files:
            with _vtk_reader(part.paths[place]) as reader:
                times = _times_of(reader) if len(part.paths) == 1 else ()
                if times:
                    reader.UpdateTimeStep(times[number])
                else:
                    reader.Update()
                grids.extend(_leaves(pv.wrap(reader.GetOutputDataObject(0)), part.stated, ""))
        solid = [grid for grid in grids if _is_solid(grid)] or grids
        if not solid:
            raise UnusableReferenceError(f"{files[0][0].paths[files[0][1]].name}: no cells")
        return joined(solid)


@contextmanager
def _vtk_reader(path: Path) -> Iterator[Any]:
    """Open a file with VTK's reader of its kind; what VTK says of errors is raised."""
    with ONE_AT_A_TIME:
        said = vtkStringOutputWindow()
        usual, loud = vtkOutputWindow.GetInstance(), vtkLogger.GetCurrentVerbosityCutoff()
        vtkOutputWindow.SetInstance(said)
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
        try:
            found = pv.get_reader(path)  # type: ignore[no-untyped-call]
            if isinstance(found, pv.OpenFOAMReader):
                found.cell_to_point_creation = False  # its values are of cells; means at nodes slip at walls
            reader = found.reader
            reader.UpdateInformation()
            yield reader
        except (ValueError, OSError, RuntimeError) as error:
            reason = " ".join(str(error).split())
            raise UnusableReferenceError(f"{path.name}: VTK cannot read it: {reason}") from error
        finally:
            vtkOutputWindow.SetInstance(usual)
            vtkLogger.SetStderrVerbosity(loud)
        told = ERROR.search(said.GetOutput())
    if told:
        raise UnusableReferenceError(f"{path.name}: VTK cannot read it whole: {told[1]}")


def _times_in(path: Path) -> tuple[float, ...]:
    with _vtk_reader(path) as reader:
        return _times_of(reader)


def _times_of(reader: Any) -> tuple[float, ...]:
    information = reader.GetOutputInformation(0)
    return tuple(information.Get(TIME_STEPS)) if information.Has(TIME_STEPS) else ()


def _time_value(path: Path) -> float:
    with _vtk_reader(path) as reader:
        reader.Update()
        fields = pv.wrap(reader.GetOutputDataObject(0)).field_data
        if "TimeValue" not in fields:
            raise NoTimeError(
                f"{path.name}: no time in the file (no field data TimeValue); allowed: reference.time_step, "
                "the time between files whose numbers differ by one, or a .pvd file"
            )
        return float(fields["TimeValue"][0])


def _leaves(found: Any, file: str, block: str) -> Iterator[Grid]:
    """Give the grids of what was read, blocks in blocks by the names of all."""
    if isinstance(found, pv.MultiBlock):
        for number, inner in enumerate(found):
            name = found.get_block_name(number) or str(number)
            if inner is not None:
                yield from _leaves(inner, file, f"{block}/{name}".strip("/"))
        return
    grid = found if isinstance(found, pv.UnstructuredGrid) else found.cast_to_unstructured_grid()
    if grid.n_cells:
        yield grid_of(grid, file, block)


def grid_of(grid: pv.UnstructuredGrid, file: str, block: str = "") -> Grid:
    """Return a grid of VTK as one piece."""
    return Grid(
        np.asarray(grid.points),
        grid.celltypes.astype(np.int64),
        grid.cell_offsets.astype(np.int64),
        grid.cell_connectivity.astype(np.int64),
        {name: np.asarray(grid.point_data[name]) for name in grid.point_data},
        {name: np.asarray(grid.cell_data[name]) for name in grid.cell_data},
        (Piece(file, block),),
        np.zeros(grid.n_cells, dtype=np.int64),
    )


def _is_solid(grid: Grid) -> bool:
    """Tell whether any cell has a volume: patches of a boundary have none."""
    dimensions = [pv.CellType(cell_type).dimension for cell_type in np.unique(grid.types).tolist()]
    return max(dimensions) == 3
