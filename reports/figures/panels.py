"""Panels of small multiples: their content and their places."""

from dataclasses import dataclass

import numpy as np

from cases.arrays import Floats
from reports.figures.canvas import WIDTH

LEFT, RIGHT, GAP = 0.62, 0.26, 0.10  # inches beside the panels and between them


@dataclass(frozen=True)
class Curves:
    """Both models in one panel, in display units; a model without a curve has an empty array.

    Attributes
    ----------
    reference, rom : ndarray, shape (n,) or (0,)
        Ordinates.
    note : str
        Written into the panel's lower left corner, or right where only one model has a curve.
    calcified : bool
        Whether the panel's cell is inside the calcification; its background is then tinted.
    marked : tuple of (float, str)
        Abscissas of vertical lines of this panel alone, with their colours.
    """

    reference: Floats
    rom: Floats
    note: str = ""
    calcified: bool = False
    marked: tuple[tuple[float, str], ...] = ()


@dataclass(frozen=True)
class PanelRow:
    """One row of panels.

    Attributes
    ----------
    quantity : str
        Axis label with unit.
    label : str
        Written at the row's right edge: which cell row, instant or quantity.
    panels : tuple of Curves
        One a column.
    difference : str
        Axis label of the panels for 2D − 3D below the curves; "" for none.
    difference_factor : float
        Unit of the differences over that of the curves.
    """

    quantity: str
    label: str
    panels: tuple[Curves, ...]
    difference: str = ""
    difference_factor: float = 1.0


@dataclass(frozen=True)
class Layout:
    """Where panels stand along a row (inches), and what their abscissas mean."""

    count: int
    low: float
    high: float

    @property
    def width(self) -> float:
        """Of one panel."""
        return (WIDTH - LEFT - RIGHT - GAP * (self.count - 1)) / self.count

    @property
    def lefts(self) -> list[float]:
        """Left edges of the panels."""
        return [k * (self.width + GAP) for k in range(self.count)]

    def place(self, column: int, abscissa: Floats | float) -> Floats:
        """Inches from the first panel's left edge."""
        share = (np.asarray(abscissa, dtype=float) - self.low) / (self.high - self.low)
        return np.asarray(self.lefts[column] + self.width * share)
