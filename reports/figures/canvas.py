"""Size and style that all figures share, and the way they become SVG."""

import io
from collections.abc import Sequence
from typing import Any

from matplotlib.artist import Artist
from matplotlib.figure import Figure

WIDTH = 6.9  # inches; the text width of an A4 page
STYLE: dict[str, Any] = {
    "svg.hashsalt": "report",
    "svg.fonttype": "path",
    "font.family": "DejaVu Sans",
    "font.size": 7.0,
    "axes.linewidth": 0.5,
    "axes.formatter.useoffset": False,
    "axes.unicode_minus": True,
    "xtick.major.width": 0.5,
    "ytick.major.width": 0.5,
    "xtick.major.size": 2.0,
    "ytick.major.size": 2.0,
    "xtick.major.pad": 1.5,
    "ytick.major.pad": 1.5,
    "path.simplify": True,
}
_RASTER_DPI = 150  # of what is drawn as an image inside the vectors


def legend_above(figure: Figure, handles: Sequence[Artist], left: float) -> None:
    """Write a legend in one line on top of a figure, from ``left`` (inches) on."""
    figure.legend(
        handles=handles,
        loc="upper left",
        bbox_to_anchor=(left / WIDTH, 1.0),
        borderaxespad=0.3,
        ncols=len(handles),
        frameon=False,
        fontsize=7.5,
    )


def svg_text(figure: Figure, dpi: int = _RASTER_DPI) -> str:
    """Return the figure as SVG, what is drawn as an image at ``dpi``; the same text for the same figure."""
    with io.StringIO() as text:
        figure.savefig(
            text,
            format="svg",
            dpi=dpi,
            metadata={"Date": None, "Creator": None, "Format": None, "Type": None},
        )
        return text.getvalue()
