"""All experiments by name, and their results, from a store where it has them."""

import time
from collections.abc import Sequence

from cases.shell.terminal import progress
from solver.errors import RunFailure
from validation.tables import (
    pulsatile_tables,
    pulse,
    scheme_agreement,
    stability,
    steady_flow,
    steady_tables,
)
from validation.tables.experiment import Entry, Experiment, Result
from validation.tables.store import Store

EXPERIMENTS: dict[str, Experiment] = {
    experiment.name: experiment
    for experiment in (
        steady_flow.EXPERIMENT,
        pulse.EXPERIMENT,
        stability.EXPERIMENT,
        *steady_tables.EXPERIMENTS,
        *pulsatile_tables.EXPERIMENTS,
        scheme_agreement.EXPERIMENT,
    )
}


def chosen_entries(experiments: Sequence[Experiment], quick: bool) -> list[Entry]:
    """Entries to compute, each once although experiments share some."""
    entries = {
        entry.name: entry
        for experiment in experiments
        for entry in experiment.entries
        if entry.quick or not quick
    }
    return list(entries.values())


def computed(entries: Sequence[Entry], store: Store) -> tuple[dict[str, Result], dict[str, float], int]:
    """Results and CPU seconds by entry, from the store where it has them; and how many runs failed."""
    results: dict[str, Result] = {}
    cpu: dict[str, float] = {}
    failures = 0
    with progress() as display:
        task = display.add_task("", total=len(entries))
        for entry in entries:
            display.update(task, description=entry.name)
            kept = store.get(entry.name)
            if kept is None:
                begin = time.process_time()
                try:
                    result = entry.compute()
                except RunFailure as failure:
                    display.console.print(f"{entry.name}: {failure}")
                    failures += 1
                    continue
                kept = result, time.process_time() - begin
                store.put(entry.name, *kept)
            results[entry.name], cpu[entry.name] = kept
            display.advance(task)
    return results, cpu, failures
