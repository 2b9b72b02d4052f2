"""Parity and differences count every stated pair once, and tell bias, scatter and limit of what is drawn."""

from collections.abc import Sequence

import numpy as np
import pytest
from drawn_figure import drawn, filled, line_data, words
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from cases.arrays import Floats
from reports.figures import agreement as module
from reports.figures.agreement import Agreement, agreement
from reports.figures.colours import LIMIT

NUMBERS = np.random.default_rng(3)
THREE = NUMBERS.uniform(2.0, 3.0, (5, 4, 10))
TWO = THREE * (1 + NUMBERS.normal(0.01, 0.002, THREE.shape))
ROW = Agreement("$R$", "mm", (THREE,), (TWO,), 2.0)


def _figure(monkeypatch: pytest.MonkeyPatch, row: Agreement) -> Figure:
    return drawn(monkeypatch, module, lambda: agreement(("none",), [row], "2D"))


def _counts(figure: Figure) -> list[Floats]:
    images = [np.ma.asarray(image.get_array()) for image in figure.axes[0].images]
    return [10 ** image.filled(-np.inf) for image in images if image.shape[1] > 1]


def test_every_pair_is_counted_once_in_both_panels(monkeypatch: pytest.MonkeyPatch) -> None:
    for counts in _counts(_figure(monkeypatch, ROW)):
        assert counts.sum() == pytest.approx(THREE.size)


def test_bias_and_scatter_are_those_of_the_differences(monkeypatch: pytest.MonkeyPatch) -> None:
    figure = _figure(monkeypatch, ROW)
    percent = 100 * (TWO / THREE - 1)
    assert f"+{percent.mean():.2f} ± {1.96 * percent.std():.2f} %" in words(figure)
    bias, low, high = (line[0, 1] for line in line_data(figure, module.BIAS, points=3))
    band = next(box[:, 1] for box in filled(figure, LIMIT))
    inches = np.ptp(band) / 4.0  # from −2 % to +2 %
    assert bias == pytest.approx((band.min() + band.max()) / 2 + inches * percent.mean(), abs=1e-9)
    assert [high - bias, bias - low] == pytest.approx([inches * 1.96 * percent.std()] * 2)


def test_what_is_not_stated_is_not_counted_and_no_limit_is_no_band(monkeypatch: pytest.MonkeyPatch) -> None:
    sparse = np.where(THREE > 2.5, THREE, np.nan)
    figure = _figure(monkeypatch, Agreement("$R$", "mm", (sparse,), (TWO,)))
    assert _counts(figure)[0].sum() == pytest.approx((THREE > 2.5).sum())
    assert not filled(figure, LIMIT)
    assert "within the limit" not in words(figure)
    nowhere = Agreement("$R$", "mm", (np.full(3, np.nan),), (np.ones(3),))
    assert agreement(("none",), [nowhere], "2D") == agreement(("none",), [nowhere], "2D")


def test_words_stand_above_the_differences(monkeypatch: pytest.MonkeyPatch) -> None:
    figure = _figure(monkeypatch, ROW)
    (told,) = (text for text in figure.axes[0].texts if "±" in text.get_text() and "%" in text.get_text())
    assert told.get_position()[1] > max(image.get_extent()[3] for image in _maps(figure)[1:])
    box = _box(told, figure)
    others = [text for text in figure.axes[0].texts if text is not told]
    assert not any(box.overlaps(_box(text, figure)) for text in others)


def _box(text: Text, figure: Figure) -> Bbox:
    canvas = FigureCanvasAgg(figure)
    return text.get_window_extent(canvas.get_renderer()).transformed(figure.axes[0].transData.inverted())


def _maps(figure: Figure) -> list[AxesImage]:
    return [image for image in figure.axes[0].images if image.get_array().shape[1] > 1]


def test_counts_are_seen_on_white_and_on_dark_paper() -> None:
    def brightness(colour: Sequence[float]) -> float:
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in colour[:3]]
        return float(np.dot(linear, (0.2126, 0.7152, 0.0722)))

    dark = brightness([int("15181c"[k : k + 2], 16) / 255 for k in (0, 2, 4)])
    for colour in module._SCALE.colours(np.linspace(0, 1, 20)):
        assert 1.05 / (brightness(colour) + 0.05) >= 3
        assert (brightness(colour) + 0.05) / (dark + 0.05) >= 3
