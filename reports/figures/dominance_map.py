"""Axial dominance over the unrolled lumen: how large the velocities are that the 2D model neglects."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from cases.arrays import Flags, Floats
from reports.figures.colour_scale import Scale, scale_of
from reports.figures.colours import MISSING
from reports.figures.heat_maps import MapRow, Maps, heat_maps

_BEYOND = "#c2410c"


def dominance_map(
    x: Floats,
    phi: Floats,
    variants: Sequence[str],
    rows: Sequence[tuple[str, Sequence[Floats]]],
    calcified: Flags,
    outlet_columns: int = 1,
    label: str = "ratio",
) -> str:
    """Draw a column a variant and a row a ratio or model; cells at the outlet are grey.

    The scale reaches from zero to the largest value of the first row (3D), for at the edge of a calcification
    2D has jumps that would leave nothing else to see; larger values have a colour of their own.

    Parameters
    ----------
    x, phi : ndarray
        Centres of the cells (mm, degrees).
    variants : sequence of str
        Headings of the columns.
    rows : sequence of (str, sequence of ndarray of shape (x, phi))
        Label and ratios of each row, one array a variant; NaN is not stated.
    calcified : ndarray of bool, shape (variant, x, phi)
        Cells to outline.
    outlet_columns : int
        How many cells from the outlet on are masked: the boundary condition there, not the flow, makes them.
    label : str
        Of the colour bar, as in ``"largest $|v_r|/v_x$"``.

    Returns
    -------
    str
        SVG; the same text for the same input.
    """
    shown = np.arange(x.size)[:, None] < x.size - outlet_columns
    masked = [(name, tuple(np.where(shown, values, np.nan) for values in line)) for name, line in rows]
    first = [float(np.nanmax(values)) for values in masked[0][1] if np.isfinite(values).any()]
    scale = scale_of([], False, (0.0, max(first, default=1.0)))
    scale = replace(scale, colours=scale.colours.with_extremes(over=_BEYOND, bad=MISSING))
    drawn = [
        MapRow(
            name,
            (
                Maps(
                    line,
                    label,
                    scale=scale,
                    words=tuple("" if np.isfinite(v).any() else "not stated" for v in line),
                ),
            ),
        )
        for name, line in masked
    ]
    note = "grey: outlet" + ("; orange: beyond the scale" if _beyond(masked, scale) else "")
    return heat_maps(x, phi, variants, drawn, calcified, f"{note}; framed: calcified")


def _beyond(rows: Sequence[tuple[str, Sequence[Floats]]], scale: Scale) -> bool:
    return any(bool((values > scale.ends[1]).any()) for _, line in rows for values in line)
