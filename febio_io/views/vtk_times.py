"""Meshes over time in one VTKHDF file, made one by one as VTK's writer asks for them."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOHDF import vtkHDFWriter

from cases.shell.interrupts import interrupts_told_to
from febio_io.errors import FebioFileError

Mesh = Callable[[int], Any]


class _Source(VTKPythonAlgorithmBase):
    """A source in VTK's sense: makes the mesh of the time that is asked for."""

    def __init__(self, times: list[float], mesh_at: Mesh, advance: Callable[[], None]) -> None:
        super().__init__(  # type: ignore[no-untyped-call] # VTK's wrapping has no types
            nInputPorts=0, nOutputPorts=1, outputType="vtkUnstructuredGrid"
        )
        self._times, self._mesh_at, self._advance = times, mesh_at, advance
        self._made = mesh_at(0)  # VTK's writer needs a mesh, whatever fails later
        self.failure: BaseException | None = None

    def interrupt(self, _signal: object) -> None:
        """Make no more meshes: an interrupt is kept like any failure."""
        self.failure = KeyboardInterrupt()

    def RequestInformation(self, _request: Any, _inputs: Any, outputs: Any) -> int:
        """Tell the times."""
        information = outputs.GetInformationObject(0)
        information.Set(vtkStreamingDemandDrivenPipeline.TIME_STEPS(), self._times, len(self._times))
        information.Set(vtkStreamingDemandDrivenPipeline.TIME_RANGE(), [self._times[0], self._times[-1]], 2)
        return 1

    def RequestData(self, _request: Any, _inputs: Any, outputs: Any) -> int:
        """Make the mesh. VTK cannot pass on an exception: it is kept, and the last mesh comes again."""
        key = vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP()
        information = outputs.GetInformationObject(0)
        time = information.Get(key) if information.Has(key) else self._times[0]
        output = self.GetOutputData(outputs, 0)  # type: ignore[no-untyped-call]
        if self.failure is None:
            try:
                self._made = self._mesh_at(self._times.index(time))
                self._advance()
            except BaseException as error:  # noqa: BLE001 - raised again when VTK has returned
                self.failure = error
        output.ShallowCopy(self._made)
        output.GetInformation().Set(output.DATA_TIME_STEP(), time)
        return 1


def write_over_time(
    path: Path, times: list[float], mesh_at: Mesh, advance: Callable[[], None] = lambda: None
) -> None:
    """Write meshes of all times into one VTKHDF file, for ParaView.

    Parameters
    ----------
    path : Path
        The file.
    times : list of float
        Increasing, one or more.
    mesh_at : callable
        Makes the mesh of a time, an unstructured grid, by its number.
    advance : callable, optional
        Called for each mesh that is written.

    Raises
    ------
    FebioFileError
        If the file cannot be written; what making a mesh raises is raised again.
    """
    source = _Source(times, mesh_at, advance)
    writer = vtkHDFWriter()
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetFileName(str(path))
    writer.SetWriteAllTimeSteps(True)
    with interrupts_told_to(source.interrupt):  # VTK would swallow one where it calls back
        done = writer.Write()
    if source.failure is not None:
        raise source.failure
    if not done or not path.is_file():
        raise FebioFileError(f"{path.name}: cannot be written")
