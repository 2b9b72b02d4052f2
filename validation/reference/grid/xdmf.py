"""The kind of reference ``xdmf``."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

from cases.sections.references.xdmf import XdmfReference
from validation.reference.grid.series import GridSeries
from validation.reference.grid.xdmf_files import XdmfFiles, opened
from validation.reference.mesh.read import mesh_kind


@contextmanager
def open_series(stated: XdmfReference) -> Iterator[GridSeries]:
    """Open the files of a series.

    Raises
    ------
    UnusableReferenceError
        If one cannot be read.
    """
    with ExitStack() as stack:
        files = [stack.enter_context(opened(part.paths[0])) for part in stated.result_files]
        yield GridSeries(XdmfFiles(stated, files), stated)


KIND = mesh_kind(XdmfReference, open_series)
