"""Results on disk: NetCDF-4, written whole or not at all."""

import os
from pathlib import Path

import xarray as xr

from solver.errors import SolverError


def check_folder(path: Path) -> None:
    """Refuse a result file whose folder does not exist, before the run that would fill it.

    Raises
    ------
    SolverError
        If it does not exist.
    """
    if not path.absolute().parent.is_dir():
        raise SolverError(f"{path}: its folder does not exist")


def write_netcdf(dataset: xr.Dataset, path: Path) -> None:
    """Write ``dataset`` to ``path``, replacing an older file only by a complete new one.

    Raises
    ------
    SolverError
        If the file cannot be written.
    """
    partial = path.with_name(f".{path.name}.{os.getpid()}.part")
    encoding = {name: {"zlib": True, "complevel": 1, "shuffle": True} for name in dataset.data_vars}
    try:
        dataset.to_netcdf(partial, engine="netcdf4", encoding=encoding)
        partial.replace(path)
    except OSError as error:
        raise SolverError(f"{path}: cannot be written: {error.strerror or error}") from error
    finally:
        partial.unlink(missing_ok=True)
