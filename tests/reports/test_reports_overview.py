"""The overview draws every curve where its numbers say, errors in percent below, and is always the same."""

import numpy as np
import pytest
from drawn_figure import drawn, filled, line_data
from matplotlib.figure import Figure

from reports.figures import overview as module
from reports.figures.colours import CALCIFIED, MODELS
from reports.figures.overview import Cycle, OverviewRow, overview

TIME = np.linspace(0.0, 0.8, 9)
WAVE = 12 + np.sin(8 * TIME)


def _rows(factors: tuple[float, ...] = (1.02, 0.97), limit: float | None = 1.0) -> list[OverviewRow]:
    panels = tuple(Cycle(WAVE + k, tuple(f * (WAVE + k) for f in factors), k == 1) for k in range(2))
    return [OverviewRow("$P$ (kPa)", limit, panels)]


def _figure(monkeypatch: pytest.MonkeyPatch, rows: list[OverviewRow], models: tuple[str, ...]) -> Figure:
    return drawn(monkeypatch, module, lambda: overview(TIME, ("none", "ring"), rows, models))


def test_each_model_is_a_curve_of_its_colour_and_an_error_in_percent(monkeypatch: pytest.MonkeyPatch) -> None:
    figure = _figure(monkeypatch, _rows(), ("row", "coupled"))
    for stroke, factor in zip(MODELS, (1.02, 0.97), strict=False):
        curve, error = line_data(figure, stroke.colour, points=20)
        first, zero = curve[:9], error[:9]
        share = (first[:, 1] - first[0, 1]) / (first[4, 1] - first[0, 1])
        assert share == pytest.approx((WAVE - WAVE[0]) / (WAVE[4] - WAVE[0]))
        assert np.ptp(zero[:, 1]) == pytest.approx(0.0, abs=1e-9), f"{factor} is a constant error"
    up = {s.colour: line_data(figure, s.colour, points=20)[1][0, 1] for s in MODELS[:2]}
    zero_line = (3 * up[MODELS[0].colour] + 2 * up[MODELS[1].colour]) / 5  # +2 % and −3 %
    (band,) = filled(figure, "#e3e8ee")[:1]
    assert (band[:, 1].min() + band[:, 1].max()) / 2 == pytest.approx(zero_line)


def test_the_calcified_panel_alone_is_tinted(monkeypatch: pytest.MonkeyPatch) -> None:
    assert len(filled(_figure(monkeypatch, _rows(), ("a", "b")), CALCIFIED)) == 1


def test_what_nothing_judges_has_no_band_and_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    figure = _figure(monkeypatch, _rows(limit=None), ("row", "coupled"))
    assert not filled(figure, "#e3e8ee")
    words = [text.get_text() for text in figure.axes[0].texts]
    assert "error (%)\nno limit" in words
    assert "within the limit" not in words


def test_same_bytes_and_what_is_not_stated_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    sparse = np.where(np.arange(9) % 3 == 0, WAVE, np.nan)
    rows = [OverviewRow("$R$ (mm)", 1.0, (Cycle(sparse, (WAVE,)),))]
    one, two = (overview(TIME, ("none",), rows, ("2D",)) for _ in range(2))
    assert one == two
    figure = drawn(monkeypatch, module, lambda: overview(TIME, ("none",), rows, ("2D",)))
    _, error = line_data(figure, MODELS[0].colour, points=10)
    assert np.isfinite(error[:, 1]).sum() == 3
    empty = [OverviewRow("$R$ (mm)", None, (Cycle(np.full(9, np.nan), (np.full(9, np.nan),)),))]
    assert overview(TIME, ("none",), empty, ("2D",))
