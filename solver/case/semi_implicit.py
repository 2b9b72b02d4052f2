"""A checked case run with the semi-implicit scheme."""

from collections.abc import Iterator

import numpy as np

from cases.arrays import Floats
from cases.sections.case import Case
from solver.case.model import error_tolerance, monitor_of
from solver.case.start import initial_state
from solver.marching.semi_implicit import snapshots
from solver.marching.walk import Kept, Stop, kept_of, state_of
from solver.model.parameters import Model, State


def walk_semi_implicit(case: Case, model: Model, times: Floats, kept: Kept | None = None) -> Iterator[Stop]:
    """Run a case through ``times`` (s); the first is where it starts, or where ``kept`` was left."""
    start = initial_state(case, model) if kept is None else state_of(State, kept)
    first_step = None if kept is None else float(kept["next_step"])
    monitor = monitor_of(case, model, None if kept is None else kept["history"])
    limit = error_tolerance(case)
    for snapshot in snapshots(model, times, case.solver.time_step, start, limit, first_step, monitor):
        yield Stop(
            snapshot.state.time,
            snapshot.columns,
            snapshot.diagnostics,
            snapshot.steps,
            snapshot.sweeps,
            snapshot.longest_step,
            kept_of(snapshot.state)
            | {"next_step": np.asarray(snapshot.next_step), "history": monitor.history},
            snapshot.azimuthal_flux,
        )
