"""What once went wrong, and must not again."""

import numpy as np
import pytest
from thesis_artery import DIASTOLE, RING, SECTOR, artery

from solver.errors import ModelError, NotFinite
from solver.geometry.calcification import Patch, scaled_distance
from solver.geometry.grid import Grid
from solver.marching.row_fields import parameters
from solver.marching.row_stepper import Stepper
from solver.marching.semi_implicit import simulate
from solver.marching.steady import steady_state
from solver.model.boundary import Inlet, ResistanceOutlet
from solver.model.parameters import uniform_state
from solver.model.waveform import Waveform, constant, local_minima


@pytest.mark.parametrize("n_phi", [4, 84, 100, 164])
def test_sharp_patch_symmetric(n_phi):
    inside = scaled_distance(Grid(0.015, 3, n_phi), Patch(RING, SECTOR))[1] == 0
    np.testing.assert_array_equal(inside, inside[::-1])


def test_steady_state_at_rest():
    state = steady_state(artery(12, 4), 0.0)
    assert np.max(np.abs(state.flow)) < 1e-15


def test_nan_state_is_not_finite():
    model = artery(12, 8)
    state = uniform_state(model, 9330.0, DIASTOLE)
    state.area[5, 2] = np.nan
    with pytest.raises((NotFinite, ModelError)):
        Stepper(model, state).advance(np.array([DIASTOLE]), 1e-3, 0.52)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_parameters_finite(bad):
    for make in (
        lambda: ResistanceOutlet(1e9, bad),
        lambda: ResistanceOutlet(bad, 0.0),
        lambda: artery(12, 4, reference_pressure=bad),
        lambda: artery(12, 4, density=bad),
        lambda: artery(12, 4, viscosity=bad),
        lambda: artery(12, 4, length=bad),
    ):
        with pytest.raises(ModelError):
            make()


def test_initial_of_another_grid():
    with pytest.raises(ModelError):
        simulate(artery(12, 8), [0.0, 0.1], 1e-3, uniform_state(artery(12, 4), 9330.0, DIASTOLE))


def test_infinite_time():
    with pytest.raises(ModelError):
        simulate(artery(12, 4), [0.0, np.inf], 1e-3)


def test_integers_are_the_same_kernel():
    whole = parameters(artery(12, 4, outlet=ResistanceOutlet(10**9, 9330), density=1060))
    assert all(isinstance(getattr(whole, n), float) for n in ("density", "resistance"))


@pytest.mark.parametrize(
    ("times", "values"),
    [([0, 0.5, 1.0], [1.0, 2.0, 1.5]), ([0, 0.5, np.inf], [1.0, 2.0, 1.0]), ([0.0, 1.0], [1.0, 2.0, 1.0])],
)
def test_waveform_closed(times, values):
    with pytest.raises(ModelError):
        Waveform(np.array(times), np.array(values))


def test_minima():
    falling = Waveform(np.array([0, 0.2, 0.4, 0.6, 0.8, 1.0]), np.array([1.0, 3.0, 2.0, 2.0, 0.5, 1.0]))
    np.testing.assert_allclose(local_minima(falling), [0.8], atol=1e-3)


def test_collapsed_uniform_state():
    with pytest.raises(ModelError):
        uniform_state(artery(12, 4), -2e5, 0.0)


def test_a_wave_into_blood_at_rest_is_finite_however_small():
    """Ahead of the wave the velocity falls below 1e-160 m/s, whose square is no number any more."""
    model = artery(300, 4, length=0.15)
    stepper = Stepper(model, uniform_state(model, 9330.0, 0.0))
    stepper.advance(np.full(5, 1e-6), 1e-5, 0.5)
    flow = stepper.state().flow
    assert np.all(np.isfinite(flow))
    assert np.max(flow) > 1e-12


def test_a_steady_state_on_many_cells_settles():
    """Round-off of Q moves the area by more per step, the finer the grid."""
    inlet = Inlet("pressure", constant(12e3, 1.0))
    state = steady_state(artery(1280, 1, inlet=inlet, patch=Patch(RING, x_transition=2.5e-3)), 12e3)
    np.testing.assert_allclose(state.flow, state.flow[0, 0], rtol=1e-11)
