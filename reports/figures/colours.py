"""Colours and strokes of the models, the same in every picture and on the page.

Near-black, blue, green and purple differ for the colour-blind; points, solid, dashed and dotted lines also
differ in grey.
"""

from dataclasses import dataclass
from typing import Final, Literal

Dashes = Literal["-"] | tuple[float, tuple[float, ...]]


@dataclass(frozen=True)
class Stroke:
    """How a reduced model's curve is drawn.

    Attributes
    ----------
    colour : str
        As #rrggbb.
    dashes : "-" or (float, tuple of float)
        matplotlib's line style: solid, or offset and lengths of dashes and gaps in line widths.
    """

    colour: str
    dashes: Dashes


REFERENCE: Final = "#1a1a1a"  # 3D, drawn as points
MODELS: Final = (  # the reduced models in the order of the case
    Stroke("#0072b2", "-"),
    Stroke("#009e73", (0, (3.2, 1.1))),
    Stroke("#7b3294", (0, (1.0, 1.0))),
)
CALCIFIED: Final = "#f4ead8"  # tint behind what lies in the calcification
BEYOND: Final = "#b8480b"  # what is beyond a limit
LIMIT: Final = "#e3e8ee"  # band between −limit and +limit
MISSING: Final = "#b0b0b0"  # what is not stated
GRID: Final = "#d8d8d8"
HATCH: Final = "#fefefe"  # white on any paper: what lies on colours is not turned with the page's own
QUIET: Final = "#6a6a6a"  # marks and edges that are no data
