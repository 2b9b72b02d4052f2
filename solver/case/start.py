"""Where a case's run starts: at rest, in a steady state, or in the state that its cycles repeat."""

from dataclasses import replace
from itertools import count

import numpy as np

from cases.arrays import Floats
from cases.sections.case import Case
from cases.sections.outlet import WindkesselOutlet
from solver.case.model import error_tolerance
from solver.case.periodicity import PERIODIC, relative_change
from solver.errors import SolverError
from solver.marching.semi_implicit import Progress, Snapshot, snapshots
from solver.marching.steady import steady_state
from solver.marching.walk import kept_of, state_of
from solver.model.parameters import Model, State, uniform_state

INSTANTS = 200  # of a cycle, for its mean
MOST_CYCLES = 40
PAST = 4  # cycles that tell where the next one starts


def initial_state(case: Case, model: Model) -> State:
    """State from which a case starts, as its ``solver.start`` says.

    Raises
    ------
    SolverError
        If the steady or the periodic state cannot be reached.
    """
    if case.solver.start == "rest":
        return uniform_state(model, model.reference_pressure, 0.0)
    if case.solver.start == "periodic":
        return periodic_state(case, model)
    return steady_state(model, float(model.inlet.signal(0.0)))


def periodic_state(case: Case, model: Model, progress: Progress | None = None) -> State:
    """State at a cycle's start of the run that repeats itself.

    The first cycle starts in the steady state of the inlet's mean. A Windkessel whose capacitor a cycle takes
    from P₀ to P₁ then has P₀ + (P₁ − P₀)/(1 − e^(−T/R₂C)), where it would end if its flow stayed as it is.
    Of the last cycles the next start is the combination whose changes cancel best (Anderson mixing: Walker
    and Ni 2011, doi:10.1137/10078356X), so that a few cycles suffice for R₂C up to 120 s at least; with
    1200 s the march to the first steady state does not end.

    Parameters
    ----------
    case : Case
        Run with the semi-implicit scheme, whichever it names; its inlet has no ramp.
    model : Model
        Of the case.
    progress : callable, optional
        Called with (cycles done, most cycles).

    Raises
    ------
    SolverError
        If it is not periodic to 1e-4 after 40 cycles, or as the scheme and the march raise it.
    """
    period = case.inlet.period
    instants = period * np.arange(INSTANTS) / INSTANTS
    state = steady_state(model, float(np.mean(model.inlet.signal(instants))))
    begun: list[State] = []
    ended: list[State] = []
    for cycle in count(1):
        first, last = snapshots(model, [0.0, period], case.solver.time_step, state, error_tolerance(case))
        charged = _charged(case, first.state, last.state)
        change = max(_changes(first, last), _still_to_charge(first, last, charged))
        if progress:
            progress(cycle, MOST_CYCLES)
        if change <= PERIODIC:
            return replace(charged, time=0.0)
        if cycle == MOST_CYCLES:
            break
        begun, ended = [*begun, first.state][-PAST:], [*ended, charged][-PAST:]
        state = _mixed(begun, ended)
    raise SolverError(f"the reduced model changes by {change:.1e} (relative) over cycle {MOST_CYCLES}")


def _charged(case: Case, first: State, last: State) -> State:
    """Last state of a cycle, with the capacitor charged for good."""
    outlet = case.outlet
    if not isinstance(outlet, WindkesselOutlet) or first.reservoir is None or last.reservoir is None:
        return last
    leaked = -np.expm1(-case.inlet.period / (outlet.distal_resistance * outlet.compliance))
    return replace(last, reservoir=float(first.reservoir + (last.reservoir - first.reservoir) / leaked))


def _changes(first: Snapshot, last: Snapshot) -> float:
    one, other = first.columns, last.columns
    flows = relative_change(one.flow.sum(axis=-1), other.flow.sum(axis=-1))
    return max(relative_change(one.pressure, other.pressure), flows)


def _still_to_charge(first: Snapshot, last: Snapshot, charged: State) -> float:
    """Change of the capacitor's pressure for good, over the largest pressure; 0 without a capacitor."""
    if first.state.reservoir is None or charged.reservoir is None:
        return 0.0
    highest = max(float(np.max(np.abs(each.columns.pressure))) for each in (first, last))
    return abs(charged.reservoir - first.state.reservoir) / (highest or 1.0)


def _mixed(begun: list[State], ended: list[State]) -> State:
    """Start of the next cycle from where cycles began and ended; every part counts by its largest value."""
    parts = {name: part for name, part in kept_of(ended[-1]).items() if name != "time"}
    scales = {name: float(np.max(np.abs(part))) or 1.0 for name, part in parts.items()}

    def flat(states: list[State]) -> Floats:
        kept = [kept_of(state) for state in states]
        rows = [[np.ravel(each[name]) / scale for name, scale in scales.items()] for each in kept]
        return np.array([np.concatenate(row) for row in rows])

    if len(begun) == 1:
        return ended[-1]
    ends = flat(ended)
    changes = ends - flat(begun)
    weights = np.linalg.lstsq(np.diff(changes, axis=0).T, changes[-1], rcond=1e-8)[0]
    found = np.split(ends[-1] - weights @ np.diff(ends, axis=0), np.cumsum([p.size for p in parts.values()]))
    mixed = {
        name: scales[name] * values.reshape(part.shape)
        for (name, part), values in zip(parts.items(), found, strict=False)
    }
    return state_of(State, mixed | {"time": np.zeros(())})
