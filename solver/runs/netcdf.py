"""Results on disk: NetCDF-4, written whole or not at all."""

from pathlib import Path
from typing import Any

from netCDF4 import Dataset

from cases.arrays import Floats
from cases.fields import FIELDS
from cases.shell.whole import write_whole, writing
from solver.errors import SolverError
from solver.runs.result import AXES, CONVENTIONS, words_of


def write_netcdf(
    path: Path, axes: dict[str, Floats], fields: dict[str, Floats], attributes: dict[str, Any]
) -> None:
    """Write fields to ``path``, replacing an older file only by a complete new one; time can grow.

    As xarray would write them, to the byte; loading it takes longer than many a run. Nothing is compressed:
    that would halve the file and take longer still.

    Parameters
    ----------
    path : Path
    axes : dict of ndarray
        Values of :data:`solver.runs.result.AXES`, by name.
    fields : dict of ndarray
        From :func:`solver.runs.result.cell_fields`.
    attributes : dict
        Global ones.

    Raises
    ------
    SolverError
        If the file cannot be written.
    """
    try:
        with (
            writing(path, SolverError),
            write_whole(path) as partial,
            Dataset(partial, "w") as stored,
        ):
            stored.setncatts({"Conventions": CONVENTIONS, **attributes})
            for name, values in axes.items():
                stored.createDimension(name, None if name == "time" else values.size)
            for name, values in axes.items():
                _store(stored, name, values, (name,), AXES[name])
            for name, values in fields.items():
                _store(stored, name, values, FIELDS[name].dims, words_of(name))
    except RuntimeError as error:  # so netCDF reports a full disk
        raise SolverError(f"{path}: cannot be written: {error}") from error


def _store(stored: Dataset, name: str, values: Floats, dims: tuple[str, ...], words: dict[str, str]) -> None:
    variable = stored.createVariable(name, "f8", dims, fill_value=float("nan"))
    variable.setncatts(words)
    variable[...] = values


def append_netcdf(stored: Dataset, time: Floats, fields: dict[str, Floats]) -> None:
    """Append states to an open file of :func:`write_netcdf`: their times (n,), s, and what varies with it.

    They are written out at once: the file is the same to the byte as if it were closed in between.
    """
    count = stored.dimensions["time"].size
    for name, values in {"time": time, **fields}.items():
        if name == "time" or "time" in FIELDS[name].dims:
            stored[name][count:] = values
    stored.sync()
