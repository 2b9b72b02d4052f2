"""Fields on all cells of the lumen, as data."""

from collections.abc import Mapping

import numpy as np

from cases.arrays import Floats
from reports.result.load import Comparison
from reports.wording.csv_text import comma_separated

DIGITS = 6  # thousands of cells: more would double the report


def cells_table(comparison: Comparison, columns: Mapping[str, Floats]) -> str:
    """A line a cell with its numbers and centre, and a column for each map, (x, phi)."""
    x, phi = np.meshgrid(comparison.fields["x"].values, comparison.fields["phi"].values, indexing="ij")
    i, j = np.indices(x.shape) + 1
    lines = zip(*(values.ravel().tolist() for values in (i, j, x, phi, *columns.values())), strict=True)
    line = "%d,%d" + f",%.{DIGITS}g" * (2 + len(columns)) + "\n"
    header = comma_separated(("i", "j", "x_m", "phi_rad", *columns), ())
    return header + "".join([line % row for row in lines])
