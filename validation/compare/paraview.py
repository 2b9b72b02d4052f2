"""Both models' lumen wall over the cycle, with the cells' values, for ParaView: a VTKHDF file each."""

from pathlib import Path
from typing import Any

import numpy as np
import pyvista as pv
import xarray as xr
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOHDF import vtkHDFWriter

from cases.arrays import Floats, Integers
from cases.fields import CELL, FIELDS
from cases.quantities import tabulated
from cases.results.comparison_file import CALCIFIED, MODELS, WALL_STIFFNESS, variable
from cases.shell.interrupts import interrupts_deferred
from validation.errors import ValidationError


def edges(centres: Floats) -> Floats:
    """Edges of uniform cells with these centres, (n + 1,)."""
    half = 0.5 * (centres[1] - centres[0])
    return np.append(centres - half, centres[-1] + half)


def quadrilaterals(n_x: int, n_phi: int) -> Integers:
    """Corners of the cells on a closed grid of (n_x + 1) × n_phi points, (n_x n_phi, 4)."""
    i, j = np.divmod(np.arange(n_x * n_phi), n_phi)
    beside = (j + 1) % n_phi
    return np.column_stack([i * n_phi + j, (i + 1) * n_phi + j, (i + 1) * n_phi + beside, i * n_phi + beside])


def wall_points(x: Floats, phi: Floats, radius: Floats) -> Floats:
    """Corners of the cells on the wall, ((n_x + 1) n_phi, 3): radii are means of the cells around.

    Parameters
    ----------
    x : ndarray (n_x,)
        Centres of the cells, m.
    phi : ndarray (n_phi,)
        rad.
    radius : ndarray (n_x, n_phi)
        Of the cells, m.
    """
    ends = np.concatenate([radius[:1], 0.5 * (radius[1:] + radius[:-1]), radius[-1:]])
    corners = 0.5 * (ends + np.roll(ends, 1, axis=1))
    along, around = np.meshgrid(edges(x), edges(phi)[:-1], indexing="ij")
    return np.stack([along, corners * np.cos(around), corners * np.sin(around)], axis=-1).reshape(-1, 3)


class _Wall(VTKPythonAlgorithmBase):
    """A source in VTK's sense: the wall at the time that is asked for."""

    def __init__(self, model: str, both: xr.Dataset) -> None:
        super().__init__(  # type: ignore[no-untyped-call] # VTK's wrapping has no types
            nInputPorts=0, nOutputPorts=1, outputType="vtkPolyData"
        )
        self._times = both["time"].to_numpy().tolist()
        self._axes = both["x"].to_numpy(), both["phi"].to_numpy()
        cells = [name for name in tabulated() if FIELDS[name].dims == CELL]
        self._fields = {name: both[variable(model, name)].to_numpy() for name in cells}
        quads = quadrilaterals(*(axis.size for axis in self._axes))
        self._faces = np.column_stack([np.full(len(quads), 4), quads]).ravel()
        self._still = {
            WALL_STIFFNESS: both[WALL_STIFFNESS].to_numpy().astype(np.float32),
            CALCIFIED: both[CALCIFIED].to_numpy(),
        }

    def RequestInformation(self, _request: Any, _inputs: Any, outputs: Any) -> int:
        """Tell the times."""
        information = outputs.GetInformationObject(0)
        information.Set(vtkStreamingDemandDrivenPipeline.TIME_STEPS(), self._times, len(self._times))
        information.Set(vtkStreamingDemandDrivenPipeline.TIME_RANGE(), [self._times[0], self._times[-1]], 2)
        return 1

    def RequestData(self, _request: Any, _inputs: Any, outputs: Any) -> int:
        """Make the wall."""
        key = vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP()
        information = outputs.GetInformationObject(0)
        time = information.Get(key) if information.Has(key) else self._times[0]
        output = self.GetOutputData(outputs, 0)  # type: ignore[no-untyped-call]
        output.ShallowCopy(self.wall(int(np.argmin(np.abs(np.array(self._times) - time)))))
        output.GetInformation().Set(output.DATA_TIME_STEP(), time)
        return 1

    def wall(self, state: int) -> pv.PolyData:
        """Surface of one state with the values of its cells."""
        points = wall_points(*self._axes, self._fields["radius"][state])
        surface = pv.PolyData(points.astype(np.float32), faces=self._faces)
        for name, values in self._fields.items():
            surface.cell_data[name] = values[state].ravel().astype(np.float32)
        for name, still in self._still.items():
            surface.cell_data[name] = still.ravel()
        return surface


def write_walls(directory: Path, variant: str, both: xr.Dataset) -> None:
    """Write ``rom_<variant>.vtkhdf`` and ``reference_<variant>.vtkhdf``; a model without radii is left out.

    Raises
    ------
    ValidationError
        If a file cannot be written.
    """
    for model in MODELS:
        if np.any(np.isnan(both[variable(model, "radius")])):
            continue
        source = _Wall(model, both)
        path = directory / f"{model}_{variant}.vtkhdf"
        writer = vtkHDFWriter()
        writer.SetInputConnection(source.GetOutputPort())
        writer.SetFileName(str(path))
        writer.SetWriteAllTimeSteps(True)
        with interrupts_deferred():  # VTK would lose an exception raised where it calls back
            done = writer.Write()
        if not done or not path.is_file():
            raise ValidationError(f"{path.name}: cannot be written")
