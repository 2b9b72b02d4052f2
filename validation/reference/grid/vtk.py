"""The kind of reference ``vtk``."""

from collections.abc import Iterator
from contextlib import contextmanager

from cases.sections.references.vtk import VtkReference
from validation.reference.grid.series import GridSeries
from validation.reference.grid.vtk_files import VtkFiles
from validation.reference.mesh.read import mesh_kind


@contextmanager
def open_series(stated: VtkReference) -> Iterator[GridSeries]:
    """Open the files of a series; nothing stays open between two states."""
    yield GridSeries(VtkFiles(stated), stated)


KIND = mesh_kind(VtkReference, open_series)
