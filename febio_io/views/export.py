"""Writes what an FEBio file holds in formats of other programs; see the formats of each kind of file."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from cases.shell.interrupts import imports
from febio_io.errors import FebioKeyError, nearest_first
from febio_io.text.data_records import DataRecord
from febio_io.text.log import Log
from febio_io.views.staging import safe_name, staged
from febio_io.xplt import Plot

Advance = Callable[[], None]


def export_plot(
    plot: Plot,
    folder: Path,
    file_format: str,
    *,
    variables: list[str] | None = None,
    states: list[int] | None = None,
    advance: Advance = lambda: None,
) -> list[Path]:
    """Write a plot file in another format.

    Parameters
    ----------
    plot : Plot
        The open file.
    folder : Path
        Where to write; made if it is not there. Each file appears whole or not at all.
    file_format : {"vtu", "vtkhdf", "csv", "nc"}
        .vtu files with a .pvd file, or one VTKHDF file, for ParaView, surfaces with values apart; a .csv
        table for each variable; one netCDF file.
    variables : list of str, optional
        Names of variables; all, unless given.
    states : list of int, optional
        Numbers of states; all, unless given.
    advance : callable, optional
        Called whenever a state has been written.

    Raises
    ------
    FebioKeyError
        If there is no such variable or state, or the format cannot hold these states.
    FebioFormatError
        If the file contradicts its format.
    FebioFileError
        If the folder cannot be written to.
    """
    from febio_io.views.arrays import pick_states, pick_variables

    chosen = pick_variables(plot, variables)
    numbers = pick_states(plot, states)
    if file_format in ("vtu", "vtkhdf"):
        with imports():
            from febio_io.views.export_vtk import write_vtkhdf, write_vtu
        write = write_vtu if file_format == "vtu" else write_vtkhdf
    else:
        from febio_io.views.export_tables import write_plot_csv, write_plot_nc

        write = write_plot_csv if file_format == "csv" else write_plot_nc
    written: list[Path] = []
    with staged(folder, written) as temporary:
        write(plot, temporary, chosen, numbers, advance)
    return written


def export_record(
    record: DataRecord,
    folder: Path,
    file_format: str,
    *,
    variables: list[str] | None = None,
    blocks: list[int] | None = None,
) -> list[Path]:
    """Write a data record as one .csv or .nc file.

    Parameters and errors are those of :func:`export_plot`; `variables` are columns, `blocks` their numbers.
    """
    from febio_io.views.export_tables import record_dataset, write_nc

    labels = list(record.to_xarray().data_vars)
    for name in variables or ():
        if name not in labels:
            known = ", ".join(map(repr, nearest_first(name, map(str, labels)))) or "none"
            raise FebioKeyError(f"{record.path}: no column {name!r}; the file has {known}")
    _need_table(record.path, "data record", file_format)
    part = record if blocks is None else _blocks_of(record, blocks)
    written: list[Path] = []
    stem = safe_name(record.path.stem)
    with staged(folder, written) as temporary:
        if file_format == "nc":
            write_nc(record_dataset(part, variables), temporary / f"{stem}.nc")
        else:
            table = part.to_pandas()
            wanted = table if variables is None else table[["step", "time", "item", *variables]]
            wanted.to_csv(temporary / f"{stem}.csv", index=False)
    return written


def export_log(log: Log, folder: Path, file_format: str) -> list[Path]:
    """Write a log as tables: steps, iterations, messages, inputs, timings, and the records in it.

    As .csv, a file for each; as .nc, one for each of the numerical ones. Errors are those of
    :func:`export_plot`.
    """
    from febio_io.views.export_tables import log_tables, write_nc

    _need_table(log.path, "log", file_format)
    written: list[Path] = []
    stem = safe_name(log.path.stem)
    with staged(folder, written) as temporary:
        for name, table in log_tables(log).items():
            if file_format == "csv":
                table.to_csv(temporary / f"{stem}_{name}.csv", index=False)
            elif name in ("steps", "iterations"):
                write_nc(table.rename_axis("row").to_xarray(), temporary / f"{stem}_{name}.nc")
        for item in log.records:
            if item.file is None:
                record = log.data_record(item.number)
                path = temporary / f"{stem}_record{item.number}.{file_format}"
                if file_format == "csv":
                    record.to_pandas().to_csv(path, index=False)
                else:
                    write_nc(record.to_xarray(), path)
    return written


def _need_table(path: Path, kind: str, file_format: str) -> None:
    if file_format not in ("csv", "nc"):
        raise FebioKeyError(
            f"{path}: a {kind} has no mesh to write as {file_format}; csv and nc are possible"
        )


def _blocks_of(record: DataRecord, blocks: list[int]) -> DataRecord:
    rows = np.isin(record.blocks, blocks)
    places = np.searchsorted(blocks, record.blocks[rows])
    return DataRecord(
        record.path,
        record.name,
        record.columns,
        record.times[blocks],
        record.steps[blocks],
        places.astype(np.int64),
        record.items[rows],
        record.values[rows],
        record.warnings,
    )
