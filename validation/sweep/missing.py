"""Running the samples of a sweep that are not recorded yet."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import pyarrow as pa
from distributed import Client
from rich.progress import BarColumn, MofNCompleteColumn, TimeRemainingColumn

from cases.results.sweep import ChosenTimeStep, SweepAccount
from cases.shell.terminal import progress
from solver.runs.batch import available_threads
from validation.runs.cache import open_cache
from validation.sweep.account import write_account
from validation.sweep.chunk import Plan, Record
from validation.sweep.cluster import connected
from validation.sweep.folder import Counts, part_path, write_part
from validation.sweep.samples import Sample, Samples
from validation.sweep.standards import Standard, Watcher, standards
from validation.sweep.stream import computed
from validation.sweep.study import Study
from validation.sweep.time_steps import chosen_steps, told

ACCOUNT_EVERY = 1.0  # s

Tell = Callable[[str], None]


@dataclass
class Keeper:
    """Records what is computed, and now and then how far the sweep is."""

    folder: Path
    schema: pa.Schema
    account: SweepAccount
    counts: Counts
    written: float

    def keep(self, number: int, records: Sequence[Mapping[str, object]]) -> None:
        """Write one chunk.

        Raises
        ------
        ValidationError
            If it cannot be written.
        """
        self.counts += write_part(part_path(self.folder, number), records, self.schema)
        if time.monotonic() - self.written > ACCOUNT_EVERY:
            write_account(self.folder, self.account, "running", self.counts)
            self.written = time.monotonic()


def judges_of(study: Study, tell: Tell) -> dict[str, Standard]:
    """Return what judges the samples, by variant; references are read."""
    bands = [band for output in study.outputs for band in output.bands]
    watcher = Watcher(lambda _done, _total: None, tell)
    return standards(study.cases, study.against, bands, open_cache(), watcher)


def _steps(
    client: Client, samples: Samples, plan: Plan, keeper: Keeper, tell: Tell
) -> dict[str, ChosenTimeStep]:
    """Time steps of the variants: those that an earlier run of this sweep chose, or chosen now and kept."""
    if keeper.account.time_steps is not None:
        return keeper.account.time_steps

    def run(some: list[Sample], wanted: Plan) -> list[Record]:
        found = dict(computed(client, ((number, [sample]) for number, sample in enumerate(some)), wanted))
        return [record for number in sorted(found) for record in found[number]]

    steps = chosen_steps(samples, plan, run)
    keeper.account = keeper.account.model_copy(update={"time_steps": steps})
    write_account(keeper.folder, keeper.account, "running", keeper.counts)
    for words in told(steps, samples.study.error_tolerance):
        tell(words)
    return steps


def run_missing(
    samples: Samples,
    chunks: Mapping[int, range],
    judges: Mapping[str, Standard],
    scheduler: str,
    workers: int | None,
    keeper: Keeper,
    tell: Tell,
) -> None:
    """Run chunks of samples, by number; each is kept as soon as it is there."""
    study = samples.study
    plan = Plan(tuple(parameter.name for parameter in study.parameters), study.outputs, judges)
    columns = ("{task.description}", BarColumn(), MofNCompleteColumn(), "{task.fields[failed]} failed")
    with progress(*columns, TimeRemainingColumn()) as display:
        task = display.add_task(
            "samples", total=len(samples), completed=keeper.counts.done, failed=keeper.counts.failed
        )
        blocks = ((number, samples.block(chunk)) for number, chunk in chunks.items())
        with connected(scheduler, workers or available_threads(), tell) as client:
            steps = _steps(client, samples, plan, keeper, tell)
            plan = replace(plan, steps={name: step.time_step_s for name, step in steps.items()})
            for number, records in computed(client, blocks, plan):
                keeper.keep(number, records)
                display.update(task, completed=keeper.counts.done, failed=keeper.counts.failed)
