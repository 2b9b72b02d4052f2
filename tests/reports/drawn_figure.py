"""The artists of a drawing, before they are SVG."""

from collections.abc import Callable
from types import ModuleType

import numpy as np
import pytest
from matplotlib.collections import PolyCollection
from matplotlib.colors import same_color
from matplotlib.figure import Figure

from cases.arrays import Floats
from reports.figures.canvas import svg_text


def drawn(monkeypatch: pytest.MonkeyPatch, module: ModuleType, drawing: Callable[[], str]) -> Figure:
    """Make a drawing of a module and return its figure."""
    kept: list[Figure] = []

    def keep(figure: Figure, *dpi: int) -> str:
        kept.append(figure)
        return svg_text(figure, *dpi)

    with monkeypatch.context() as patched:
        patched.setattr(module, "svg_text", keep)
        assert drawing().startswith("<?xml")
    return kept[0]


def line_data(figure: Figure, colour: str, points: int = 1) -> list[Floats]:
    """Inches of the lines of a colour with at least so many points, shape (n, 2) each, as drawn."""
    lines = [line for axis in figure.axes for line in axis.lines if same_color(line.get_color(), colour)]
    return [xy for line in lines if len(xy := np.asarray(line.get_xydata(), dtype=float)) >= points]


def filled(figure: Figure, colour: str) -> list[Floats]:
    """Corners (inches) of the polygons that are filled with a colour."""
    return [
        np.asarray(path.vertices, dtype=float)
        for axis in figure.axes
        for collection in axis.collections
        if isinstance(collection, PolyCollection) and len(collection.get_facecolor())
        for path in collection.get_paths()
        if same_color(collection.get_facecolor()[0], colour)
    ]


def words(figure: Figure) -> list[str]:
    """Return all texts of a drawing."""
    return [text.get_text() for axis in figure.axes for text in axis.texts]
