"""The periodic flow through a Windkessel."""

import numpy as np

from cases.arrays import Floats
from cases.sections.case import Case
from cases.sections.outlet import WindkesselOutlet
from solver.case.model import error_tolerance, model_of
from solver.case.start import INSTANTS, periodic_state
from solver.errors import SolverError
from solver.marching.semi_implicit import Progress, snapshots


def periodic_outlet_flow(case: Case, progress: Progress | None = None) -> Floats:
    """One cycle of the flow through a Windkessel in a run that is periodic (:func:`periodic_state`).

    Parameters
    ----------
    case : Case
        Its outlet is a Windkessel; the inlet's ramp, limits and the number of cycles do not count.
    progress : callable, optional
        Called with (cycles done, most cycles).

    Returns
    -------
    ndarray (n,)
        Flow rate of the outlet's section at equal intervals from the cycle's start, without its end, m³/s.

    Raises
    ------
    SolverError
        If no periodic state is found, or as the scheme raises it.
    """
    outlet = case.outlet
    if not isinstance(outlet, WindkesselOutlet):
        raise SolverError(f"outlet.kind: {outlet.kind}; allowed for a periodic capacitor: windkessel")
    calm = case.model_copy(update={"inlet": case.inlet.model_copy(update={"ramp": None})})
    model = model_of(calm)
    start = periodic_state(calm, model, progress)
    times = case.inlet.period * np.linspace(0.0, 1.0, INSTANTS + 1)
    states = snapshots(model, times, case.solver.time_step, start, error_tolerance(case))
    flow = [0.5 * model.grid.dphi * each.columns.flow[-1].sum() for each in states]
    return np.asarray(flow[:-1])
