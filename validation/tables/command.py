"""``python -m validation.tables``: recompute the thesis's tables with its own scheme and compare."""

import argparse
import time
from collections.abc import Sequence
from pathlib import Path

from cases.shell.command import BAND_BROKEN, COMPLETE, concluded
from cases.shell.terminal import page, progress
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
from validation.tables.presentation import print_rows, write_csv, write_json
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

PAGE_WIDTH = 110  # columns of the report where there is no terminal


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Return what the command line states."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(EXPERIMENTS)}; default: all")
    parser.add_argument("--quick", action="store_true", help="a subset that takes less than a minute")
    parser.add_argument(
        "--output", type=Path, default=Path("results/tables"), help="folder for results, default %(default)s"
    )
    chosen = parser.parse_args(argv)
    unknown = [name for name in chosen.names if name not in EXPERIMENTS]
    if unknown:
        parser.error(f"unknown table {', '.join(unknown)}; allowed: {', '.join(EXPERIMENTS)}")
    try:
        chosen.output.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        parser.error(f"{chosen.output}: cannot be made a folder: {error.strerror}")
    return chosen


def _chosen_entries(experiments: Sequence[Experiment], quick: bool) -> list[Entry]:
    """Entries to compute, each once although experiments share some."""
    entries = {
        entry.name: entry
        for experiment in experiments
        for entry in experiment.entries
        if entry.quick or not quick
    }
    return list(entries.values())


def _compute(entries: Sequence[Entry], store: Store) -> tuple[dict[str, Result], dict[str, float], int]:
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


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status: 0, 1 if a tolerance is missed or a run fails, 2 for a wrong input, 130 interrupted."""
    chosen = arguments(argv)
    kept = f"interrupted; finished results are kept in {chosen.output}"
    return concluded(lambda: _run(chosen), kept)


def _run(chosen: argparse.Namespace) -> int:
    experiments = [EXPERIMENTS[name] for name in chosen.names or EXPERIMENTS]
    results, cpu, failures = _compute(_chosen_entries(experiments, chosen.quick), Store(chosen.output))
    console = page(PAGE_WIDTH)
    rows = {}
    for experiment in experiments:
        if chosen.quick and not any(entry.quick for entry in experiment.entries):
            console.print(f"{experiment.name}  {experiment.title}: not in the quick subset")
            continue
        rows[experiment.name] = experiment.rows(results)
        print_rows(console, experiment, rows[experiment.name])
        write_csv(chosen.output / f"{experiment.name.replace('.', '_')}.csv", rows[experiment.name])
        if experiment.draw:
            experiment.draw(results, chosen.output)
    write_json(chosen.output / "tables.json", rows, cpu)
    every = [row for lines in rows.values() for row in lines]
    missed = sum(not row.met for row in every)
    console.print(
        f"{len(every) - missed} of {len(every)} tolerances met; "
        f"{sum(cpu.values()):.1f} s of computation; results in {chosen.output}"
    )
    return BAND_BROKEN if missed or failures else COMPLETE
