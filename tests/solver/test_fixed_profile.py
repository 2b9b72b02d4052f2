"""The 1D model: one row, one exponent γ for the friction 2(γ+2)μ and the momentum correction (γ+2)/(γ+1)."""

import numpy as np
import pytest
from closed_forms import uniform_area, uniform_flow
from scipy.integrate import solve_ivp
from thesis_artery import DENSITY, DIASTOLE, HEALTHY, LENGTH, RADIUS, STEADY_OUTLET, VISCOSITY, artery

from solver.errors import ModelError
from solver.marching.steady import steady_state
from solver.wall.stiffness import pressure_from_area

EXPONENTS = pytest.mark.parametrize("exponent", [0.5, 1.0, 2.0, 9.0, 50.0])
LONG = 10 * LENGTH  # so that friction shows


def exact_area(exponent, flow, outlet_area, x, length):
    """A(x) from ∂_x(αQ²/A) + (A/ρ) ∂_xP = −2(γ+2)(μ/ρ) Q/A at constant Q, integrated from the outlet."""
    alpha = (exponent + 2) / (exponent + 1)

    def slope(_, area):
        elastic = np.sqrt(area) * HEALTHY / (2 * DENSITY * RADIUS**2)
        friction = 2 * (exponent + 2) * VISCOSITY / DENSITY * flow / area
        return -friction / (elastic - alpha * flow**2 / area**2)

    solution = solve_ivp(slope, (length, 0.0), [outlet_area], "DOP853", x[::-1], rtol=1e-12, atol=1e-20)
    return solution.y[0, ::-1]


def steady(exponent, n_x, length=LONG):
    model = artery(n_x, 1, length=length, outlet=STEADY_OUTLET, fixed_exponent=exponent)
    state = steady_state(model, 4 * DIASTOLE)
    flow = state.flow[0, 0]
    np.testing.assert_allclose(state.flow, flow, rtol=1e-11)
    outlet = STEADY_OUTLET.offset + STEADY_OUTLET.resistance * flow
    outlet_area = (RADIUS + outlet * RADIUS**2 / HEALTHY) ** 2
    return model, state, exact_area(exponent, flow, outlet_area, model.grid.x, length)


@EXPONENTS
def test_the_steady_pressure_drop(exponent):
    model, state, area = steady(exponent, 400)
    pressure = pressure_from_area(area, model.stiffness[:, 0], RADIUS, 0.0)
    drop, exact = (p[0] - p[-1] for p in (state.pressure[:, 0], pressure))
    assert drop == pytest.approx(exact, rel=1e-5)
    assert drop > 5.0 * (exponent + 2)  # Pa: friction shows
    np.testing.assert_allclose(state.area[:, 0], area, rtol=1e-8)


def test_it_is_of_second_order():
    errors = []
    for n_x in (20, 40, 80):
        _, state, area = steady(9.0, n_x)
        errors.append(np.max(np.abs(state.area[:, 0] / area - 1)))
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert np.all((orders > 1.9) & (orders < 2.1)), orders


def test_the_momentum_correction_shows_without_friction():
    """P + α ρ u²/2 …: with ∂_x(αQ²/A) = −(A/ρ) ∂_xP the drop along a stiffening wall is proportional to α."""
    drops = []
    for exponent in (1.0, 9.0):
        stiffness = (HEALTHY * (1 + np.linspace(0, 9, 200)))[:, None]
        model = artery(200, 1, stiffness=stiffness, viscosity=0.0, fixed_exponent=exponent)
        pressure = steady_state(model, 4 * DIASTOLE).pressure[:, 0]
        drops.append(pressure[0] - pressure[-1])
    assert drops[0] / drops[1] == pytest.approx((3 / 2) / (11 / 10), rel=2e-3)


def test_the_closed_form_of_poiseuille_flow():
    """(2.2.68–69): the thesis's artery, and its exponent 2."""
    model = artery(200, 1, outlet=STEADY_OUTLET, fixed_exponent=2.0)
    state = steady_state(model, DIASTOLE)
    assert uniform_flow(model, DIASTOLE) * 1e6 == pytest.approx(0.59451, abs=5e-6)
    np.testing.assert_allclose(state.flow, uniform_flow(model, DIASTOLE), rtol=1e-9)
    np.testing.assert_allclose(state.area[:, 0], uniform_area(model, DIASTOLE, model.grid.x), rtol=1e-10)


@pytest.mark.parametrize(
    "changes",
    [
        {"outlet": type(STEADY_OUTLET)(1e9, 9e3, "section")},
        {"outlet": STEADY_OUTLET, "stiffness": HEALTHY * np.array([[1.0], [1.0], [1.1]])},
    ],
)
def test_the_closed_form_is_refused_elsewhere(changes):
    with pytest.raises(ModelError, match="closed form needs"):
        uniform_flow(artery(3, 1, **changes), DIASTOLE)


@pytest.mark.parametrize(("n_phi", "exponent"), [(4, 2.0), (1, 0.0), (1, -1.0), (1, np.nan), (1, np.inf)])
def test_exponents_that_are_refused(n_phi, exponent):
    with pytest.raises(ModelError, match="exponent"):
        artery(6, n_phi, fixed_exponent=exponent)
