"""Cross-sections stand to scale, with both lumens, the velocity in one scale and differences around zero."""

import numpy as np
import pytest
from drawn_figure import drawn, line_data, words
from matplotlib.contour import ContourSet
from matplotlib.figure import Figure

from cases.arrays import Floats
from reports.figures import cross_sections as module
from reports.figures.colours import MODELS, REFERENCE
from reports.figures.cross_sections import Disc, Section, cross_sections

PHI = (np.arange(24) + 0.5) * 2 * np.pi / 24
SHARE = np.linspace(0.0, 1.0, 9)
PARABOLA = np.tile(1 - SHARE**2, (24, 1))


def _section(factors: tuple[float, ...], name: str = "ring") -> Section:
    three = Disc(np.full(24, 2.5), PARABOLA)
    return Section(name, three, tuple(Disc(f * three.radius, f * PARABOLA) for f in factors), PHI < 1.0)


def _figure(monkeypatch: pytest.MonkeyPatch, factors: tuple[float, ...]) -> Figure:
    names = ("row", "coupled")[: len(factors)]
    return drawn(monkeypatch, module, lambda: cross_sections(PHI, SHARE, [_section(factors)], names, "m/s"))


def _circles(figure: Figure, colour: str) -> list[float]:
    """Radii (inches) of the lumens of a colour."""
    lines = [xy for xy in line_data(figure, colour, points=25) if np.isnan(xy).any()]
    found = []
    for xy in lines:
        for start in range(0, len(xy), 26):
            across, up = xy[start : start + 24].T
            found.append(float(np.hypot(across - across.mean(), up - up.mean()).mean()))
    return found


def test_lumens_are_to_scale_in_their_panels_and_in_the_differences(monkeypatch: pytest.MonkeyPatch) -> None:
    figure = _figure(monkeypatch, (0.9, 1.04))
    three = _circles(figure, REFERENCE)
    assert len(three) == 5, "3D, two models, two differences"
    for stroke, factor in zip(MODELS, (0.9, 1.04), strict=False):
        assert _circles(figure, stroke.colour) == pytest.approx([factor * three[0]] * 2, rel=1e-6)


def test_velocities_share_a_scale_and_differences_are_centred(monkeypatch: pytest.MonkeyPatch) -> None:
    figure = _figure(monkeypatch, (0.9,))
    sets = [artist for artist in figure.axes[0].collections if isinstance(artist, ContourSet)]
    assert [s.norm.vmin for s in sets] == pytest.approx([0, 0, -0.1])
    assert [s.norm.vmax for s in sets] == pytest.approx([1, 1, 0.1])
    assert {"3D", "row", "row − 3D", "$v_x$ (m/s)", "difference (m/s)", "calcified wall"} <= set(
        words(figure)
    )


def test_same_bytes_one_row_of_cells_and_what_is_not_stated() -> None:
    def drawing(velocity: Floats) -> str:
        three = Disc(np.array([2.5]), velocity)
        section = Section("", three, (Disc(np.array([2.4]), PARABOLA[:1]),), np.array([True]))
        return cross_sections(np.array([np.pi]), SHARE, [section], ("2D",), "m/s")

    assert drawing(PARABOLA[:1]) == drawing(PARABOLA[:1])
    assert len(drawing(np.full((1, 9), np.nan))) < len(drawing(PARABOLA[:1]))
