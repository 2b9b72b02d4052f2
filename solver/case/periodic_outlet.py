"""The periodic state behind a Windkessel, without the many cycles that its capacitor takes to charge."""

from itertools import count

import numpy as np

from cases.arrays import Floats
from cases.sections.case import Case
from cases.sections.outlet import WindkesselOutlet
from solver.case.model import inlet_signal, model_of
from solver.case.periodicity import PERIODIC, cycle_change
from solver.case.run import walk
from solver.errors import SolverError
from solver.marching.semi_implicit import Progress
from solver.marching.walk import Kept, Stop

INSTANTS = 200  # of a cycle
MOST_CYCLES = 40


def periodic_outlet_flow(case: Case, progress: Progress | None = None) -> Floats:
    """One cycle of the flow through a Windkessel, from a run until it is periodic.

    It starts as the steady state of the inlet's mean, whose capacitor holds P_v + R₂ q̄, the mean of the
    periodic pressure but for what the pulse changes in q̄. After each cycle, which takes the capacitor from
    P₀ to P₁, the next begins with P₀ + (P₁ − P₀)/(1 − e^(−T/R₂C)): where it would end if the flow stayed as
    it is. What is left is what the flow owes to the pressure, so that a few cycles suffice whatever R₂C is.

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
        If it is not periodic to 1e-4 after 40 cycles, or as the scheme raises it.
    """
    outlet = case.outlet
    if not isinstance(outlet, WindkesselOutlet):
        raise SolverError(f"outlet.kind: {outlet.kind}; allowed for a periodic capacitor: windkessel")
    calm = _without(case)
    model, period = model_of(calm), case.inlet.period
    leaked = -np.expm1(-period / (outlet.distal_resistance * outlet.compliance))
    times = period * np.linspace(0.0, 1.0, INSTANTS + 1)
    kept = _steady_mean(calm)
    for cycle in count(1):
        stops = list(walk(calm, model, (cycle - 1) * period + times, kept))
        held = [float(stop.kept["reservoir"]) for stop in (stops[0], stops[-1])]
        flow = 0.5 * model.grid.dphi * np.array([stop.columns.flow[-1].sum() for stop in stops])
        gap = (held[1] - held[0]) / leaked
        change = max(_change(calm, times, stops), abs(gap) / (_highest(stops) or 1.0))
        if progress:
            progress(cycle, MOST_CYCLES)
        if change <= PERIODIC:
            return np.asarray(flow[:-1])
        if cycle == MOST_CYCLES:
            break
        kept = stops[-1].kept | {"reservoir": np.asarray(held[0] + gap)}
    raise SolverError(f"the reduced model changes by {change:.1e} (relative) over cycle {MOST_CYCLES}")


def _without(case: Case) -> Case:
    """Give the case without what belongs to one run: ramp, limits, number of cycles."""
    settings = case.solver.model_copy(update={"limits": None, "cycles": 1, "start": "steady"})
    return case.model_copy(update={"inlet": case.inlet.model_copy(update={"ramp": None}), "solver": settings})


def _steady_mean(case: Case) -> Kept:
    """State that the mean of the inlet's cycle leads to, as the scheme keeps it."""
    instants = case.inlet.period * np.arange(INSTANTS) / INSTANTS
    mean = float(np.mean(inlet_signal(case)(instants)))
    constant = {"waveform": None, "fourier": None, "value": mean, "scale": 1.0}
    steady = case.model_copy(update={"inlet": case.inlet.model_copy(update=constant)})
    return next(iter(walk(steady, model_of(steady), np.zeros(1)))).kept


def _change(case: Case, times: Floats, stops: list[Stop]) -> float:
    ends = (stops[0], stops[-1])
    found = cycle_change(
        case,
        {
            "time": times[[0, -1]],
            "pressure": np.array([stop.columns.pressure for stop in ends]),
            "section_flow_rate": np.array([stop.columns.flow.sum(axis=-1) for stop in ends]),
        },
    )
    return np.inf if found is None else found


def _highest(stops: list[Stop]) -> float:
    return max(float(np.max(np.abs(stop.columns.pressure))) for stop in stops)
