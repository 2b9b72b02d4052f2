"""Kernels of the Godunov scheme against their formulas."""

import numpy as np
import pytest
from godunov_cases import flowing, local
from hypothesis import given
from hypothesis import strategies as st

from solver.errors import ModelError
from solver.geometry.calcification import Patch
from solver.geometry.grid import Grid
from solver.schemes.godunov import layout
from solver.schemes.godunov.exchange import SERIES_LIMIT, exchange, growth
from solver.schemes.godunov.waves import decompose, limited
from solver.wall.smooth_patch import column_places, smooth_wall
from validation.tables.artery import CALCIFIED, HEALTHY

pytestmark = pytest.mark.slow  # compiles the explicit scheme


def perturbed(setup, seed=1):
    """A state without symmetry and its fields."""
    random = np.random.default_rng(seed)
    state = flowing(setup)
    shape = state.area.shape
    area = state.area * random.uniform(0.9, 1.1, shape)
    flow = state.flow * random.uniform(0.5, 1.5, shape)
    exponent = random.uniform(1.0, 6.0, shape)
    flat = [layout.flattened(v) for v in (area, flow, exponent, setup.wall.stiffness, setup.wall.slope)]
    root = np.sqrt(flat[0])
    fields = layout.Fields(*flat[:3], root, 1 / root, *flat[3:], np.zeros_like(root), np.zeros(1))
    return area, flow, exponent, fields


def exchange_rate(setup, area, gamma, printed):
    """h of model.md with central differences (2.2.42)."""
    dphi = setup.grid.dphi

    def first(f):
        return (np.roll(f, -1, 1) - np.roll(f, 1, 1)) / (2 * dphi)

    def second(f):
        return (np.roll(f, -1, 1) - 2 * f + np.roll(f, 1, 1)) / dphi**2

    bracket = (
        -(gamma + 2) / 4 * first(area) ** 2 / area**2
        + second(area) / (2 * area)
        - 2 / gamma**3 * first(gamma) ** 2
        + second(gamma) / gamma**2
    )
    if printed:
        bracket += (gamma - 1) / gamma**2 * first(gamma) * first(area) / area
    return 2 * setup.viscosity / setup.density * (gamma + 2) / (gamma * area) * bracket


@pytest.mark.parametrize("printed", [False, True])
@pytest.mark.parametrize("time_step", [1e-7, 1e-2])
def test_exchange_is_exponential_with_the_models_rate(printed, time_step):
    setup = local(n_x=10, n_phi=8, time_step=time_step)
    area, flow, gamma, fields = perturbed(setup)
    parameters = setup.parameters._replace(printed_exchange=printed)
    exchange(fields, parameters, np.zeros_like(fields.area), 1, fields.area.size - 1)
    rate = exchange_rate(setup, area, gamma, printed)
    assert (np.max(np.abs(rate)) * time_step > SERIES_LIMIT) == (time_step == 1e-2)
    expected = flow * np.exp(rate * time_step)
    np.testing.assert_allclose(layout.unflattened(fields.flow, 12, 8), expected, rtol=1e-12)


@given(st.floats(-SERIES_LIMIT, SERIES_LIMIT))
def test_series_of_the_exponential_is_exact_to_round_off(z):
    assert growth(z) == pytest.approx(np.exp(z), rel=4e-16)


def test_waves_add_up_to_the_jump_and_are_eigenvectors():
    """ΔA, ΔQ = ΣW and H(1, λ) = λ(1, λ) with the thesis's averages."""
    setup = local(n_x=10, n_phi=8)
    area, flow, gamma, fields = perturbed(setup)
    work = layout.workspace(12, 8)
    width = layout.stride(8)
    decompose(fields, work, width, 10 * width, width, 1 / (2 * setup.density * setup.radius**2))
    columns = slice(1, 10)
    slow, fast, a1, a2 = (
        layout.unflattened(values, 12, 8)[columns]
        for values in (work.slow_speed, work.fast_speed, work.slow_strength, work.fast_strength)
    )
    jump_A, jump_Q = np.diff(area[1:-1], axis=0), np.diff(flow[1:-1], axis=0)
    np.testing.assert_allclose(a1 + a2, jump_A, rtol=1e-9, atol=1e-16)
    np.testing.assert_allclose(a1 * slow + a2 * fast, jump_Q, rtol=1e-9, atol=1e-16)
    left, right = slice(1, 10), slice(2, 11)
    roots = np.sqrt(area)
    u = (flow[right] / roots[right] + flow[left] / roots[left]) / (roots[right] + roots[left])
    radius = (area[right] + roots[right] * roots[left] + area[left]) / (roots[right] + roots[left]) * 2 / 3
    beta = (setup.wall.stiffness[right] + setup.wall.stiffness[left]) / 2
    alpha = (gamma[right] + gamma[left] + 4) / (gamma[right] + gamma[left] + 2)
    elastic = radius * beta / (2 * setup.density * setup.radius**2) - alpha * u**2
    for speed in (slow, fast):
        np.testing.assert_allclose(elastic + 2 * alpha * u * speed, speed**2, rtol=1e-11)


@given(st.floats(-50, 50), st.sampled_from(["van_leer", "superbee", "minmod", "monotonized_central"]))
def test_limiters_lie_in_swebys_region(theta, name):
    code = {
        "van_leer": layout.VAN_LEER,
        "superbee": layout.SUPERBEE,
        "minmod": layout.MINMOD,
        "monotonized_central": layout.MONOTONIZED_CENTRAL,
    }[name]
    value = limited(code, 1e-12 * theta, 1e-12)
    assert 0 <= value <= max(0.0, min(2.0, 2 * theta)) * (1 + 1e-12) + 1e-300
    symmetric = theta * limited(code, 1e-12 / theta, 1e-12) if theta > 1e-6 else value
    assert value == pytest.approx(symmetric, rel=1e-9, abs=1e-12)
    assert limited(code, 1e-12, 1e-12) == pytest.approx(1.0)
    assert limited(code, 0.0, 0.0) == 0.0


def test_fixed_limiters():
    assert limited(layout.UPWIND, 3.0, 1.0) == 0.0
    assert limited(layout.LAX_WENDROFF, -3.0, 1.0) == 1.0


@pytest.mark.parametrize("phi", [None, (0.75 * np.pi, 1.25 * np.pi), (1.75 * np.pi, 0.25 * np.pi)])
def test_slope_of_the_smooth_wall_is_its_derivative(phi):
    """∂_xβ (2.2.61) against central differences of β (2.2.60)."""
    patch = Patch((5e-3, 10e-3), phi, 2.5e-3, None if phi is None else 1.1)
    step = 1e-7
    grid = Grid(15e-3, 40, 12)

    def beta(shift):
        moved = Patch((5e-3 - shift, 10e-3 - shift), phi, 2.5e-3, patch.phi_transition)
        return smooth_wall(grid, moved, HEALTHY, CALCIFIED).stiffness

    wall = smooth_wall(grid, patch, HEALTHY, CALCIFIED)
    difference = (beta(step) - beta(-step)) / (2 * step)
    scale = (CALCIFIED - HEALTHY) / 2.5e-3
    np.testing.assert_allclose(wall.slope, difference, atol=3e-4 * scale)
    assert wall.stiffness.max() == pytest.approx(CALCIFIED)
    assert wall.stiffness.min() == pytest.approx(HEALTHY)


def test_columns_are_the_ends_and_the_cells():
    places = column_places(Grid(15e-3, 3, 1))
    np.testing.assert_allclose(places, [0.0, 2.5e-3, 7.5e-3, 12.5e-3, 15e-3])


@pytest.mark.parametrize("patch", [Patch((5e-3, 10e-3)), Patch((5e-3, 10e-3), (1.0, 2.0), 1e-3)])
def test_sharp_calcification_is_refused(patch):
    with pytest.raises(ModelError, match="smooth"):
        smooth_wall(Grid(15e-3, 30, 8), patch, HEALTHY, CALCIFIED)


def test_layout_round_trip():
    values = np.arange(15.0).reshape(5, 3)
    flat = layout.flattened(values)
    assert flat.reshape(5, 5)[0].tolist() == [2.0, 0.0, 1.0, 2.0, 0.0]
    np.testing.assert_array_equal(layout.unflattened(flat, 5, 3), values)
