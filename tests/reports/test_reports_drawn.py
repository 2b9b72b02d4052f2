import os
from functools import partial

import numpy as np
import pytest
from drawn_figure import drawn
from matplotlib.collections import QuadMesh

from reports.figures import tubes as tubes_module
from reports.figures.lumen_cells import cell_borders
from reports.figures.overview import Cycle, OverviewRow, overview
from reports.figures.tubes import Tube, tubes
from reports.figures.two_processes import draw, helper


def _drawing(label: str) -> partial[str]:
    x = np.linspace(0, 1, 12)
    rows = [OverviewRow("P (kPa)", 1.0, (Cycle(1 + x, (1.1 + x,)),))]
    return partial(overview, x, [label], rows, ["2D"])


def _broken() -> str:
    raise ValueError("cannot be drawn")


def test_two_processes_draw_what_one_draws(monkeypatch: pytest.MonkeyPatch) -> None:
    drawings = {name: _drawing(name) for name in ("a", "b", "c")}
    alone = draw(drawings, None)
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    with helper() as second:
        assert second is not None
        assert draw(drawings, second) == alone
    assert len(set(alone.values())) == 3


def test_one_processor_has_no_helper(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "cpu_count", lambda: 1)
    with helper() as second:
        assert second is None


def test_a_helper_that_fails_is_an_error(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    broken = partial(np.zeros, -1)  # fails where it is called
    with helper() as second, pytest.raises(RuntimeError, match="ended with status 1"):
        draw({"first": _drawing("a"), "second": broken}, second)  # type: ignore[dict-item]
    assert "negative dimensions" in capfd.readouterr().err


def test_a_helper_ends_with_its_block(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    with pytest.raises(ValueError, match="cannot be drawn"), helper() as second:
        draw({"first": _broken, "second": _drawing("b")}, second)
    assert second is not None
    assert second.poll() is not None


def test_borders_of_a_patch_are_its_rectangle() -> None:
    inside = np.zeros((5, 6), dtype=bool)
    inside[1:3, 2:5] = True
    borders = cell_borders(np.arange(6.0), np.arange(7.0), inside)
    lengths = np.abs(borders[:, 1] - borders[:, 0]).sum(axis=1)
    assert lengths.sum() == 2 * (2 + 3)
    assert set(borders[..., 0].ravel()) == {1.0, 2.0, 3.0}
    assert borders[..., 1].min() == 2.0
    assert borders[..., 1].max() == 5.0


def test_a_lumen_is_drawn_the_same_each_time_even_if_all_alike() -> None:
    x, phi = np.linspace(0.5, 9.5, 10), np.radians(np.arange(15.0, 360, 30))
    radius = np.full((10, 12), 2.5)
    one = Tube(radius, radius, np.zeros(radius.shape, dtype=bool))
    drawings = {tubes(x, phi, 3.1, ("3D", "2D"), [("none", (one, one))], "R (mm)") for _ in range(2)}
    assert len(drawings) == 1
    assert "<image" in drawings.pop()


def test_changes_of_a_lumen_are_coloured_around_zero(monkeypatch: pytest.MonkeyPatch) -> None:
    x, phi = np.linspace(0.5, 9.5, 10), np.radians(np.arange(15.0, 360, 30))
    change = np.full((10, 12), -0.2)
    tube = Tube(change + 2.5, change, np.zeros(change.shape, dtype=bool))
    figure = drawn(
        monkeypatch, tubes_module, lambda: tubes(x, phi, 3.1, ("3D",), [("ring", (tube,))], "ΔR", change=True)
    )
    bar = next(image for image in figure.axes[0].images)
    assert bar.norm.vmin == -0.2
    assert bar.norm.vmax == 0.2
    facets = [mesh.get_facecolor() for mesh in figure.axes[0].collections if isinstance(mesh, QuadMesh)]
    assert sum(map(len, facets)) == 9 * 12, "every facet between neighbouring centres, around and along"
    assert all((colours[:, 2] > colours[:, 0]).all() for colours in facets), "narrower is blue"
