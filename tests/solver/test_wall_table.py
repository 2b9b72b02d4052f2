"""Walls given as a table: interpolation, inversion, limits; in the kernels the same as the law itself."""

import numpy as np
import pytest
from thesis_artery import (
    DIASTOLE,
    HEALTHY,
    PATTERNS,
    RADIUS,
    SECTION_OUTLET,
    artery,
    patched,
    thesis_waveform,
)

from cases.reading.case_file import load_case_file
from cases.sections.wall_laws import LAWS
from solver.case.model import model_of
from solver.errors import BeyondWallTable, ModelError
from solver.geometry.grid import Grid
from solver.marching.row_stepper import Stepper
from solver.marching.semi_implicit import simulate
from solver.model.parameters import uniform_state
from solver.wall.finite_strain import inflation_curve
from solver.wall.table import MasterCurve, WallTable, wall_table

MODULUS = 0.6e6
LINEAR = MasterCurve(
    np.array([-20e3, 40e3]),
    RADIUS + np.array([-20e3, 40e3]) * RADIUS**2 / HEALTHY,
    np.full(2, RADIUS**2 / HEALTHY),
)


def finite_strain(material="neo_hookean"):
    return inflation_curve(LAWS[material].stresses, MODULUS, 0.48, RADIUS, 0.5e-3, -20e3, 36e3)


def test_a_linear_table_is_the_linear_wall():
    ratio = np.array([[1.0, 2.0, 50 / 3, 1.0]] * 3)
    table = wall_table(LINEAR, ratio, 0.0, -15e3, 35e3)
    load = np.linspace(-15e3, 35e3, 12).reshape(3, 4)
    np.testing.assert_allclose(
        table.area(load), (RADIUS + load * RADIUS**2 / (ratio * HEALTHY)) ** 2, rtol=1e-13
    )


@pytest.mark.parametrize("pattern", ["none", "axisymmetric, sharp", "local, smooth"])
@pytest.mark.parametrize("by", ["section", "row"])
def test_a_linear_table_runs_as_the_linear_wall(pattern, by):
    stiffness = patched(Grid(15e-3, 12, 8), PATTERNS[pattern])
    table = wall_table(LINEAR, stiffness / HEALTHY, 0.0, -15e3, 35e3)
    outlet = type(SECTION_OUTLET)(SECTION_OUTLET.resistance, SECTION_OUTLET.offset, by)
    runs = [
        simulate(
            artery(12, 8, inlet=thesis_waveform(), outlet=outlet, stiffness=stiffness, wall_table=one),
            [0.0, 0.1, 0.2],
            1e-3,
        )
        for one in (None, table)
    ]
    np.testing.assert_allclose(runs[1].flow, runs[0].flow, rtol=1e-10)
    np.testing.assert_allclose(runs[1].area, runs[0].area, rtol=1e-10)
    np.testing.assert_allclose(runs[1].pressure, runs[0].pressure, rtol=1e-10)


@pytest.mark.parametrize("material", ["neo_hookean", "saint_venant_kirchhoff"])
def test_pressure_and_area_are_inverse(material):
    table = wall_table(finite_strain(material), np.array([[1.0, 2.0, 16.0, 1.0]] * 3), 500.0, -15e3, 30e3)
    load = np.random.default_rng(1).uniform(table.start, table.end, (5, 3, 4))
    area = np.array([table.area(one) for one in load])
    np.testing.assert_allclose(table.pressure(area), load, rtol=1e-9, atol=1e-6)


@pytest.mark.parametrize("ratio", [1.0, 50 / 3])
def test_a_table_keeps_the_law(ratio):
    """A stiffer wall bears the same stretch at a proportional pressure."""
    table = wall_table(finite_strain(), np.full((3, 4), ratio), 1e3, -10e3, 25e3)
    for load in (-8e3, 0.0, 3333.0, 24e3):
        own = inflation_curve(
            LAWS["neo_hookean"].stresses,
            ratio * MODULUS,
            0.48,
            RADIUS,
            0.5e-3,
            min(load, 0.0) - 1.0,
            max(load, 0.0) + 1.0,
        )
        exact = np.interp(load, own.loads, own.radii)
        np.testing.assert_allclose(np.sqrt(table.area(np.full((3, 4), 1e3 + load))), exact, rtol=1e-6)


def test_the_slope_of_a_table_sets_the_wave_speed():
    """c² = A/(ρ dA/dP): a small pulse travels so fast along a finite-strain tube."""
    n_x, length, load = 400, 0.2, 10e3
    table = wall_table(finite_strain(), np.ones((n_x, 1)), 0.0, -10e3, 30e3)
    model = artery(n_x, 1, length=length, stiffness=np.full((n_x, 1), 301.0), wall_table=table, viscosity=0.0)
    pair = np.sqrt([table.area(np.full((n_x, 1), load + d))[0, 0] for d in (-50.0, 0.0, 50.0)])
    speed = np.sqrt(pair[1] / (2 * 1060.0 * (pair[2] - pair[0]) / 100.0))
    stepper = Stepper(model, uniform_state(model, load, 0.0))
    time_step, steps = 2e-5, 600
    times = np.arange(1, steps + 1) * time_step
    stepper.advance(0.01 * np.where(times < 4e-3, np.sin(np.pi * times / 4e-3) ** 2, 0.0), time_step, 0.5)
    crest = model.grid.x[np.argmax(stepper.state().pressure[:, 0])]
    assert crest == pytest.approx(speed * (steps * time_step - 2e-3), abs=1.5 * model.grid.dx)


def test_beyond_the_table_the_run_stops():
    stiffness = np.full((12, 8), HEALTHY)
    table = wall_table(LINEAR, np.ones((12, 8)), 0.0, -5e3, 12.2e3)
    model = artery(12, 8, stiffness=stiffness, wall_table=table)
    start = uniform_state(model, 12.0e3, DIASTOLE)
    with pytest.raises(
        BeyondWallTable, match=r"range in which the wall law is known at t = 0.00\d s, i = \d+"
    ):
        Stepper(model, start).advance(np.full(5, 1.0), 1e-3, 0.52)
    with pytest.raises(ModelError, match="known from -5000 to 12200 Pa; cell i = 1, j = 1 needs 13000 Pa"):
        model.area(13e3)
    with pytest.raises(ModelError, match="known from -5000 to 12200 Pa only"):
        model.pressure(np.full((12, 8), 9e-6))


def test_tables_that_are_refused():
    with pytest.raises(ModelError, match="covers no pressure between 50000 and 60000 Pa"):
        wall_table(LINEAR, np.ones((3, 4)), 0.0, 50e3, 60e3)
    values = np.ones((3, 4, 5, 2))
    for bad in (np.nan, 0.0, -1.0):
        broken = values.copy()
        broken[1, 2, 3, 1] = bad
        with pytest.raises(ModelError, match="grow with pressure"):
            WallTable(0.0, 1.0, broken)
    with pytest.raises(ModelError, match="two or more increasing pressures"):
        WallTable(0.0, 0.0, values)
    with pytest.raises(ModelError, match="cells"):
        artery(12, 8, wall_table=WallTable(0.0, 1.0, values))


@pytest.fixture
def case_with_wall(case_file):
    def load(wall, variant="healthy"):
        line = "wall: {law: thin, youngs_modulus: 0.6 MPa, poisson_ratio: 0.5}"
        text = case_file.read_text()
        assert line in text
        case_file.write_text(text.replace(line, f"wall: {wall}"))
        return model_of(load_case_file(case_file).variants[variant])

    return load


def test_a_users_table(case_with_wall, case_file):
    """The points of the table are kept; calcified cells bear the same stretch at 50/3 of the load."""
    radii = np.linspace(2.2, 3.2, 21)
    pressures = 3.0 + 60 * (radii / 2.5 - 1) + 200 * (radii / 2.5 - 1) ** 3
    lines = [f"{r:.17g},{p:.17g}" for r, p in zip(radii, pressures, strict=True)]
    case_file.with_name("wall.csv").write_text("\n".join(["radius_mm,pressure_kPa", *lines]) + "\n")
    model = case_with_wall("{law: table, table: wall.csv, youngs_modulus: 0.6 MPa}", "patch")
    assert model.reference_pressure == pytest.approx(3e3, rel=1e-4)
    for r, p in zip(radii[4:12], pressures[4:12], strict=True):
        if model.wall_table.start <= 1e3 * p <= model.wall_table.end:
            np.testing.assert_allclose(np.sqrt(model.area(1e3 * p))[0], 1e-3 * r, rtol=1e-6)
    hard, soft = np.unravel_index(np.argmax(model.stiffness), (12, 8)), (0, 0)
    assert model.stiffness[hard] / model.stiffness[soft] == pytest.approx(50 / 3)
    start, load = model.reference_pressure, 0.4e3
    stretched = model.area(start + load * 50 / 3)[hard]
    assert stretched == pytest.approx(model.area(start + load)[soft], rel=1e-5)


@pytest.mark.parametrize("law", ["neo_hookean", "saint_venant_kirchhoff, reference_pressure: 8 kPa"])
def test_finite_strain_from_a_case(case_with_wall, law):
    model = case_with_wall(f"{{law: {law}, youngs_modulus: 0.6 MPa, poisson_ratio: 0.48}}", "patch")
    start = model.reference_pressure
    np.testing.assert_allclose(np.sqrt(model.area(start)), 2.5e-3, rtol=1e-9)
    soft, hard = model.stiffness.min(), model.stiffness.max()
    assert soft == pytest.approx(301, abs=0.5)
    assert hard / soft == pytest.approx(50 / 3)
    small = (np.sqrt(model.area(start + 1.0)) - np.sqrt(model.area(start - 1.0))) / 2.0
    np.testing.assert_allclose(small, 2.5e-3**2 / model.stiffness, rtol=1e-5)


def test_layers_from_a_case(case_with_wall):
    """Only the media calcifies."""
    layers = (
        "{name: intima, thickness: 0.1 mm, youngs_modulus: 0.6 MPa}, "
        "{name: media, thickness: 0.3 mm, youngs_modulus: 0.6 MPa, calcifies: true}, "
        "{name: adventitia, thickness: 0.1 mm, youngs_modulus: 0.6 MPa}"
    )
    model = case_with_wall(f"{{law: layered, poisson_ratio: 0.48, layers: [{layers}]}}", "patch")
    assert model.stiffness.min() == pytest.approx(301, abs=0.5)
    assert 301 * 2 < model.stiffness.max() < 301 * 50 / 3
    assert model.wall_table is None
