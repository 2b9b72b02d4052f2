"""Fields on all cells of the lumen at one instant: arrays for maps, and their data."""

from collections.abc import Iterator, Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from reports.tabular import comma_separated

Array = NDArray[np.float64]

CELL_COLUMNS = ("t_s", "i", "j", "x_m", "phi_rad")
DIGITS = 6  # thousands of cells: more would double the report
WITHOUT_INSTANT = "The case names no instant to show maps at."


def field(data: xr.Dataset, name: str, factor: float = 1.0) -> Array:
    """Values of a variable times `factor`."""
    return factor * data[name].values.astype(float)


def centres(data: xr.Dataset) -> tuple[Array, Array]:
    """Centres of the cells: x in mm, φ in degrees."""
    return 1e3 * data["x"].values, np.degrees(data["phi"].values)


def outlined(data: xr.Dataset) -> str:
    """Say what the frame in a map is; "" where there is none."""
    return " Framed: the calcified cells." if bool(data["calcified"].any()) else ""


def cells_csv(instants: Sequence[tuple[float, xr.Dataset]], names: Sequence[str]) -> str:
    """All cells at each of the (time, fields), SI."""
    rows = (row for t_s, data in instants for row in cell_rows(t_s, data, names))
    return comma_separated((*CELL_COLUMNS, *names), rows, DIGITS)


def cell_rows(t_s: float, data: xr.Dataset, names: Sequence[str]) -> Iterator[tuple[object, ...]]:
    """Rows of all cells at one time: the columns of a cell, then the variables."""
    x, phi = np.meshgrid(data["x"].values, data["phi"].values, indexing="ij")
    i, j = np.indices(x.shape) + 1
    columns = [values.ravel().tolist() for values in (i, j, x, phi, *(field(data, name) for name in names))]
    yield from zip([t_s] * x.size, *columns, strict=True)
