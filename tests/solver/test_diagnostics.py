"""Courant numbers, mass, continuity and energy: right where known, and able to stop a run."""

import sys
from dataclasses import replace

import numpy as np
import pytest
from closed_forms import continuity_exponent
from thesis_artery import DENSITY, DIASTOLE, LENGTH, PATTERNS, SECTION_OUTLET, VISCOSITY, artery

import solver.command as command
from solver.errors import AxisNotContinuous, CourantExceeded, EnergyNotBalanced, MassNotConserved
from solver.marching.columns import columns_of
from solver.marching.semi_implicit import simulate
from solver.marching.steady import steady_state
from solver.model.diagnostics import Columns, Limits, Monitor, last_interval_weights, wall_state
from solver.model.parameters import uniform_state
from solver.schemes.rows.balance import closed_exponents
from solver.wall.sections import linear_section_wall
from solver.wall.table import MasterCurve, wall_table

PERIOD = 0.2


def pulse(time):
    return DIASTOLE * (1 + 0.5 * np.sin(np.pi * np.asarray(time) / PERIOD) ** 4)


def watched(time_step, patch="local, smooth", limits=None):
    model = artery(24, 12, inlet=pulse, patch=PATTERNS[patch])
    return simulate(model, np.linspace(0, PERIOD, 101), time_step, limits=limits)


def look(model, state, **changes):
    columns = columns_of(model, state)._replace(**changes)
    return Monitor(model, Limits()).look(0.0, columns, 1e-3, 0.0)


def test_energy_balance_is_of_second_order_in_time():
    defects = [np.nanmax(np.abs(watched(dt).diagnostics["energy_defect"])) for dt in (2e-3, 1e-3, 0.5e-3)]
    assert defects[-1] < 1e-3
    assert np.all(np.diff(np.log2(defects)) < -1.7), defects


@pytest.mark.parametrize("patch", list(PATTERNS))
def test_energy_balance_holds_for_every_pattern(patch):
    found = watched(1e-3, patch).diagnostics["energy_defect"]
    assert np.all(np.isnan(found[:3]))
    assert np.max(np.abs(found[3:])) < 5e-3


def test_poiseuille_flow_dissipates_8_pi_mu_u_squared_per_length():
    model = artery(12, 8)
    state = uniform_state(model, model.reference_pressure, DIASTOLE)
    found = look(model, state)
    assert found.dissipated_power == pytest.approx(8 * np.pi * VISCOSITY * DIASTOLE**2 * LENGTH)
    lumen = np.pi * model.radius**2 * LENGTH
    assert found.kinetic_energy == pytest.approx(0.5 * DENSITY * DIASTOLE**2 * lumen)
    assert found.wall_energy == pytest.approx(0.0, abs=1e-15)
    assert found.end_power == pytest.approx(0.0, abs=1e-12)
    speed = np.sqrt(400.0 / (2 * DENSITY * model.radius)) + 4 / 3 * DIASTOLE
    assert found.courant_number == pytest.approx(speed * 1e-3 / model.grid.dx, rel=1e-2)
    assert found.advective_courant_number == pytest.approx(DIASTOLE * 1e-3 / model.grid.dx)


def test_steady_flow_loses_at_the_ends_what_it_dissipates():
    model = artery(96, 1)
    found = look(model, steady_state(model, DIASTOLE))
    assert found.dissipated_power + found.profile_power == pytest.approx(found.end_power, rel=1e-3)


def test_continuity_residual_sees_one_wrong_exponent():
    model = artery(12, 8)
    state = uniform_state(model, 9330.0, DIASTOLE)
    exponent = np.full((14, 8), 2.0)
    assert look(model, state, exponent=exponent).continuity_residual < 1e-15
    exponent[5, 3] = 4.0  # (γ+2)/γ falls from 2 to 1.5
    assert look(model, state, exponent=exponent).continuity_residual == pytest.approx(
        0.5 * 7 / 8 / (2 - 0.5 / 8)
    )


def test_a_tabulated_wall_stores_what_a_linear_one_does():
    model = artery(12, 8, patch=PATTERNS["local, sharp"])
    radius, beta = model.radius, model.stiffness
    loads = np.linspace(-2e4, 2e4, 41)
    curve = MasterCurve(loads, radius + loads * radius**2 / 400.0, np.full(41, radius**2 / 400.0))
    table = wall_table(curve, beta / 400.0, 0.0, -1e4, 1.5e4)
    tabulated = artery(12, 8, stiffness=beta, wall_table=table)
    pressure = np.random.default_rng(1).uniform(-5e3, 14e3, (12, 8))
    area = model.area(pressure)
    cells = Columns(area, area, area, pressure)
    (slope, energy), (wanted_slope, wanted) = wall_state(tabulated, cells), wall_state(model, cells)
    np.testing.assert_allclose(slope, wanted_slope, rtol=1e-10)
    assert energy == pytest.approx(wanted, rel=1e-10)


def test_a_wall_of_sections_stores_what_its_rows_do():
    model = artery(12, 8, patch=PATTERNS["local, sharp"], reference_pressure=2e3)
    sections = replace(
        model, section_wall=linear_section_wall(model.stiffness, model.radius, model.reference_pressure)
    )
    pressure = np.broadcast_to(np.random.default_rng(1).uniform(-5e3, 14e3, (12, 1)), (12, 8)).copy()
    area = model.area(pressure)
    cells = Columns(area, area, area, pressure)
    (slope, energy), (wanted_slope, wanted) = wall_state(sections, cells), wall_state(model, cells)
    np.testing.assert_allclose(slope, wanted_slope, rtol=1e-10)
    assert energy == pytest.approx(wanted, rel=1e-10)


def test_a_linear_wall_stores_the_integral_of_its_pressure():
    model = artery(3, 1, reference_pressure=7e3)
    areas = np.linspace(model.radius**2, 1.3 * model.radius**2, 10_001)
    pressures = model.pressure(np.broadcast_to(areas[:, None, None], (areas.size, 3, 1)))
    _, energy = wall_state(model, Columns(*(np.full((3, 1), areas[-1]) for _ in range(4))))
    assert energy == pytest.approx(3 * np.trapezoid(pressures[:, 0, 0], areas), rel=1e-7)


def test_exponents_of_columns_are_those_of_the_closure():
    random = np.random.default_rng(2)
    area, flow = random.uniform(5e-6, 7e-6, (6, 9)), 1e-6 * random.uniform(0.5, 1.5, (6, 9))
    flow[2], flow[4, 3] = 0.0, -1e-6
    found = np.empty(area.shape)
    closed_exponents(area, flow, found)
    np.testing.assert_allclose(found, continuity_exponent(flow / area, 1e-9), rtol=1e-12)


def test_weights_of_the_last_interval_integrate_cubics():
    times = np.array([0.0, 0.3, 0.7, 1.2])
    for power in range(4):
        mean = (1.2 ** (power + 1) - 0.7 ** (power + 1)) / (power + 1) / 0.5
        assert last_interval_weights(times) @ times**power == pytest.approx(mean)


@pytest.mark.parametrize(
    ("name", "limit", "failure", "words"),
    [
        ("courant_number", 5.0, CourantExceeded, "the Courant number is above its limit at t = 0.002 s"),
        ("advective_courant_number", 0.13, CourantExceeded, "advective_courant_number = 0.154"),
        ("mass_defect", 1e-20, MassNotConserved, "mass is not conserved to the limit at t = "),
        ("continuity_residual", 1e-20, AxisNotContinuous, "continuity condition on the axis"),
        ("energy_defect", 1e-9, EnergyNotBalanced, "mechanical energy is not balanced to the limit"),
    ],
)
def test_each_limit_stops_a_run(name, limit, failure, words):
    with pytest.raises(failure, match=words) as stopped:
        watched(1e-3, limits=Limits(**{name: limit}))
    assert f"{name} = " in str(stopped.value)
    assert str(stopped.value).endswith(f"allowed: at most {limit:g}")


def test_wide_limits_stop_no_run():
    limits = Limits(1e3, 1e2, 1e-9, 1e-9, 1e-2)
    free, limited = watched(1e-3), watched(1e-3, limits=limits)
    np.testing.assert_array_equal(free.flow, limited.flow)


def test_powers_are_not_integrated_over_states_too_far_apart():
    model = artery(12, 4)
    monitor = Monitor(model, Limits(energy_defect=1e-15), resolved=0.01)
    columns = columns_of(model, steady_state(model, DIASTOLE))
    found = [monitor.look(t, columns, 1e-3, 0.0) for t in (0.0, 0.01, 0.02, 0.04, 0.05)]
    assert all(np.isnan(each.energy_defect) for each in found)


def test_a_case_states_limits(case_file, monkeypatch, capsys):
    text = case_file.read_text().replace("average,", "average, limits: {courant_number: 2.5},", 1)
    case_file.write_text(text)
    output = case_file.with_name("run.nc")
    monkeypatch.setattr(
        sys, "argv", ["solver", str(case_file), "--variant", "patch", "--output", str(output)]
    )
    assert command.main() == 2
    said = capsys.readouterr().err
    assert said.startswith(str(case_file))
    assert ", variant patch: the Courant number is above its limit at t = 0.02 s: courant_number = " in said
    assert said.endswith("; allowed: at most 2.5\n")
    assert not output.exists()


def test_outlet_column_lies_on_the_outlet():
    model = artery(12, 8, patch=PATTERNS["local, sharp"])
    columns = columns_of(model, steady_state(model, DIASTOLE))
    section = 0.5 * model.grid.dphi * columns.flow[-1].sum()
    law = SECTION_OUTLET.offset + SECTION_OUTLET.resistance * section
    np.testing.assert_allclose(columns.pressure[-1], law)
