"""What each outlet does: its own equation, and what it sends back."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from thesis_artery import DIASTOLE, PATTERNS, STEADY_OUTLET, artery

from solver.errors import ModelError
from solver.marching.row_stepper import Stepper
from solver.marching.semi_implicit import implicitness, simulate
from solver.marching.steady import steady_state
from solver.model.boundary import (
    Inlet,
    NonReflectingOutlet,
    PressureOutlet,
    ResistanceOutlet,
    WindkesselOutlet,
)
from solver.model.parameters import uniform_state
from solver.model.waveform import FourierSeries, Ramped, constant

PERIOD, MEAN_FLOW = 0.8, 1.9e-6
PULSE = FourierSeries(
    PERIOD, MEAN_FLOW, (0.3 * MEAN_FLOW, -0.1 * MEAN_FLOW), (0.4 * MEAN_FLOW, 0.1 * MEAN_FLOW)
)
WINDKESSEL = WindkesselOutlet(1e8, 1.2e9, 1e-10, 600.0)


def section(model, flow):
    return 0.5 * model.grid.dphi * flow.sum(axis=-1)


def follow(model, start, time_step, steps):
    """State after every step."""
    stepper = Stepper(model, start)
    for n in range(steps):
        stepper.advance_through(n * time_step, time_step, 1, implicitness(time_step))
        yield stepper.state()


def stiff_artery(n_phi):
    """A millimetre ten thousand times as stiff: what enters leaves at once."""
    inlet = Inlet("flow", PULSE)
    return artery(4, n_phi, length=1e-3, stiffness=np.full((4, n_phi), 4e6), inlet=inlet, outlet=WINDKESSEL)


@pytest.mark.parametrize("n_phi", [1, 4])
def test_a_windkessel_follows_its_differential_equation(n_phi):
    """C dP_c/dt = q − (P_c − P_v)/R₂, P = P_c + R₁ q; the error is of second order in Δt."""
    model = stiff_artery(n_phi)
    start = steady_state(model, float(PULSE(0.0)))

    def rate(time, reservoir):
        leak = (reservoir - WINDKESSEL.venous_pressure) / WINDKESSEL.distal_resistance
        return (PULSE(time) - leak) / WINDKESSEL.compliance

    errors = []
    for steps in (100, 200, 400):
        times = np.arange(1, steps + 1) * PERIOD / steps
        exact = solve_ivp(rate, (0, PERIOD), [start.reservoir], "DOP853", times, rtol=1e-11, atol=1e-8).y[0]
        states = list(follow(model, start, PERIOD / steps, steps))
        np.testing.assert_allclose([section(model, s.flow[-1]) for s in states], PULSE(times), rtol=1e-6)
        outlet = np.array([s.outlet_pressure for s in states])
        np.testing.assert_allclose(outlet, outlet[:, :1] * np.ones(n_phi), rtol=1e-14)
        behind = exact + WINDKESSEL.proximal_resistance * PULSE(times)
        reservoir = np.array([s.reservoir for s in states])
        errors.append((np.max(np.abs(outlet[:, 0] / behind - 1)), np.max(np.abs(reservoir / exact - 1))))
    assert np.max(errors[-1]) < 2e-4
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert np.all((orders > 1.9) & (orders < 2.1)), orders


@pytest.mark.parametrize("pattern", ["none", "axisymmetric, sharp", "local, sharp"])
def test_a_windkessel_is_two_resistances_in_the_end(pattern):
    model = artery(12, 8, patch=PATTERNS[pattern], inlet=Inlet("flow", PULSE), outlet=WINDKESSEL)
    state = steady_state(model, MEAN_FLOW)
    total = WINDKESSEL.proximal_resistance + WINDKESSEL.distal_resistance
    np.testing.assert_allclose(section(model, state.flow), MEAN_FLOW, rtol=1e-10)
    np.testing.assert_allclose(state.outlet_pressure, 600.0 + total * MEAN_FLOW, rtol=1e-9)
    assert state.reservoir == pytest.approx(600.0 + WINDKESSEL.distal_resistance * MEAN_FLOW, rel=1e-9)


def test_a_stiff_windkessel_is_steady_as_exactly():
    """The area of a stiff wall hardly shows a pressure that still drifts."""
    state = steady_state(stiff_artery(1), MEAN_FLOW)
    assert state.outlet_pressure[0] == pytest.approx(600.0 + 1.3e9 * MEAN_FLOW, rel=1e-9)


def test_a_windkessel_without_capacity_to_store_is_a_resistance():
    """R₂ C far below Δt."""
    patch = PATTERNS["local, sharp"]
    small = WindkesselOutlet(0.3e9, 1.058e9, 1e-18, 9330.0)
    resistance = ResistanceOutlet(1.358e9, 9330.0)
    inlet = FourierSeries(0.2, DIASTOLE, (0.0,), (0.4 * DIASTOLE,))
    flows = []
    for outlet in (small, resistance):
        model = artery(12, 8, patch=patch, inlet=inlet, outlet=outlet)
        stepper = Stepper(model, steady_state(model, DIASTOLE))
        stepper.advance_through(0.0, 1e-3, 150, 1.0)
        flows.append(stepper.state().flow)
    np.testing.assert_allclose(flows[0], flows[1], rtol=1e-6)


def pulse(time):
    """2 cm/s for 6 ms."""
    time = np.asarray(time)
    return 0.02 * np.where(time < 6e-3, np.sin(np.pi * time / 6e-3) ** 2, 0.0)


@pytest.mark.parametrize("time_step", [5e-5, 1e-4, 2e-4])
@pytest.mark.parametrize(("load", "velocity"), [(0.0, 0.0), (9330.0, 0.2)])
@pytest.mark.parametrize("n_phi", [1, 4])
def test_a_pulse_leaves_without_reflection(n_phi, load, velocity, time_step):
    """A tube of 15 cm without friction; a resistance of 1e18 Pa s/m³ returns the same pulse whole."""

    def largest_pressures(outlet):
        model = artery(
            150,
            n_phi,
            length=0.15,
            viscosity=0.0,
            inlet=lambda time: velocity + pulse(time),
            outlet=outlet,
        )
        steps = round(0.05 / time_step)
        middle = [
            abs(float(state.pressure[75].mean()) - load)
            for state in follow(model, uniform_state(model, load, velocity), time_step, steps)
        ]
        passed = round(0.018 / time_step)  # half the tube and the pulse's length at 8 m/s
        return max(middle[:passed]), max(middle[passed:])

    incident, reflected = largest_pressures(NonReflectingOutlet())
    assert incident > 150.0
    assert reflected < 0.01 * incident
    if velocity == 0:
        incident, reflected = largest_pressures(ResistanceOutlet(1e18, load, "row"))
        assert reflected > 0.9 * incident


@pytest.mark.parametrize("pattern", ["none", "local, sharp"])
def test_a_pressure_outlet_has_its_pressure(pattern):
    signal = FourierSeries(0.2, 10e3, (0.0,), (500.0,))
    model = artery(12, 8, patch=PATTERNS[pattern], outlet=PressureOutlet(signal))
    start = steady_state(model, DIASTOLE)
    np.testing.assert_allclose(start.outlet_pressure, 10e3, rtol=1e-14)
    for n, state in enumerate(follow(model, start, 1e-3, 100), start=1):
        np.testing.assert_allclose(state.outlet_pressure, signal(n * 1e-3), rtol=1e-13)


@pytest.mark.parametrize("inlet", ["velocity", "flow"])
def test_a_row_has_its_own_pressure_and_a_section_one(inlet):
    flow = DIASTOLE if inlet == "velocity" else MEAN_FLOW
    signal = FourierSeries(0.2, flow, (0.0,), (0.4 * flow,))
    for by in ("row", "section"):
        outlet = ResistanceOutlet(1.358e9, 9330.0, by)
        model = artery(12, 8, patch=PATTERNS["local, sharp"], inlet=Inlet(inlet, signal), outlet=outlet)
        for state in follow(model, steady_state(model, flow), 1e-3, 100):
            across = state.flow[-1] if by == "row" else section(model, state.flow[-1]) * np.ones(8)
            np.testing.assert_allclose(state.outlet_pressure, 9330.0 + 1.358e9 * across, rtol=1e-9)
        spread = np.ptp(state.outlet_pressure)
        assert spread > 1.0 if by == "row" else spread < 1e-6


def test_an_offset_may_follow_a_load_curve():
    """The thesis raises P_res over 8 ms (3.1)."""
    ramped = ResistanceOutlet(STEADY_OUTLET.resistance, Ramped(constant(9330.0, 1.0), 8e-3), "row")
    velocity = Ramped(constant(DIASTOLE, 1.0), 8e-3)
    model = artery(12, 1, inlet=velocity, outlet=ramped)
    for n, state in enumerate(follow(model, uniform_state(model, 0.0, 0.0), 1e-4, 120), start=1):
        share = 0.5 - 0.5 * np.cos(np.pi * min(1.0, n * 1e-4 / 8e-3))
        expected = 9330.0 * share + STEADY_OUTLET.resistance * state.flow[-1]
        np.testing.assert_allclose(state.outlet_pressure, expected, rtol=1e-8, atol=1e-6)
    end = simulate(model, [0.0, 3.0], 1e-3, uniform_state(model, 0.0, 0.0))
    settled = steady_state(artery(12, 1, outlet=STEADY_OUTLET), DIASTOLE)
    np.testing.assert_allclose(end.flow[-1], settled.flow, rtol=1e-6)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ((-1.0, 1e9, 1e-10), "proximal resistance = -1.0"),
        ((1e8, 0.0, 1e-10), "distal resistance = 0.0"),
        ((1e8, 1e9, 0.0), "compliance = 0.0"),
        ((1e8, np.inf, 1e-10), "distal resistance = inf"),
        ((1e8, 1e9, np.nan), "compliance = nan"),
        ((1e8, 1e9, 1e-10, np.nan), "venous pressure = nan"),
    ],
)
def test_windkessels_that_are_refused(values, message):
    with pytest.raises(ModelError, match=message):
        WindkesselOutlet(*values)


def test_rest_in_front_of_a_non_reflecting_outlet_is_at_the_reference_pressure():
    patch = PATTERNS["local, sharp"]
    model = artery(12, 8, reference_pressure=8e3, outlet=NonReflectingOutlet(), patch=patch)
    state = steady_state(model, 0.0)
    np.testing.assert_allclose(state.pressure, 8e3, rtol=1e-12)
    np.testing.assert_allclose(state.area, 2.5e-3**2, rtol=1e-12)
