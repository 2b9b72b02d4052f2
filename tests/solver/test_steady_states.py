"""Steady states: the analytic one without calcification, and Q constant along the artery with any.

With the thesis's velocity of 8.41199 cm/s and per-row resistance outlets, (2.2.68)–(2.2.69) give
Q = 0.59451 cm³/s for P_res = 9330 Pa, R_res = 1.358e9 Pa s/m³ (its only root), and the thesis's
0.5982 cm³/s, with the unphysical 1398 cm³/s, for the pulsatile pair 7205.2 Pa, 5.7817e9 Pa s/m³:
the thesis names the first pair beside the numbers of the second.
"""

import numpy as np
import pytest
from scipy.optimize import brentq
from thesis_artery import (
    DENSITY,
    DIASTOLE,
    HEALTHY,
    LENGTH,
    PATTERNS,
    PULSATILE_OUTLET,
    RADIUS,
    SECTION_OUTLET,
    STEADY_OUTLET,
    VISCOSITY,
    artery,
    pressure,
    section_flow,
    thesis_waveform,
)

from solver.marching.semi_implicit import simulate
from solver.marching.steady import steady_state
from solver.model.boundary import ResistanceOutlet
from solver.model.parameters import uniform_state


def balance(flow, area, inlet_area, x, viscosity):
    """Left minus right side of (2.2.68)."""
    friction = 8 * viscosity / DENSITY * flow * x
    elastic = HEALTHY / (5 * DENSITY * RADIUS**2) * (area**2.5 - inlet_area**2.5)
    return elastic - 4 / 3 * flow**2 * np.log(area / inlet_area) + friction


def analytic_flows(outlet, length=LENGTH, viscosity=VISCOSITY, highest=1e-2):
    """All Q in (1e-8, highest) m³/s that satisfy (2.2.68) with the outlet law (2.2.69)."""

    def residual(flow):
        outlet_radius = RADIUS + (outlet.offset + outlet.resistance * flow) * RADIUS**2 / HEALTHY
        return balance(flow, outlet_radius**2, flow / DIASTOLE, length, viscosity)

    tried = np.geomspace(1e-8, highest, 3000)
    values = np.array([residual(flow) for flow in tried])
    changes = np.flatnonzero(values[:-1] * values[1:] < 0)
    return [brentq(residual, tried[k], tried[k + 1], xtol=1e-22, rtol=1e-14) for k in changes]


def analytic_area(flow, x, viscosity=VISCOSITY):
    inlet_area = flow / DIASTOLE

    def residual(area):
        return balance(flow, area, inlet_area, x, viscosity)

    return brentq(residual, 0.7 * inlet_area, 1.05 * inlet_area, xtol=1e-22, rtol=1e-14)


def test_roots_of_the_analytic_equation():
    (steady,) = analytic_flows(STEADY_OUTLET)
    assert steady * 1e6 == pytest.approx(0.59451, abs=5e-6)
    pulsatile, unphysical = analytic_flows(PULSATILE_OUTLET)
    assert pulsatile * 1e6 == pytest.approx(0.5982, abs=5e-5)
    assert unphysical * 1e6 == pytest.approx(1398, abs=0.5)


@pytest.mark.parametrize("outlet", [STEADY_OUTLET, PULSATILE_OUTLET], ids=["9330 Pa", "7205.2 Pa"])
def test_the_thesis_artery_reaches_the_analytic_state(outlet):
    flow = analytic_flows(outlet)[0]
    model = artery(60, 1, outlet=outlet)
    state = steady_state(model, DIASTOLE)
    np.testing.assert_allclose(state.flow, flow, rtol=1e-11)
    areas = [analytic_area(flow, x) for x in model.grid.x]
    np.testing.assert_allclose(state.area[:, 0], areas, rtol=1e-10)


def test_it_is_approached_at_second_order():
    """Twenty times as long and as viscous, so that the area falls by more than one per cent."""
    length, viscosity = 20 * LENGTH, 20 * VISCOSITY
    flow = analytic_flows(PULSATILE_OUTLET, length, viscosity, highest=2e-6)[0]
    errors = []
    for n_x in (10, 20, 40):
        model = artery(n_x, 1, outlet=PULSATILE_OUTLET, length=length, viscosity=viscosity)
        state = steady_state(model, DIASTOLE)
        areas = np.array([analytic_area(flow, x, viscosity) for x in model.grid.x])
        assert np.ptp(areas) > 0.01 * areas.max()
        errors.append((abs(state.flow[0, 0] / flow - 1), np.max(np.abs(state.area[:, 0] / areas - 1))))
    orders = np.log2(np.array(errors)[:-1] / np.array(errors)[1:])
    assert np.all(orders > 1.9), orders
    assert np.all(orders < 2.2), orders


@pytest.mark.parametrize("by", ["section", "row"])
@pytest.mark.parametrize("pattern", list(PATTERNS))
def test_flow_is_constant_along_every_row(pattern, by):
    outlet = ResistanceOutlet(SECTION_OUTLET.resistance, SECTION_OUTLET.offset, by)
    model = artery(30, 8, outlet=outlet, patch=PATTERNS[pattern])
    state = steady_state(model, DIASTOLE)
    np.testing.assert_allclose(state.flow, np.broadcast_to(state.flow[0], state.flow.shape), rtol=1e-8)
    section = 0.5 * model.grid.dphi * state.flow.sum(axis=1)
    assert np.ptp(section) * 1e6 < 1e-8  # cm³/s

    inlet_area = 1.5 * state.area[0] - 0.5 * state.area[1]
    np.testing.assert_allclose(state.flow[0], DIASTOLE * inlet_area, rtol=1e-9)
    load = pressure(model, state.area)
    at_outlet = 1.5 * load[-1] - 0.5 * load[-2]
    flow = section[-1] if by == "section" else state.flow[-1]
    np.testing.assert_allclose(at_outlet, outlet.offset + outlet.resistance * flow, rtol=1e-5)


def test_a_steady_state_stays():
    model = artery(12, 8, patch=PATTERNS["local, sharp"])
    start = steady_state(model, DIASTOLE)
    run = simulate(model, [0.0, 0.1], 1e-3, start)
    np.testing.assert_allclose(run.flow[-1], start.flow, rtol=1e-9)
    np.testing.assert_allclose(run.area[-1], start.area, rtol=1e-11)


def test_it_does_not_depend_on_the_start():
    model = artery(12, 8, patch=PATTERNS["local, smooth"])
    usual = steady_state(model, DIASTOLE)
    other = steady_state(model, DIASTOLE, uniform_state(model, 11e3, 0.9 * DIASTOLE))
    np.testing.assert_allclose(other.flow, usual.flow, rtol=1e-9)


def test_a_run_starts_from_the_steady_state_of_its_first_velocity():
    model = artery(12, 4, inlet=thesis_waveform())
    run = simulate(model, [0.0], 1e-3)
    np.testing.assert_allclose(
        section_flow(run), np.pi * steady_state(model, DIASTOLE).flow.mean(), rtol=1e-9
    )


def test_reversed_flow_is_a_steady_state_too():
    model = artery(12, 8, patch=PATTERNS["local, sharp"])
    state = steady_state(model, -DIASTOLE)
    assert np.all(state.flow < 0)
    np.testing.assert_allclose(state.flow, np.broadcast_to(state.flow[0], state.flow.shape), rtol=1e-8)
