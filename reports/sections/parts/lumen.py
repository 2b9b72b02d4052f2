"""Fields on all cells of the lumen at one instant, as data."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from cases.arrays import Floats
from reports.wording.csv_text import comma_separated

CELL_COLUMNS = ("t_s", "i", "j", "x_m", "phi_rad")
DIGITS = 6  # thousands of cells: more would double the report


def field(data: xr.Dataset, name: str, factor: float = 1.0) -> Floats:
    """Values of a variable times `factor`."""
    return factor * data[name].values.astype(float)


def cells_header(first: Sequence[str], names: Sequence[str]) -> str:
    """First line of the data of all cells, below which :func:`cells_text` fits."""
    return comma_separated((*first, *CELL_COLUMNS, *names), ())


def cells_text(t_s: float, data: xr.Dataset, names: Sequence[str], first: Sequence[str] = ()) -> str:
    """Lines of all cells at one time: what stands `first` in each, the columns of a cell, the variables."""
    x, phi = np.meshgrid(data["x"].values, data["phi"].values, indexing="ij")
    i, j = np.indices(x.shape) + 1
    columns = [values.ravel().tolist() for values in (i, j, x, phi, *(field(data, name) for name in names))]
    number = f"%.{DIGITS}g"
    start = comma_separated((*first, f"{t_s:.{DIGITS}g}"), ()).rstrip("\n").replace("%", "%%")
    line = f"{start},%d,%d" + f",{number}" * (len(columns) - 2) + "\n"
    return "".join([line % row for row in zip(*columns, strict=True)])  # a line at once: there are thousands
