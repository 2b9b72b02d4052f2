"""Results on disk: NetCDF-4, written whole or not at all."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from cases.shell.whole import write_whole, writing
from solver.errors import SolverError

if TYPE_CHECKING:
    import xarray as xr


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


def write_netcdf(dataset: xr.Dataset, path: Path, unlimited: tuple[str, ...] = ()) -> None:
    """Write ``dataset`` to ``path``, replacing an older file only by a complete new one.

    Nothing is compressed: that would halve the file and take longer than the run.

    Raises
    ------
    SolverError
        If the file cannot be written.
    """
    import netCDF4
    from xarray.backends import NetCDF4DataStore

    try:
        with (
            writing(path, SolverError),
            write_whole(path) as partial,
            netCDF4.Dataset(partial, "w") as stored,
        ):
            # what to_netcdf writes, without its question for Dask's schedulers: their import takes a second
            store = NetCDF4DataStore(stored)  # type: ignore[no-untyped-call]
            dataset.dump_to_store(store, unlimited_dims=unlimited)
    except RuntimeError as error:  # so netCDF reports a full disk
        raise SolverError(f"{path}: cannot be written: {error}") from error
