"""Runs of the Godunov scheme: symmetries, slabs, boundaries, failures."""

from dataclasses import replace

import numpy as np
import pytest
from godunov_cases import at_rest, flowing, local

from solver.errors import ModelError, NoAdmissibleProfile, NotSteady, WallCollapse
from solver.geometry.calcification import Patch
from solver.marching.godunov import Stepper, march, march_to_steady, thesis_criteria
from solver.marching.godunov_setup import LIMITERS, State, held, load, reference_state, repeated
from solver.wall.smooth_patch import smooth_wall
from validation.tables.artery import CALCIFIED, HEALTHY, QUARTER_CM, artery, ring

pytestmark = pytest.mark.slow  # compiles a scheme that no other quick test needs

UNKNOWNS = ("area", "flow", "exponent")


def run(setup, initial, steps, threads=1):
    with Stepper(setup, initial, threads) as stepper:
        stepper.advance(steps)
        return stepper.state


def assert_same(one, other, tolerance=0.0):
    for name in UNKNOWNS:
        a, b = getattr(one, name), getattr(other, name)
        if tolerance:
            np.testing.assert_allclose(a, b, rtol=tolerance, err_msg=name)
        else:
            np.testing.assert_array_equal(a, b, err_msg=name)


def test_rest_stays():
    setup = local(**at_rest())
    final = run(setup, reference_state(setup), 200)
    np.testing.assert_allclose(final.area, setup.radius**2, rtol=1e-14)
    assert np.all(np.abs(final.flow) < 1e-18)


def test_equal_rows_are_the_1d_model():
    one = artery(40, 1, 9e-6, ring(QUARTER_CM))
    many = artery(40, 6, 9e-6, ring(QUARTER_CM))
    expected = repeated(run(one, flowing(one), 300), 6)
    assert_same(run(many, flowing(many), 300), expected, 1e-11)


def test_turned_plaque_turns_the_solution():
    setup = local()
    turn = 4 * setup.grid.dphi
    patch = Patch((5e-3, 10e-3), (0.75 * np.pi + turn, 1.25 * np.pi + turn), QUARTER_CM, np.pi / 2)
    turned = local(patch=patch)
    straight, moved = run(setup, flowing(setup), 200), run(turned, flowing(turned), 200)
    rolled = State(0.0, *(np.roll(getattr(straight, name), 4, axis=1) for name in UNKNOWNS))
    assert_same(moved, rolled, 1e-10)


@pytest.mark.parametrize("threads", [2, 3])
def test_slabs_change_nothing(threads):
    setup = local(n_x=120, time_step=3e-6)
    start = flowing(setup)
    assert_same(run(setup, start, 203, threads), run(setup, start, 203))


def test_narrow_grid_is_one_slab():
    setup = local(n_x=40)
    start = flowing(setup)
    assert_same(run(setup, start, 20, threads=8), run(setup, start, 20))


def test_continuing_from_a_state_is_bit_identical():
    setup = local()
    start = flowing(setup)
    middle = run(setup, start, 120)
    assert_same(run(setup, middle, 80), run(setup, start, 200))


def test_march_reaches_the_nearest_steps():
    setup = artery(30, 1, 1e-5, None)
    seen = []
    result = march(setup, flowing(setup), [0.0, 1.234e-3, 2e-3], progress=lambda *at: seen.append(at))
    assert [state.time for state in result.states] == pytest.approx([0.0, 1.23e-3, 2e-3])
    assert result.steps == 200
    assert seen[-1] == (200, 200)


def test_courant_number_is_that_of_the_fastest_wave():
    setup = artery(30, 1, 1e-5, None, viscosity=0.0, **at_rest())
    wave = np.sqrt(HEALTHY / (2 * setup.density * setup.radius))
    result = march(setup, reference_state(setup), [1e-4])
    assert result.courant == pytest.approx(wave * setup.time_step / setup.grid.dx, rel=1e-12)


def test_section_outlet_of_equal_rows_is_the_row_outlet():
    by_row = artery(30, 4, 1e-5, None, resistance=1.5e9)
    by_section = replace(by_row, outlet_kind="section", resistance=1.5e9 / np.pi)
    start = flowing(by_row, pressure=8e3)
    assert_same(run(by_section, start, 400), run(by_row, start, 400), 1e-11)


def test_section_outlet_has_one_pressure():
    setup = replace(local(), outlet_kind="section", resistance=4e8)
    final = run(setup, flowing(setup), 300)
    root = np.sqrt(final.area[-1])
    pressure = setup.wall.stiffness[-1] * (root - setup.radius) / setup.radius**2
    flow = 0.5 * setup.grid.dphi * final.flow[-1].sum()
    np.testing.assert_allclose(pressure, 9330.0 + 4e8 * flow, rtol=1e-11)


def test_reference_pressure_only_shifts_pressures():
    """P₀ and P_res raised alike leave the motion as it was."""
    setup = artery(30, 1, 1e-5, None)
    raised = replace(setup, reference_pressure=2e3, offset=held(9330.0 + 2e3))
    start = flowing(setup)
    assert_same(run(raised, start, 200), run(setup, start, 200), 1e-12)


def test_no_resistance_is_a_pressure_outlet():
    setup = artery(30, 1, 1e-5, None, resistance=0.0, offset=held(5e3))
    final = run(setup, flowing(setup, pressure=5.5e3), 300)
    pressure = HEALTHY * (np.sqrt(final.area[-1]) - setup.radius) / setup.radius**2
    assert pressure == pytest.approx(5e3, rel=1e-12)


def test_pulse_leaves_by_the_non_reflecting_outlet():
    def pulse(times):
        return 1e3 * np.exp(-(((times - 4e-4) / 1e-4) ** 2))

    setup = artery(120, 1, 8e-6, None, **at_rest(inlet=pulse))
    final = run(setup, reference_state(setup), 500)
    height = 1e3 * setup.radius**2 / HEALTHY
    assert np.max(np.abs(np.sqrt(final.area) - setup.radius)) < 0.01 * height


@pytest.mark.parametrize("limiter", sorted(LIMITERS))
def test_every_limiter_runs(limiter):
    setup = artery(40, 1, 9e-6, ring(QUARTER_CM), limiter=limiter, inlet=load(0, 1e-3, 0, 0.08))
    final = run(setup, reference_state(setup), 200)
    assert np.all(np.isfinite(final.flow))


@pytest.mark.parametrize("closure", ["maximum", "least_squares"])
def test_other_closures_are_continuous_on_the_axis(closure):
    setup = replace(local(), closure=closure)
    final = run(setup, flowing(setup), 20)
    on_axis = (1 + 2 / final.exponent) * final.flow / final.area
    np.testing.assert_allclose(on_axis, on_axis[:, :1] * np.ones(12), rtol=1e-12)


def test_printed_coefficients_matter_only_where_profiles_vary():
    printed = {"viscous_exchange": "printed", "exponent_gradient": "printed"}
    smooth, rough = artery(30, 4, 1e-5, None), local()
    assert_same(
        run(replace(smooth, **printed), flowing(smooth), 100), run(smooth, flowing(smooth), 100), 1e-12
    )
    changed, usual = run(replace(rough, **printed), flowing(rough), 100), run(rough, flowing(rough), 100)
    difference = np.max(np.abs(changed.flow - usual.flow)) / np.max(np.abs(usual.flow))
    assert 1e-5 < difference < 1e-2


def test_wall_ramp_ends_on_its_wall():
    setup = local()
    uniform = smooth_wall(setup.grid, None, HEALTHY, CALCIFIED)
    ramped = replace(setup, wall_before=uniform, wall_load=load(0.0, 5e-3, 0.0, 1.0))
    begun = run(ramped, flowing(replace(setup, wall=uniform)), 600)
    assert_same(run(ramped, begun, 100), run(setup, begun, 100))


def test_backward_row_is_a_named_failure():
    setup = local()
    start = flowing(setup)
    start.flow[20, 4] *= -1
    with pytest.raises(NoAdmissibleProfile) as failure, Stepper(setup, start) as stepper:
        stepper.advance(5)
    assert failure.value.time == pytest.approx(setup.time_step)
    assert abs(failure.value.i - 20) <= 1
    assert failure.value.j == 5


def test_too_large_a_time_step_collapses():
    setup = artery(60, 1, 30e-6, None, **at_rest(inlet=held(1e4)))
    with pytest.raises(WallCollapse) as failure:
        march(setup, reference_state(setup), [20e-3])
    assert 1 <= failure.value.i <= 60
    assert failure.value.j == 1
    assert 0 < failure.value.time < 20e-3


def test_failure_on_an_end_names_its_neighbour():
    setup = local(inlet=lambda times: np.full(times.shape, np.nan))
    with pytest.raises(WallCollapse, match="inlet") as failure, Stepper(setup, flowing(setup)) as stepper:
        stepper.advance(1)
    assert failure.value.i == 1


def test_no_steady_state_in_time():
    setup = artery(30, 1, 1e-5, None)
    with pytest.raises(NotSteady, match=r"no steady state was reached at t = 0\.001 s: the criteria"):
        march_to_steady(setup, reference_state(setup), thesis_criteria("flow"), longest=1e-3)


def test_one_more_criterion_delays_the_steady_state():
    setup = artery(30, 1, 1e-5, None)
    first = march_to_steady(setup, reference_state(setup), thesis_criteria("flow"), longest=1.0)
    later = march_to_steady(
        setup,
        reference_state(setup),
        thesis_criteria("flow"),
        longest=1.0,
        also=lambda state: state.time > first.state.time + 0.5e-3,
    )
    assert later.steps > first.steps


@pytest.mark.parametrize(
    "wrong",
    [
        {"limiter": "none"},
        {"closure": "median"},
        {"inlet_kind": "vacuum"},
        {"outlet_kind": "open"},
        {"viscous_exchange": "other"},
        {"time_step": 0.0},
        {"time_step": np.inf},
        {"density": -1.0},
        {"fixed_exponent": 0.0},
    ],
)
def test_set_up_refuses(wrong):
    with pytest.raises(ModelError, match=next(iter(wrong))):
        replace(local(), **wrong)


def test_wall_of_another_grid_is_refused():
    with pytest.raises(ModelError, match="shape"):
        replace(local(), wall=local(n_x=30).wall)


def test_state_of_another_grid_is_refused():
    with pytest.raises(ModelError, match="shape"):
        Stepper(local(), flowing(local(n_x=30)))


def test_state_without_area_is_refused():
    setup = local()
    start = flowing(setup)
    start.area[3, 3] = 0.0
    with pytest.raises(ModelError, match="positive"):
        Stepper(setup, start)


@pytest.mark.parametrize("times", [[], [1e-3, 0.5e-3], [-1.0]])
def test_times_are_refused(times):
    setup = artery(30, 1, 1e-5, None)
    with pytest.raises(ModelError, match="times"):
        march(setup, reference_state(setup), times)


def test_criteria_are_named():
    with pytest.raises(ModelError, match="allowed"):
        thesis_criteria("all")
