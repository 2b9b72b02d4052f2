"""A run of the semi-implicit scheme that nothing watches: no diagnostics."""

from collections.abc import Callable

import numpy as np

from cases.arrays import Floats
from cases.sections.case import Case
from solver.case.model import error_tolerance
from solver.case.start import initial_state
from solver.marching.columns import azimuthal_flux_of
from solver.marching.section_stepper import stepper_of
from solver.marching.semi_implicit import stretches
from solver.marching.two_modes import mean_axis_velocity
from solver.marching.walk import require_exponents
from solver.model.parameters import Model
from solver.model.profiles import AVERAGE_EXPONENT
from solver.runs.result import CellHistory
from solver.schemes.rows.balance import closed_exponents


def is_plain(case: Case) -> bool:
    """Whether a case takes equal steps of the semi-implicit scheme and limits no diagnostic."""
    return (
        case.solver.scheme == "semi_implicit" and case.solver.limits is None and error_tolerance(case) is None
    )


def plain_states(case: Case, model: Model, times: Floats, reached: Callable[[], None]) -> CellHistory:
    """States of a plain case at its output times (n,), s; without diagnostics.

    The steps are those of :func:`solver.marching.semi_implicit.snapshots`, and so are the bits.

    Parameters
    ----------
    case : Case
    model : Model
        Of the case, with all its rows or those that :func:`solver.geometry.symmetry.fewer_rows` leaves.
    times : ndarray (n,)
        Increasing; the first is where the run starts.
    reached : callable
        Called after some of them, several times a second.
    """
    n_x, n_phi = model.grid.n_x, model.grid.n_phi
    area, pressure = (np.empty((times.size, n_x, n_phi)) for _ in range(2))
    flow = np.empty((times.size, n_x + 1, n_phi))
    axis = None if model.two_modes is None else np.empty(area.shape[:2])
    crossing = None if model.section_wall is None else np.empty(area.shape)
    stepper, last = stepper_of(model, initial_state(case, model)), 0
    for stretch in stretches(stepper, times, case.solver.time_step):
        if stretch.failure is not None:
            raise stretch.failure
        states, some = stretch.states, slice(last, last + stretch.steps.size)
        area[some], flow[some], pressure[some] = states.area, states.flow, states.pressure
        if crossing is not None:
            crossing[some] = azimuthal_flux_of(model, states)
        if axis is not None and states.axis_velocity is not None:
            axis[some] = 0.5 * (states.axis_velocity[:, 1:] + states.axis_velocity[:, :-1])
        last = some.stop
        reached()
    through = flow[:, 1:] + flow[:, :-1]
    through *= 0.5
    exponent = _exponents(model, area, through)
    require_exponents(times, exponent)
    if model.two_modes is not None and model.two_modes.closure == "mean":
        axis = mean_axis_velocity(model.two_modes, area, through)
    return CellHistory(
        times=times,
        area=area,
        flow=through,
        pressure=pressure,
        exponent=exponent,
        diagnostics={},
        azimuthal_flux=crossing,
        axis_velocity=axis,
    )


def _exponents(model: Model, area: Floats, flow: Floats) -> Floats:
    """γ of cells (n, n_x, n_phi); NaN where none is admissible."""
    if model.two_modes is not None or model.fixed_exponent is not None:
        return np.full(area.shape, model.fixed_exponent or AVERAGE_EXPONENT)
    exponent = np.empty(area.shape)
    rows = (-1, area.shape[-1])
    closed_exponents(area.reshape(rows), flow.reshape(rows), exponent.reshape(rows))
    return exponent
