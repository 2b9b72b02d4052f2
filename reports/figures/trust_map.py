"""Where a reduced model may stand for 3D: errors over their limits on the unrolled lumen."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cases.arrays import Flags, Floats
from reports.figures.colour_scale import in_or_out
from reports.figures.heat_maps import MapRow, Maps, heat_maps
from reports.figures.lumen_cells import uniform

UNIFORM = 0.02  # of the limit: panels that vary less are told by one number


@dataclass(frozen=True)
class TrustRow:
    """One quantity of one model in all variants.

    Attributes
    ----------
    label : str
        Model and quantity, as in ``"2D row, $R$"``.
    panels : tuple of ndarray, each of shape (x, phi)
        Size of the error over its limit, one a variant; NaN is not stated and drawn grey.
    """

    label: str
    panels: tuple[Floats, ...]


def trust_map(
    x: Floats, phi: Floats, variants: Sequence[str], rows: Sequence[TrustRow], calcified: Flags
) -> str:
    """Draw a column a variant and a row a model or quantity: blue inside the limit, orange outside.

    Each panel tells the share of its cells that is inside; the border between inside and outside is drawn,
    and the calcification outlined. A panel that varies by less than 2 % of the limit is its number.

    Parameters
    ----------
    x, phi : ndarray
        Centres of the cells (mm, degrees).
    variants : sequence of str
        Headings of the columns.
    rows : sequence of TrustRow
        From top to bottom.
    calcified : ndarray of bool, shape (variant, x, phi)
        Cells to outline.

    Returns
    -------
    str
        SVG; the same text for the same input.
    """
    scale = in_or_out()
    drawn = []
    for row in rows:
        words = tuple(_words(values) for values in row.panels)
        corners = tuple(
            "" if word else f"{inside_words(values)} inside"
            for word, values in zip(words, row.panels, strict=True)
        )
        maps = Maps(row.panels, "error ÷ limit", scale=scale, words=words, corners=corners, threshold=1.0)
        drawn.append(MapRow(row.label, (maps,)))
    note = "line: the limit; framed: calcified"
    return heat_maps(x, phi, variants, drawn, calcified, note)


def _words(values: Floats) -> str:
    """Words for a panel that is uniform, "" for one to draw."""
    if not np.isfinite(values).any():
        return "not stated"
    found = uniform(values, UNIFORM)
    if found is None:
        return ""
    return f"{'inside' if found <= 1 else 'outside'} everywhere\n{found:.2g} × the limit"


def inside_words(values: Floats) -> str:
    """Share of the stated cells that is inside; neither 0 % nor 100 % by rounding alone."""
    known = values[np.isfinite(values)]
    share = 100 * float((known <= 1).mean())
    if 0 < share < 0.5:
        return "< 1 %"
    return f"{'> 99' if 99.5 <= share < 100 else f'{share:.0f}'} %"
