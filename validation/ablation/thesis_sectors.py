"""Sector flows of a case beside those that the thesis's table 3.8 prints of its 3D simulation."""

from pathlib import Path

import numpy as np
import pandas as pd

from cases.arrays import Floats
from cases.sections.case import Case
from solver.case.run import run_case
from validation.errors import ValidationError


def read_table(path: Path) -> pd.DataFrame:
    """Sector flows, cm³/s, by row j and time, with columns i_N of cells along the artery.

    Raises
    ------
    ValidationError
        If the file is no such table.
    """
    try:
        table = pd.read_csv(path)
    except (OSError, ValueError) as error:
        raise ValidationError(f"{path}: cannot be read as a table: {error}") from error
    if not {"j", "t_s"} <= set(table.columns) or not any(str(c).startswith("i_") for c in table.columns):
        raise ValidationError(f"{path}: needs columns j, t_s and i_N")
    return table


def sector_errors(case: Case, path: Path) -> Floats:
    """Relative error of each printed flow over the mean of the rows printed for its section and time.

    The thesis prints three sectors, not the section's flow: their mean stands for it, in both.

    Parameters
    ----------
    case : Case
        On the table's grid; its last cycle is compared.
    path : Path
        Table 3.8.

    Returns
    -------
    ndarray (rows j, times, cells i)

    Raises
    ------
    ValidationError
        If the table is unusable, or names cells that the grid lacks.
    SolverError
        If the run fails.
    """
    table = read_table(path)
    columns = [str(name) for name in table.columns if str(name).startswith("i_")]
    cells = np.array([int(name.removeprefix("i_")) for name in columns])
    rows = np.unique(table["j"].to_numpy())
    if cells.max() > case.solver.n_x or rows.max() > case.solver.n_phi:
        raise ValidationError(
            f"{path}: names cells that a grid of {case.solver.n_x} x {case.solver.n_phi} lacks"
        )
    instants = np.unique(table["t_s"].to_numpy())
    wide = table.set_index(["j", "t_s"])[columns]
    places = pd.MultiIndex.from_product([rows, instants])
    printed = wide.reindex(places).to_numpy(dtype=float)
    if not np.all(np.isfinite(printed)):
        raise ValidationError(f"{path}: lacks a number for some row j at some time")
    period, cycles = case.inlet.period, case.solver.cycles
    times = (cycles - 1) * period + np.mod(instants, period)
    run = run_case(case, np.unique(np.concatenate([[0.0], times])))
    flows = run["sector_flow_rate"].sel(time=times).to_numpy()[:, cells - 1][:, :, rows - 1]
    own = np.moveaxis(flows, 2, 0)
    stated = printed.reshape(rows.size, instants.size, cells.size)
    return np.asarray((own / own.mean(axis=0)) / (stated / stated.mean(axis=0)) - 1)
