"""Tables A(P) of a solid wall: what they interpolate, where they end and are kept, what they neglect."""

from dataclasses import replace

import numpy as np
import pytest

from solver.errors import ModelError
from solver.geometry.grid import Grid
from solver.wall import solid_tables
from solver.wall.solid import Solid
from solver.wall.solid_tables import SolidWall, radii, section_wall

RADIUS = 2.5e-3


def wall(highest_load=30e3):
    moduli = np.full((6, 8), 0.6e6)
    moduli[2:4, 3:5] = 10e6
    solid = Solid(15e-3, RADIUS, 0.5e-3, moduli, 0.48, 1)
    return SolidWall(Grid(15e-3, 12, 16), solid, 1e3, highest_load)


@pytest.fixture(scope="module")
def tables(tmp_path_factory):
    return section_wall(wall(), tmp_path_factory.mktemp("walls"))


@pytest.mark.slow
@pytest.mark.parametrize("load", [2e3, 9e3, 16e3, 29e3])
def test_between_pressures_a_table_is_the_solid(tables, load):
    exact = radii(wall(), np.full(12, load))
    found = np.sqrt(tables.area(np.full(12, 1e3 + load)))
    assert np.max(np.abs(found / exact - 1)) < 1e-4


def test_slopes_are_those_of_the_areas(tables):
    low, high = (tables.area(np.full(12, p)) for p in (15990.0, 16010.0))
    slope = tables.area_and_slope(np.full(12, 16000.0))[1]
    assert np.allclose((high - low) / 20.0, slope, rtol=1e-6, atol=0)


def test_unloaded_and_below(tables):
    assert tables.area(np.full(12, 1e3)) == pytest.approx(RADIUS**2, rel=1e-14)
    down, up = (np.sqrt(tables.area(np.full(12, 1e3 + p))) for p in (-50.0, 50.0))
    assert np.allclose(up - RADIUS, RADIUS - down, rtol=0.02, atol=1e-9)


def test_a_table_ends_where_the_wall_runs_away(tmp_path):
    found = section_wall(wall(120e3), tmp_path)
    assert 50e3 < found.end < 100e3  # eight sectors are far too stiff
    with pytest.raises(ModelError, match="no stable equilibrium"):
        section_wall(wall(1200e3), tmp_path)


def test_tables_are_kept(tmp_path, monkeypatch):
    first = section_wall(wall(), tmp_path)
    monkeypatch.setattr(solid_tables, "equilibrium", None)
    again = section_wall(wall(), tmp_path)
    assert np.array_equal(first.values, again.values)
    stiffer = replace(wall(), solid=replace(wall().solid, moduli=2 * wall().solid.moduli))
    with pytest.raises(TypeError):  # other moduli are another entry
        section_wall(stiffer, tmp_path)


def test_what_a_pressure_of_its_own_neglects(tables):
    one, even = wall(), np.full(12, 17e3)
    assert tables.locality_error(radii(one, even - one.reference_pressure), even) < 1e-4
    falling = np.linspace(20e3, 14e3, 12)
    assert 1e-3 < tables.locality_error(radii(one, falling - one.reference_pressure), falling) < 0.05
