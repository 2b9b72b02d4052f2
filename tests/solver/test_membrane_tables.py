"""Tables A(P) of a membrane: what they interpolate, where they are kept, what they neglect."""

from dataclasses import replace

import numpy as np
import pytest

import solver.kept as kept
from solver.errors import ModelError
from solver.geometry.grid import Grid
from solver.wall import membrane_tables
from solver.wall.membrane_tables import MembraneWall, radii, section_wall
from solver.wall.sections import SectionWall, linear_section_wall, row_table

pytestmark = pytest.mark.slow

RADIUS, HEALTHY, CALCIFIED = 2.5e-3, 301.0, 5017.0


def wall(n_x=24, n_phi=16, length=15e-3, ratio=CALCIFIED / HEALTHY, supports="quarters"):
    grid = Grid(length, n_x, n_phi)
    patch = ((grid.x > length / 3) & (grid.x < length / 1.5))[:, None] & (
        np.abs(grid.phi - np.pi) < np.pi / 4
    )
    stiffness = HEALTHY * np.where(patch, ratio, 1.0)
    return MembraneWall(
        grid=grid,
        radius=RADIUS,
        reference_pressure=0.0,
        stiffness=lambda _: stiffness,
        shear=0.1 / 0.301 * stiffness,
        supports=supports,
        highest_load=48e3,
    )


@pytest.mark.parametrize("ratio", [1.0, CALCIFIED / HEALTHY, 100.0])
@pytest.mark.parametrize("pressure", [700.0, 12e3, 16e3, 40e3])
def test_between_pressures_a_table_is_the_membrane(ratio, pressure, tmp_path):
    one = wall(ratio=ratio)
    everywhere = np.full(one.grid.n_x, pressure)
    exact = radii(one, everywhere)
    found = np.sqrt(section_wall(one, tmp_path).area(everywhere))
    assert np.max(np.abs(found / exact - 1)) < (1e-12 if ratio == 1.0 else 2e-4)


def test_below_the_reference_pressure_radii_go_on_linearly(tmp_path):
    tables = section_wall(wall(), tmp_path)
    down, up = (np.sqrt(tables.area(np.full(24, p))) for p in (-50.0, 50.0))
    assert np.allclose(up - RADIUS, RADIUS - down, rtol=0.02, atol=1e-9)
    assert tables.area(np.zeros(24)) == pytest.approx(RADIUS**2, rel=1e-14)


def test_slopes_are_those_of_the_areas(tmp_path):
    tables = section_wall(wall(), tmp_path)
    low, high = (tables.area(np.full(24, p)) for p in (15990.0, 16010.0))
    slope = tables.area_and_slope(np.full(24, 16000.0))[1]
    assert np.allclose((high - low) / 20.0, slope, rtol=1e-6, atol=0)


def test_any_number_of_rows(tmp_path):
    """Membranes need a multiple of four cells around: rows share them."""
    for n_phi in (1, 6, 7):
        one = wall(n_phi=n_phi, ratio=1.0)
        area = section_wall(one, tmp_path).area(np.full(24, 16e3))
        assert area.shape == (24, n_phi)
        assert np.allclose(area, (RADIUS + 16e3 * RADIUS**2 / HEALTHY) ** 2, rtol=1e-12)


def test_a_table_is_computed_once(tmp_path, monkeypatch):
    first = section_wall(wall(), tmp_path)
    assert len(list(tmp_path.iterdir())) == 1
    monkeypatch.setattr(membrane_tables, "radii", None)
    assert np.array_equal(section_wall(wall(), tmp_path).values, first.values)


def test_all_that_determines_a_table_is_in_its_name(tmp_path):
    one = wall()
    others = (
        wall(length=16e-3),
        wall(ratio=5.0),
        wall(supports="free"),
        wall(n_x=25),
        wall(n_phi=20),
        replace(one, radius=2.6e-3),
        replace(one, highest_load=40e3),
        replace(one, shear=one.shear * 1.001),
    )
    for other in (one, *others):
        section_wall(other, tmp_path)
    assert len(list(tmp_path.iterdir())) == 1 + len(others)
    section_wall(replace(one, reference_pressure=100.0), tmp_path)  # shifts the table, not the membrane
    assert len(list(tmp_path.iterdir())) == 1 + len(others)


@pytest.mark.parametrize("damage", ["empty", "cut", "flipped", "other"])
def test_a_damaged_entry_is_computed_again(tmp_path, damage):
    first = section_wall(wall(), tmp_path)
    (entry,) = tmp_path.iterdir()
    content = entry.read_bytes()
    middle = len(content) // 2
    entry.write_bytes(
        {
            "empty": b"",
            "cut": content[:middle],
            "flipped": content[:middle] + bytes([content[middle] ^ 1]) + content[middle + 1 :],
            "other": b"not an array",
        }[damage]
    )
    with pytest.warns(UserWarning, match=r"membrane-.* was damaged .*; computed anew"):
        found = section_wall(wall(), tmp_path)
    assert np.array_equal(found.values, first.values)
    assert entry.read_bytes() == content


def test_an_interrupted_write_leaves_nothing(tmp_path, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(kept.np, "savez", interrupted)
    with pytest.raises(KeyboardInterrupt):
        section_wall(wall(), tmp_path)
    assert not list(tmp_path.iterdir())


def test_without_a_place_to_keep_it_a_table_is_computed(tmp_path):
    missing = tmp_path / "gone"
    assert np.array_equal(section_wall(wall(), missing).values, section_wall(wall(), tmp_path).values)


def test_the_short_artery_is_local_and_a_long_soft_one_is_not(tmp_path):
    one = wall()
    drop = np.linspace(16.05e3, 16e3, 24)
    tables = section_wall(one, tmp_path)
    assert tables.locality_error(radii(one, drop - one.reference_pressure), drop) < 1e-4
    steep = np.linspace(24e3, 6e3, 24)
    assert tables.locality_error(radii(one, steep - one.reference_pressure), steep) > 1e-3


def test_a_linear_row_law_is_exact():
    stiffness = np.array([[300.0, 500.0, 5000.0, 310.0]] * 3)
    pressure = np.array([-2e3, 12e3, 90e3])
    area = linear_section_wall(stiffness, RADIUS, 500.0).area(pressure)
    exact = (RADIUS + (pressure[:, None] - 500.0) * RADIUS**2 / stiffness) ** 2
    assert np.allclose(area, exact, rtol=1e-13, atol=0)


def test_pressure_is_the_inverse_of_area(tmp_path):
    tables = section_wall(wall(), tmp_path)
    pressure = np.linspace(1e3, 40e3, 24)
    assert np.allclose(tables.pressure(tables.area(pressure)), pressure, rtol=1e-12)
    with pytest.raises(ModelError, match="known from"):
        tables.area(np.full(24, 60e3))


def test_rows_with_a_pressure_each_read_the_same_table(tmp_path):
    tables = section_wall(wall(), tmp_path)
    rows = row_table(tables)
    pressure = np.full((24, 16), 14.4e3)
    assert np.allclose(rows.area(pressure), tables.area(pressure[:, 0]), rtol=1e-6)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (np.ones((3, 1, 2, 4)), "two or more"),
        (-np.ones((3, 4, 2, 4)), "positive areas"),
    ],
)
def test_what_a_table_needs(values, message):
    with pytest.raises(ModelError, match=message):
        SectionWall(0.0, 1.0, values)
