"""Grid and model: what they hold, and what they refuse."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from thesis_artery import HEALTHY, RADIUS, artery, pressure

from solver.errors import ModelError
from solver.geometry.grid import Grid
from solver.model.boundary import ResistanceOutlet
from solver.model.parameters import uniform_state


@given(st.floats(1e-3, 1.0), st.integers(3, 60), st.one_of(st.just(1), st.integers(4, 60)))
def test_cells_fill_the_artery(length, n_x, n_phi):
    grid = Grid(length, n_x, n_phi)
    assert grid.x[0] == pytest.approx(grid.dx / 2)
    assert grid.x[-1] == pytest.approx(length - grid.dx / 2)
    assert grid.phi[0] == pytest.approx(grid.dphi / 2)
    assert grid.phi[-1] == pytest.approx(2 * np.pi - grid.dphi / 2)
    assert (grid.x.size, grid.phi.size) == (n_x, n_phi)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0.015, 2, 8), "n_x = 2; allowed: 3 or more"),
        ((0.015, 12, 0), "n_phi = 0; allowed: 1"),
        ((0.015, 12, 3), "n_phi = 3; allowed: 1"),
        ((0.0, 12, 8), "length = 0.0 m; allowed: a positive, finite length"),
        ((-1.0, 12, 8), "length = -1.0 m"),
        ((np.nan, 12, 8), "length = nan m"),
    ],
)
def test_grids_that_are_refused(arguments, message):
    with pytest.raises(ModelError, match=message):
        Grid(*arguments)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"radius": 0.0}, "radius = 0.0; allowed: positive"),
        ({"radius": np.nan}, "radius = nan"),
        ({"density": -1.0}, "density = -1.0; allowed: positive"),
        ({"density": np.nan}, "density = nan"),
        ({"viscosity": -1e-3}, "viscosity = -0.001; allowed: 0 or more"),
        ({"viscosity": np.nan}, "viscosity = nan"),
        ({"stiffness": np.full((8, 12), HEALTHY)}, r"shape \(8, 12\); the grid needs \(12, 8\)"),
        ({"stiffness": np.zeros((12, 8))}, "finite and positive"),
        ({"stiffness": np.full((12, 8), np.nan)}, "finite and positive"),
        ({"stiffness": np.full((12, 8), np.inf)}, "finite and positive"),
    ],
)
def test_models_that_are_refused(changes, message):
    with pytest.raises(ModelError, match=message):
        artery(12, 8, **changes)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((1e9, 0.0, "cell"), "'cell'; allowed: section, row"),
        ((-1.0, 0.0), "resistance = -1.0 Pa s/m³; allowed: 0 or more"),
        ((np.nan, 0.0), "resistance = nan"),
    ],
)
def test_outlets_that_are_refused(arguments, message):
    with pytest.raises(ModelError, match=message):
        ResistanceOutlet(*arguments)


@given(st.floats(-5e3, 2e4), st.floats(-0.2, 0.2), st.floats(300, 7000))
def test_uniform_state_has_one_pressure_and_one_inlet_velocity(load, velocity, calcified):
    stiffness = np.full((6, 4), HEALTHY)
    stiffness[2:4, 1] = calcified
    model = artery(6, 4, stiffness=stiffness)
    state = uniform_state(model, load, velocity)
    np.testing.assert_allclose(pressure(model, state.area), load, rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(state.flow, np.broadcast_to(velocity * state.area[0], (7, 4)))


def test_a_copied_state_is_independent():
    state = uniform_state(artery(6, 4), 1e3, 0.1)
    other = state.copy()
    other.area[:], other.flow[:] = 0, 0
    assert np.all(state.area > RADIUS**2)
    assert np.all(state.flow > 0)
