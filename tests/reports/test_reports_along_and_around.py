"""What calcification moves is drawn for each model, with its calcified stretches tinted."""

from functools import partial

import numpy as np
import pytest
from drawn_figure import drawn, filled, line_data

from reports.figures import along_and_around as module
from reports.figures.along_and_around import Change, ChangeRow, along_and_around
from reports.figures.colours import CALCIFIED, MODELS, QUIET, REFERENCE
from reports.figures.lumen_cells import runs

X = np.arange(0.5, 10)
DIP = -np.exp(-((X - 5) ** 2))
INSIDE = (X > 3) & (X < 7)


def _rows() -> list[ChangeRow]:
    change = Change(DIP, (0.5 * DIP, 2 * DIP), INSIDE)
    return [
        ChangeRow("$R$ (mm)", "x (mm)", X, (change, change)),
        ChangeRow("$q$ (mL/s)", "φ (°)", 36 * X, (change, change), (0, 180, 360)),
    ]


def test_lines_and_points_stand_where_their_numbers_say(monkeypatch: pytest.MonkeyPatch) -> None:
    figure = drawn(monkeypatch, module, lambda: along_and_around(("a", "b"), _rows(), ("row", "coupled")))
    (points, _) = line_data(figure, REFERENCE, points=20)
    for stroke, factor in zip(MODELS, (0.5, 2.0), strict=False):
        line = line_data(figure, stroke.colour, points=20)[0]
        assert line[:10, 0] == pytest.approx(points[:10, 0])
        assert np.ptp(line[:10, 1]) == pytest.approx(factor * np.ptp(points[:10, 1]))


def test_each_calcified_stretch_is_tinted_from_edge_to_edge(monkeypatch: pytest.MonkeyPatch) -> None:
    figure = drawn(monkeypatch, module, lambda: along_and_around(("a", "b"), _rows(), ("row", "coupled")))
    boxes = filled(figure, CALCIFIED)
    assert len(boxes) == 4
    panel = np.ptp(line_data(figure, MODELS[0].colour, points=20)[0][:10, 0]) / 9 * 10
    assert np.ptp(boxes[0][:, 0]) == pytest.approx(0.4 * panel)
    assert runs(np.array([True, False, True, True])) == [(0, 1), (2, 4)]


def test_one_cell_around_one_variant_one_model_and_nan() -> None:
    one = Change(np.array([np.nan]), (np.array([0.2]),), np.array([True]))
    rows = [ChangeRow("$R$ (mm)", "φ (°)", np.array([180.0]), (one,))]
    drawings = {along_and_around(("ring − none",), rows, ("2D",)) for _ in range(2)}
    assert len(drawings) == 1


def test_a_scale_without_zero_has_no_line_at_zero(monkeypatch: pytest.MonkeyPatch) -> None:
    rows = [ChangeRow("$R$ (mm)", "x (mm)", X, (Change(3 + DIP, (3 + DIP,), INSIDE),)) for _ in range(3)]

    def lines(from_zero: bool) -> int:
        drawing = partial(along_and_around, ("a",), rows, ("row",), from_zero=from_zero)
        return len(line_data(drawn(monkeypatch, module, drawing), QUIET, points=2))

    assert lines(from_zero=True) == 3
    assert not lines(from_zero=False)
