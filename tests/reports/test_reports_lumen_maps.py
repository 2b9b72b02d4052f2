"""Maps that judge: what is inside the limit, beyond it, uniform, masked or not stated can be told apart."""

from collections.abc import Callable

import numpy as np
import pytest
from drawn_figure import drawn, line_data, words
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from cases.arrays import Floats
from reports.figures import heat_maps as module
from reports.figures.colour_scale import in_or_out, within_limit
from reports.figures.colours import HATCH
from reports.figures.dominance_map import dominance_map
from reports.figures.limit_maps import LimitRow, limit_maps
from reports.figures.lumen_cells import uniform
from reports.figures.trust_map import TrustRow, trust_map

X, PHI = np.linspace(0.5, 14.5, 15), np.linspace(15.0, 345.0, 12)
PATCH = np.zeros((15, 12), dtype=bool)
PATCH[5:10, 4:8] = True
VARIANTS = ("none", "local")
BOTH = np.stack([np.zeros_like(PATCH), PATCH])
RISING = np.add.outer(np.linspace(0.1, 3.0, 15), np.zeros(12))

Draw = Callable[[Callable[[], str]], Figure]


@pytest.fixture
def figure(monkeypatch: pytest.MonkeyPatch) -> Draw:
    return lambda drawing: drawn(monkeypatch, module, drawing)


def _images(figure: Figure) -> list[Floats]:
    """Values of the maps, (φ, x), without the bars."""
    arrays = [image.get_array() for axis in figure.axes for image in axis.images]
    return [
        np.ma.filled(np.ma.asarray(a, dtype=float), np.nan)
        for a in arrays
        if a is not None and a.shape[1] > 1
    ]


def test_steps_tell_inside_from_outside_in_colour_and_in_grey() -> None:
    scale = in_or_out()
    colours = scale.colours(scale.norm(np.array([0.2, 0.99, 1.01, 3.0, 50.0])))
    assert (colours[:2, 2] > colours[:2, 0]).all(), "blue inside"
    assert (colours[2:, 0] > colours[2:, 2]).all(), "orange outside"
    light = colours[:, :3] @ np.array([0.299, 0.587, 0.114])
    assert (np.diff(light) < -0.05).all()


def test_beyond_the_limit_has_a_colour_that_is_not_the_scale_s() -> None:
    scale = within_limit(2.0)
    beyond, end = scale.colours(scale.norm([-2.01, -1.99]))
    assert np.abs(beyond - end).max() > 0.1
    middle = scale.colours(scale.norm(0.0))
    assert min(middle[:3]) > 0.9
    assert to_rgb(scale.colours(scale.norm(2.01))) != to_rgb(scale.colours(scale.norm(1.99)))


def test_trust_map_holds_its_values_border_and_shares(figure: Draw) -> None:
    rows = [TrustRow("2D\n$R$", (np.full((15, 12), 0.26), RISING))]
    made = figure(lambda: trust_map(X, PHI, VARIANTS, rows, BOTH))
    (values,) = _images(made)
    assert values == pytest.approx(RISING.T)
    said = words(made)
    assert "inside everywhere\n0.26 × the limit" in said
    assert f"{100 * (RISING <= 1).mean():.0f} % inside" in said
    border = line_data(made, "#000000", points=12 * 3 - 1)[0]
    assert np.nanmax(border[:, 0]) == pytest.approx(np.nanmin(border[:, 0])), "one border, across x alone"


def test_uniform_is_what_varies_less_than_a_fiftieth_of_the_limit() -> None:
    assert uniform(np.array([1.0, 1.019, np.nan]), 0.02) == pytest.approx(1.0095)
    assert uniform(np.array([1.0, 1.021]), 0.02) is None
    assert uniform(np.array([np.nan]), 0.02) is None


def test_limit_maps_hatch_only_what_is_beyond(figure: Draw) -> None:
    rows = [LimitRow("$R$", 1.0, (np.full((15, 12), -1.5), RISING - 2.0))]
    made = figure(lambda: limit_maps(X, PHI, VARIANTS, rows, BOTH))
    assert "−1.5 % everywhere\nbeyond ±1 %" in words(made)
    (values,) = _images(made)
    assert values == pytest.approx(RISING.T - 2.0)
    strokes = line_data(made, HATCH)
    left, right = (made.axes[0].images[0].get_extent()[k] for k in (0, 1))
    first_inside = left + (right - left) * (RISING[:, 0] < 1.0).sum() / 15
    hatched = next(xy for xy in strokes if np.nanmin(xy[:, 0]) >= left - 1e-9)
    assert np.nanmax(hatched[:, 0]) == pytest.approx(first_inside, abs=0.02)


def test_limits_of_rows_that_differ_have_a_bar_each_and_equal_ones_share(figure: Draw) -> None:
    def bars(limits: tuple[float, float]) -> int:
        rows = [LimitRow(str(limit), limit, (RISING, RISING)) for limit in limits]
        return words(figure(lambda: limit_maps(X, PHI, VARIANTS, rows, BOTH))).count("2D − 3D (%)")

    assert bars((1.0, 2.0)) == 2
    assert bars((2.0, 2.0)) == 1


def test_dominance_masks_the_outlet_and_scales_by_the_first_row(figure: Draw) -> None:
    three = 0.1 * RISING
    three[-1] = 9.0
    two = three.copy()
    two[3] = 5.0
    rows = [("3D", (three, three)), ("2D", (two, two))]
    made = figure(lambda: dominance_map(X, PHI, VARIANTS, rows, BOTH))
    assert all(np.isnan(values[:, -1]).all() for values in _images(made))
    image = made.axes[0].images[0]
    assert image.norm.vmax == pytest.approx(three[-2].max())
    assert any("orange: beyond the scale" in text for text in words(made))


def test_one_row_of_cells_one_variant_and_what_is_not_stated(figure: Draw) -> None:
    line, none = np.linspace(0.5, 2.0, 15)[:, None], np.full((15, 1), np.nan)
    flags = np.zeros((1, 15, 1), dtype=bool)
    drawings = [
        lambda: trust_map(
            X, np.array([180.0]), ("none",), [TrustRow("", (line,)), TrustRow("", (none,))], flags
        ),
        lambda: limit_maps(X, np.array([180.0]), ("none",), [LimitRow("", 1.0, (none,))], flags),
        lambda: dominance_map(X, np.array([180.0]), ("none",), [("3D", (none,))], flags),
    ]
    for drawing in drawings:
        assert drawing() == drawing()
        assert "not stated" in words(figure(drawing))
