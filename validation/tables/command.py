"""``python -m validation.tables``: recompute the thesis's tables with its own scheme and compare."""

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.progress import Progress

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


def _arguments(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m validation.tables", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(EXPERIMENTS)}; default: all")
    parser.add_argument("--quick", action="store_true", help="a subset that takes less than a minute")
    parser.add_argument(
        "--output", type=Path, default=Path("results/tables"), help="folder for results, default %(default)s"
    )
    chosen = parser.parse_args(arguments)
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


def _compute(
    entries: Sequence[Entry], store: Store, console: Console
) -> tuple[dict[str, Result], dict[str, float], int]:
    """Results and CPU seconds by entry, from the store where it has them; and how many runs failed."""
    results: dict[str, Result] = {}
    cpu: dict[str, float] = {}
    failures = 0
    with Progress(console=console, transient=True, disable=not console.is_terminal) as progress:
        task = progress.add_task("", total=len(entries))
        for entry in entries:
            progress.update(task, description=entry.name)
            kept = store.get(entry.name)
            if kept is None:
                begin = time.process_time()
                try:
                    result = entry.compute()
                except RunFailure as failure:
                    console.print(f"{entry.name}: {failure}")
                    failures += 1
                    continue
                kept = result, time.process_time() - begin
                store.put(entry.name, *kept)
            results[entry.name], cpu[entry.name] = kept
            progress.advance(task)
    return results, cpu, failures


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit status: 1 if a tolerance is missed or a run fails."""
    chosen = _arguments(arguments)
    experiments = [EXPERIMENTS[name] for name in chosen.names or EXPERIMENTS]
    store = Store(chosen.output)
    try:
        results, cpu, failures = _compute(
            _chosen_entries(experiments, chosen.quick), store, Console(stderr=True)
        )
    except KeyboardInterrupt:
        print(f"interrupted; finished results are kept in {chosen.output}", file=sys.stderr)
        return 130
    console = Console(width=None if sys.stdout.isatty() else PAGE_WIDTH)
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
    return 1 if missed or failures else 0
