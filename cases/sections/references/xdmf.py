"""``reference.kind: xdmf``: series of XDMF, with HDF5 or text, as FEniCS and turtleFSI write them."""

from pathlib import Path
from typing import Annotated, Literal

from cases.sections.references.grid import GridReference
from cases.values.file_series import SERIES, FileSeries
from cases.values.kinds import one_of


class XdmfReference(GridReference):
    """States in XDMF files of one mesh.

    Attributes
    ----------
    result_files : tuple of FileSeries
        Each with some of the arrays: series of the same times, or files without times whose arrays hold for
        all states.
    """

    kind: Annotated[Literal["xdmf"], one_of(Literal["xdmf"])]
    result_files: Annotated[tuple[FileSeries, ...], SERIES]

    @property
    def files(self) -> tuple[Path, ...]:
        """Absolute paths of all files that are read."""
        return tuple(path for part in self.result_files for path in (*part.paths, *part.companions))
