"""Differences from 3D over the unrolled lumen at an instant, in one scale that ends at the limit."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cases.arrays import Flags, Floats
from reports.figures.colour_scale import within_limit
from reports.figures.heat_maps import MapRow, Maps, heat_maps
from reports.figures.lumen_cells import uniform
from reports.figures.trust_map import UNIFORM


@dataclass(frozen=True)
class LimitRow:
    """One quantity of one model in all variants.

    Attributes
    ----------
    label : str
        Model and quantity, as in ``"2D row, $R$"``.
    limit : float
        Of the difference's size, in percent of 3D; the scale's ends.
    panels : tuple of ndarray, each of shape (x, phi)
        2D − 3D in percent of 3D, one a variant; NaN is not stated and drawn grey.
    """

    label: str
    limit: float
    panels: tuple[Floats, ...]


def limit_maps(
    x: Floats, phi: Floats, variants: Sequence[str], rows: Sequence[LimitRow], calcified: Flags
) -> str:
    """Draw a column a variant and a row a quantity and model; beyond the limit is dark and hatched.

    A panel that varies by less than 2 % of the limit is its number.

    Parameters
    ----------
    x, phi : ndarray
        Centres of the cells (mm, degrees).
    variants : sequence of str
        Headings of the columns.
    rows : sequence of LimitRow
        From top to bottom.
    calcified : ndarray of bool, shape (variant, x, phi)
        Cells to outline.

    Returns
    -------
    str
        SVG; the same text for the same input.
    """
    scales = {row.limit: within_limit(row.limit) for row in rows}
    drawn = [
        MapRow(
            row.label,
            (
                Maps(
                    row.panels,
                    "2D − 3D (%)",
                    scale=scales[row.limit],
                    words=tuple(_words(values, row.limit) for values in row.panels),
                ),
            ),
        )
        for row in rows
    ]
    note = "hatched: beyond the limit; framed: calcified"
    return heat_maps(x, phi, variants, drawn, calcified, note)


def _words(values: Floats, limit: float) -> str:
    """Words for a panel that is uniform, "" for one to draw."""
    if not np.isfinite(values).any():
        return "not stated"
    found = uniform(values, UNIFORM * limit)
    if found is None:
        return ""
    number = f"{found:+.2g}".replace("-", "\N{MINUS SIGN}")
    return f"{number} % everywhere" + (f"\nbeyond ±{limit:g} %" if abs(found) > limit else "")
