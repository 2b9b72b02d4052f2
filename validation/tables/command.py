"""``python -m validation.tables``: recompute the thesis's tables with its own scheme and compare."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from cases.shell.command import BAND_BROKEN, COMPLETE, concluded
from cases.shell.interrupts import imports

NAMES = ("steady", "pulse", "stability", "3.1", "3.2", "3.3", "3.4", "orders", "3.6", "3.7", "3.9", "schemes")
PAGE_WIDTH = 110  # columns of the report where there is no terminal


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Return what the command line states."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(NAMES)}; default: all")
    parser.add_argument("--quick", action="store_true", help="a subset that takes less than a minute")
    parser.add_argument(
        "--output", type=Path, default=Path("results/tables"), help="folder for results, default %(default)s"
    )
    chosen = parser.parse_args(argv)
    unknown = [name for name in chosen.names if name not in NAMES]
    if unknown:
        parser.error(f"unknown table {', '.join(unknown)}; allowed: {', '.join(NAMES)}")
    try:
        chosen.output.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        parser.error(f"{chosen.output}: cannot be made a folder: {error.strerror}")
    return chosen


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status: 0, 1 if a tolerance is missed or a run fails, 2 for a wrong input, 130 interrupted."""
    chosen = arguments(argv)
    kept = f"interrupted; finished results are kept in {chosen.output}"
    return concluded(lambda: _run(chosen), kept)


def _run(chosen: argparse.Namespace) -> int:
    with imports():
        from cases.shell.terminal import page
        from validation.tables.experiments import EXPERIMENTS, chosen_entries, computed
        from validation.tables.presentation import print_rows, write_csv, write_json
        from validation.tables.store import Store

    experiments = [EXPERIMENTS[name] for name in chosen.names or EXPERIMENTS]
    results, cpu, failures = computed(chosen_entries(experiments, chosen.quick), Store(chosen.output))
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
