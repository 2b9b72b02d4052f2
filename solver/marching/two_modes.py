"""Profiles of two modes in the kernels' arrays."""

from collections.abc import Callable
from typing import Any

import numpy as np

from cases.arrays import Floats
from solver.errors import ModelError
from solver.marching.kernel import Kernel
from solver.model.parameters import Model, State
from solver.model.profiles import TwoModes
from solver.model.two_mode_balance import kernel_modes
from solver.schemes.two_modes.layout import Fields, Parameters, workspace


def beside(model: Model, kernel: Kernel, advance: Callable[..., Any]) -> Kernel:
    """Kernel of the same scheme with profiles of two modes where the model has them: that of ``advance``."""
    if model.two_modes is None:
        return kernel
    n_x, n_phi = model.grid.n_x, model.grid.n_phi

    def fields(*parts: Floats) -> Any:
        base = kernel.fields(*parts[:-1])
        return Fields(base, base.area, base.flow, parts[-1])

    both = Parameters(kernel.parameters, kernel_modes(model.two_modes))
    scratch = workspace(kernel.workspace, n_x, n_phi)
    return Kernel(advance, both, scratch, fields, (*kernel.shapes, (n_x + 1,)))


def axis_of(model: Model, state: State) -> list[Floats]:
    """D on faces where the kernels know it; a state without D has that of its mean velocities.

    Raises
    ------
    ModelError
        If D is of another grid.
    """
    two_modes, faces = model.two_modes, (model.grid.n_x + 1,)
    if two_modes is None:
        return []
    if state.axis_velocity is None:
        return [mean_axis_velocity(two_modes, face_areas(state.area), state.flow)]
    if state.axis_velocity.shape != faces:
        raise ModelError(f"the state's axis velocity has shape {state.axis_velocity.shape}, not {faces}")
    return [state.axis_velocity]


def own_axis(model: Model, axis: list[Floats]) -> Floats | None:
    """D on faces, if it is known and an unknown of its own."""
    return None if model.two_modes is None or model.two_modes.closure == "mean" else axis[0]


def mean_axis_velocity(two_modes: TwoModes, area: Floats, flow: Floats) -> Floats:
    """D = ū/a, m/s, of A and Q (..., n_phi)."""
    return np.asarray((flow / area).mean(axis=-1) / two_modes.share)


def face_areas(area: Floats) -> Floats:
    """A on faces (n_x + 1, n_phi) from cells; at the ends that of the last cell."""
    between = 0.5 * (area[1:] + area[:-1])
    return np.concatenate([area[:1], between, area[-1:]])
