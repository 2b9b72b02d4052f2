"""The sketch is to scale, and its calcification and numbered places stand where their x and φ say."""

from collections.abc import Sequence

import numpy as np
import pytest
from drawn_figure import drawn, filled, words
from matplotlib.figure import Figure
from matplotlib.patches import Ellipse

from cases.arrays import Flags
from reports.figures import artery_sketch as module
from reports.figures.artery_sketch import Place, artery_sketch

X, PHI = np.linspace(0.25, 14.75, 30), np.arange(7.5, 360.0, 15.0)
RING = np.zeros((30, 24), dtype=bool)
RING[10:20] = True
PATCH = RING & ((PHI > 135) & (PHI < 225))
SCALE = 5.2 / 15.0  # inches a millimetre: the width left for 15 mm


def _figure(
    monkeypatch: pytest.MonkeyPatch, patterns: Sequence[tuple[str, Flags]], places: Sequence[Place]
) -> Figure:
    # 2 × 2.0 mm high, so that the width decides
    return drawn(monkeypatch, module, lambda: artery_sketch(X, PHI, 2.0, patterns, places, 180.0))


def test_the_calcification_is_where_its_cells_are(monkeypatch: pytest.MonkeyPatch) -> None:
    figure = _figure(monkeypatch, [("local", PATCH), ("none", RING & False), ("ring", RING)], [])
    boxes = {tint: np.concatenate(filled(figure, tint)) for tint in ("#f0e2c4", "#d3b078")}
    for ends in boxes.values():
        assert np.ptp(ends[:, 0]) == pytest.approx(5.0 * SCALE)
    assert np.ptp(boxes["#f0e2c4"][:, 1]) == pytest.approx(4.0 * SCALE), "the ring reaches both sides"
    seen = 4.0 * SCALE * np.sin(np.radians(45.0))
    assert np.ptp(boxes["#d3b078"][:, 1]) == pytest.approx(seen), "the patch is a quarter around"
    told = words(figure)
    assert "calcified in local" in told
    assert not any("none" in text for text in told)


def test_places_stand_at_x_and_phi_and_the_far_ones_are_grey(monkeypatch: pytest.MonkeyPatch) -> None:
    places = [Place(1, 3.0, 180.0), Place(2, 12.0, 90.0), Place(3, 7.5, 30.0)]
    figure = _figure(monkeypatch, [], places)
    first, second, far = [
        np.array(patch.center)
        for patch in figure.axes[0].patches
        if isinstance(patch, Ellipse) and patch.width == patch.height
    ]
    assert second - first == pytest.approx([9.0 * SCALE, 2.0 * SCALE])
    assert far - first == pytest.approx([4.5 * SCALE, 1.0 * SCALE])
    colours = {text.get_text(): text.get_color() for text in figure.axes[0].texts}
    assert colours["1"] == colours["2"] != colours["3"]
    assert "numbered place on the far side" in words(figure)


def test_places_that_look_alike_do_not_cover_each_other(monkeypatch: pytest.MonkeyPatch) -> None:
    figure = _figure(monkeypatch, [], [Place(1, 3.0, 150.0), Place(2, 3.0, 30.0)])
    near, far = (patch for patch in figure.axes[0].patches[-2:] if isinstance(patch, Ellipse))
    assert np.hypot(*np.subtract(near.center, far.center)) >= near.width - 1e-9


def test_one_row_of_cells_and_the_same_bytes() -> None:
    flags = np.ones((30, 1), dtype=bool)
    drawings = {artery_sketch(X, np.array([180.0]), 2.5, [("ring", flags)], [], 180.0) for _ in range(2)}
    assert len(drawings) == 1
