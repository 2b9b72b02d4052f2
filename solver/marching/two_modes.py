"""Profiles of two modes in the kernels' arrays."""

from typing import Any

import numpy as np

from cases.arrays import Floats
from solver.errors import ModelError
from solver.model.parameters import Model, State
from solver.model.profiles import TwoModes
from solver.model.two_mode_balance import kernel_modes
from solver.schemes.layout import aligned
from solver.schemes.two_modes.layout import Fields, Parameters


def parameters(base: Any, two_modes: TwoModes) -> Parameters:
    """Parameters of the kernels beside those of the scheme."""
    return Parameters(base, kernel_modes(two_modes))


def fields_of(base: Any, model: Model, state: State) -> Fields:
    """Arrays of the kernels from a state; one without D has that of its mean velocities.

    Raises
    ------
    ModelError
        If D is of another grid.
    """
    two_modes = model.two_modes
    if two_modes is None:
        raise ModelError("the model has profiles of one exponent")
    axis = aligned((model.grid.n_x + 1,))
    if state.axis_velocity is None:
        axis[:] = mean_axis_velocity(two_modes, face_areas(state.area), state.flow)
    elif state.axis_velocity.shape == axis.shape:
        axis[:] = state.axis_velocity
    else:
        raise ModelError(f"the state's axis velocity has shape {state.axis_velocity.shape}, not {axis.shape}")
    return Fields(base, base.area, base.flow, axis)


def mean_axis_velocity(two_modes: TwoModes, area: Floats, flow: Floats) -> Floats:
    """D = ū/a, m/s, of A and Q (..., n_phi)."""
    return np.asarray((flow / area).mean(axis=-1) / two_modes.share)


def face_areas(area: Floats) -> Floats:
    """A on faces (n_x + 1, n_phi) from cells; at the ends that of the last cell."""
    between = 0.5 * (area[1:] + area[:-1])
    return np.concatenate([area[:1], between, area[-1:]])
