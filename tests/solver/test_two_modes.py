"""Profiles of two modes: closed forms, boundaries, mass, backflow, resuming.

Womersley's exact answer to a pressure gradient e^{iωt} in a rigid tube, relative error of u and D:

| α | two modes | γ = 2 |
|---|---|---|
| 1 | 2.0, 2.0 % | 4.1, 6.2 % |
| 3 | 9.1, 9.1 % | 24, 41 % |
| 6 | 11, 10 % | 24, 90 % |
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import jv
from test_every_boundary import INLETS, LOAD, OUTLETS
from test_inlets import BASE, Rise, bump
from test_section_pressure import with_sections
from thesis_artery import DIASTOLE, HEALTHY, LENGTH, PATTERNS, RADIUS, artery, patched

from solver.geometry.grid import Grid
from solver.marching.row_stepper import Stepper
from solver.marching.section_stepper import SectionStepper, stepper_of
from solver.marching.semi_implicit import implicitness
from solver.marching.steady import steady_state
from solver.model.boundary import Inlet, PressureOutlet
from solver.model.parameters import uniform_state
from solver.model.profiles import TwoModes
from solver.model.waveform import FourierSeries, constant
from solver.schemes.two_modes.rows import velocities

pytestmark = pytest.mark.slow  # compiles a scheme that no other quick test needs

CLOSURES = ("mean", "axis_momentum")
WAY = [pytest.param(False, id="rows"), pytest.param(True, id="sections")]
Y, WEIGHTS = np.polynomial.legendre.leggauss(40)
Y, WEIGHTS = 0.5 * (Y + 1), 0.5 * WEIGHTS


def with_modes(model, closure, sections=True, exponent=2.0):
    model = replace(model, two_modes=TwoModes(closure, exponent))
    return with_sections(model) if sections else model


@pytest.mark.parametrize("exponent", [1.0, 2.0, 5.5, 9.0])
@pytest.mark.parametrize(("u", "d"), [(0.1, 0.3), (-0.05, 0.02), (0.2, -0.1), (0.1, 0.1)])
def test_integrals(exponent, u, d):
    modes = TwoModes("mean", exponent)
    v = modes.velocity(Y, np.asarray(d), modes.bend(np.asarray(u), np.asarray(d)))
    assert 2 * np.sum(WEIGHTS * Y * v) == pytest.approx(u, rel=1e-10)
    uu, ud, dd = modes.momentum
    assert 2 * np.sum(WEIGHTS * Y * v**2) == pytest.approx(uu * u**2 + ud * u * d + dd * d**2, rel=1e-10)
    near = modes.velocity(np.array([1.0 - 1e-7]), np.asarray(d), modes.bend(np.asarray(u), np.asarray(d)))
    by_u, by_d = modes.wall_slope
    assert near[0] / 1e-7 == pytest.approx(by_u * u + by_d * d, abs=1e-5)


@pytest.mark.parametrize("sections", WAY)
@pytest.mark.parametrize("closure", CLOSURES)
def test_poiseuille(closure, sections):
    """D = 2u and ∂_xP = −8μu/R² far from where a stiff wall's taper matters."""
    model = artery(16, 4, stiffness=np.full((16, 4), 1e5 * HEALTHY))
    state = steady_state(with_modes(model, closure, sections), DIASTOLE)
    columns = state.flow[4:-4].mean(axis=1) / RADIUS**2
    assert_allclose(columns, DIASTOLE, rtol=1e-4)
    if closure == "axis_momentum":
        assert_allclose(state.axis_velocity, 2 * DIASTOLE, rtol=1e-4)
    slope = np.diff(state.pressure.mean(axis=1)) / model.grid.dx
    assert_allclose(slope[3:-3], -8 * model.viscosity * DIASTOLE / RADIUS**2, rtol=2e-4)


@pytest.mark.parametrize("sections", WAY)
@pytest.mark.parametrize("pattern", ["none", "axisymmetric, sharp"])
def test_the_mean_around_an_axisymmetric_wall_is_poiseuilles_exponent(pattern, sections):
    model = artery(16, 4, patch=PATTERNS[pattern], inlet=INLETS["velocity"])
    start = uniform_state(model, LOAD, DIASTOLE)
    power = stepper_of(with_sections(model) if sections else model, start)
    modes = stepper_of(with_modes(model, "mean", sections), start)
    for stepper in (power, modes):
        stepper.advance_through(0.0, 1e-3, 100, implicitness(1e-3))
    assert np.max(np.abs(np.sqrt(modes.state().area / power.state().area) - 1)) < 1e-7


@pytest.mark.parametrize("closure", CLOSURES)
@pytest.mark.parametrize("outlet", list(OUTLETS))
@pytest.mark.parametrize("inlet", list(INLETS))
def test_one_row_is_one_section(inlet, outlet, closure):
    model = artery(12, 1, patch=PATTERNS["axisymmetric, sharp"], inlet=INLETS[inlet], outlet=OUTLETS[outlet])
    start = uniform_state(model, LOAD, DIASTOLE)
    rows = Stepper(with_modes(model, closure, sections=False), start)
    rows.tolerance = 1e-13
    sections = SectionStepper(with_modes(model, closure), start, tolerance=1e-13)
    for n in range(10):
        defects = [s.advance_through(5e-3 * n, 1e-3, 5, implicitness(1e-3)) for s in (rows, sections)]
        assert max(map(abs, defects)) < 1e-10
    one, other = rows.state(), sections.state()
    assert np.max(np.abs(one.flow - other.flow)) < 1e-9 * np.max(np.abs(one.flow))
    assert np.max(np.abs(one.pressure - other.pressure)) < 1e-9 * np.max(one.pressure)
    if closure == "axis_momentum":
        assert np.max(np.abs(one.axis_velocity - other.axis_velocity)) < 1e-9


def womersley(alpha):
    """Amplitudes of u and D for −(1/ρ)∂_xP = e^{iωt}, times ω: exact, and of two modes."""
    root = alpha * 1j**1.5
    mean, axis = 1 - 2 * jv(1, root) / (root * jv(0, root)), 1 - 1 / jv(0, root)
    square = 1j * alpha**2
    modes = np.linalg.solve([[square + 32, -12], [-16, square + 12]], [square, square])
    return np.array([mean, axis]) / 1j, modes / 1j


@pytest.mark.parametrize(("alpha", "error"), [(1, 0.021), (3, 0.092), (6, 0.113)])
def test_womersley(alpha, error):
    """A stiff tube follows the two modes' own answer, which is this close to the exact one."""
    exact, modes = womersley(alpha)
    assert np.max(np.abs(modes / exact - 1)) < error
    omega = alpha**2 * 0.003 / (1060 * RADIUS**2)
    period, drop = 2 * np.pi / omega, 30.0
    inlet = Inlet("pressure", FourierSeries(period, 1.2e4, (drop,), (0.0,)))
    model = artery(6, 1, stiffness=np.full((6, 1), 1e6 * HEALTHY), inlet=inlet)
    model = with_modes(replace(model, outlet=PressureOutlet(constant(1.2e4, period))), "axis_momentum", False)
    stepper, steps = Stepper(model, uniform_state(model, 1.2e4, 0.0)), 200
    found = []
    cycles = int(np.ceil(12 / alpha**2)) + 4
    for n in range(cycles * steps):
        stepper.advance_through(n * period / steps, period / steps, 1, 0.5)
        if n >= (cycles - 1) * steps:
            state = stepper.state()
            found.append((state.flow[3, 0] / RADIUS**2, state.axis_velocity[3]))
    times = period / steps * (np.arange(steps) + 1)
    amplitudes = 2 * np.mean(np.array(found) * np.exp(-1j * omega * times)[:, None], axis=0)
    expected = modes / omega * drop / (1060 * model.grid.length)
    assert_allclose(amplitudes, expected, rtol=5e-3)


def reversing(period=0.2):
    """Mean velocity from 0.3 m/s forward to 0.1 m/s back."""
    return FourierSeries(period, 0.08, (0.0, -0.08), (0.15, 0.0))


@pytest.mark.parametrize("time_step", [1e-3, 1e-4])
@pytest.mark.parametrize("sections", WAY)
@pytest.mark.parametrize("closure", CLOSURES)
def test_flow_that_reverses_becomes_periodic_and_keeps_mass(closure, sections, time_step):
    """E_calcified/E_healthy = 100; changes over the last cycle are taken over the cycle's largest values."""
    grid, period = Grid(15e-3, 24, 16), 0.2
    stiffness = patched(grid, PATTERNS["local, sharp"], 100 * HEALTHY)
    model = with_modes(artery(24, 16, stiffness=stiffness, inlet=reversing(period)), closure, sections)
    stepper = stepper_of(model, steady_state(model, reversing()(0.0)))
    flow, pressure = [], []
    for n in range(100):
        count = round(0.1 * period / time_step)
        defect = stepper.advance_through(0.1 * n * period, time_step, count, implicitness(time_step))
        assert abs(defect) < 2e-12  # of a tenth of a cycle: round-off where little flows in
        state = stepper.state()
        flow.append(state.flow)
        pressure.append(state.pressure)
    assert np.min(flow[-10:]) < -1e-7
    for values in (np.array(flow), np.array(pressure)):
        change = np.max(np.abs(values[-10:] - values[-20:-10]))
        assert change < 1e-6 * np.max(np.abs(values[-10:]))


@pytest.mark.parametrize("sections", WAY)
def test_many_rows_take_long_steps(sections):
    """Exchange around 192 rows would call for steps of a quarter of a millisecond."""
    model = artery(8, 192, patch=PATTERNS["local, smooth"], inlet=reversing())
    model = with_modes(model, "axis_momentum", sections)
    stepper = stepper_of(model, uniform_state(model, LOAD, 0.08))
    stepper.advance_through(0.0, 1e-3, 60, implicitness(1e-3))
    assert stepper.sweeps / stepper.steps < 20
    assert np.all(np.isfinite(stepper.state().flow))


@pytest.mark.parametrize("sections", WAY)
def test_a_state_goes_on_to_the_same_bits(sections):
    model = artery(8, 8, patch=PATTERNS["local, sharp"], inlet=reversing())
    model = with_modes(model, "axis_momentum", sections)
    start = uniform_state(model, LOAD, 0.08)
    whole, first = stepper_of(model, start), stepper_of(model, start)
    for n in range(4):
        whole.advance_through(5e-3 * n, 1e-3, 5, 0.52)
    for n in range(2):
        first.advance_through(5e-3 * n, 1e-3, 5, 0.52)
    second = stepper_of(model, first.state())
    for n in range(2, 4):
        second.advance_through(5e-3 * n, 1e-3, 5, 0.52)
    assert np.array_equal(whole.state().axis_velocity, second.state().axis_velocity)
    assert np.array_equal(whole.state().flow, second.state().flow)


def test_a_blunter_base_resists_more():
    """Steady drop of pressure: −∂_y v(1) = (n+2) u where B = 0."""
    drops = {}
    for exponent in (2.0, 9.0):
        model = artery(16, 1, stiffness=np.full((16, 1), 1e5 * HEALTHY))
        state = steady_state(with_modes(model, "mean", True, exponent), DIASTOLE)
        drops[exponent] = state.pressure[3, 0] - state.pressure[-4, 0]
    assert drops[9.0] / drops[2.0] == pytest.approx(11 / 4, rel=1e-3)


@pytest.mark.parametrize("closure", CLOSURES)
def test_second_order_in_time(closure):
    """Of P, and of D where it is an unknown; the flow starts to change slowly, as waves need."""
    inlet = FourierSeries(0.2, 0.08, (-0.08, -0.04, 0.04), (0.0, 0.0, 0.0))
    model = with_modes(artery(8, 8, patch=PATTERNS["local, smooth"], inlet=inlet), closure)
    start = steady_state(model, inlet(0.0))
    found = []
    for time_step in (1e-3, 5e-4, 2.5e-4, 1.25e-4):
        stepper = SectionStepper(model, start, tolerance=1e-12)
        stepper.advance_through(0.0, time_step, round(0.04 / time_step), 0.5)
        found.append(unknowns(stepper.state()))
    assert_second_order(found)


def unknowns(state):
    axis = [] if state.axis_velocity is None else [state.axis_velocity]
    return [state.pressure, *axis]


def assert_second_order(found):
    """Of the last halving, in the root mean square."""
    errors = [[np.linalg.norm(a - b) for a, b in zip(*two, strict=True)] for two in pairwise(found)]
    observed = np.log2(np.array(errors[-2]) / np.array(errors[-1]))
    assert np.all((observed > 1.9) & (observed < 2.1)), observed


def driven(closure, n_x, n_phi):
    """State of an artery with a smooth bump of its wall after a smooth rise of flow."""
    grid = Grid(LENGTH, n_x, n_phi)
    model = artery(n_x, n_phi, inlet=Inlet("velocity", Rise("velocity")), stiffness=bump(grid))
    stepper = stepper_of(
        with_modes(model, closure), steady_state(with_modes(model, closure), BASE["velocity"])
    )
    stepper.tolerance = 1e-10
    stepper.advance_through(0.0, 2e-3, 40, 0.5)
    return stepper.state()


@pytest.mark.parametrize("closure", CLOSURES)
def test_second_order_along_the_artery(closure):
    states = [driven(closure, n_x, 4) for n_x in (40, 80, 160, 320)]
    found = [
        [s.pressure.reshape(20, -1, 4).mean(axis=1), s.flow[:: n_x // 20], *faces(s, n_x // 20)]
        for s, n_x in zip(states, (40, 80, 160, 320), strict=True)
    ]
    assert_second_order(found)


def faces(state, every):
    return [] if state.axis_velocity is None else [state.axis_velocity[::every]]


@pytest.mark.parametrize("closure", CLOSURES)
def test_second_order_around_the_artery(closure):
    """Of D and how unequal the rows' flows are; n_phi changes P and section flows by round-off."""
    states = [driven(closure, 20, n_phi) for n_phi in (8, 16, 32, 64)]
    found = [[s.flow.std(axis=1), *faces(s, 1)] for s in states]
    assert_second_order(found)


@pytest.mark.parametrize(("mirrored", "beside"), [(False, [-2, 1]), (True, [1, -2])])
def test_rows_have_neighbours_beyond_the_first_and_the_last(mirrored, beside):
    """The other end of a ring; on one half of it, the mirror images."""
    area, flow = 1.0 + np.arange(12.0).reshape(3, 4), np.arange(12.0, 24.0).reshape(3, 4)
    found, u = np.empty((3, 6)), np.empty((3, 6))
    velocities(flow, area, mirrored, found, u)
    np.testing.assert_array_equal(found[:, 1:-1], area)
    np.testing.assert_array_equal(u[:, 1:-1], flow / area)
    for values in (found, u):
        np.testing.assert_array_equal(values[:, [0, -1]], values[:, beside])
