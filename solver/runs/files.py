"""Results on disk: where they may be written."""

import os
from pathlib import Path

from solver.errors import SolverError


def check_folder(path: Path) -> None:
    """Refuse a result file that cannot be written, before the run that would fill it.

    Raises
    ------
    SolverError
        If its folder does not exist or cannot be written to, or it is a folder itself.
    """
    folder = path.absolute().parent
    if not folder.is_dir():
        raise SolverError(f"{path}: its folder does not exist")
    if path.is_dir():
        raise SolverError(f"{path}: is a folder, not a result file")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise SolverError(f"{path}: its folder cannot be written to")


def pieces_folder(result: Path) -> Path:
    """Folder of the pieces of a result file."""
    return result.with_name(result.name + ".pieces")
