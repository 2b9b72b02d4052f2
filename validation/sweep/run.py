"""One sweep from a study to its folder: what is recorded already stays, what is missing is run."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import pyarrow as pa
from rich.progress import BarColumn, MofNCompleteColumn, TimeRemainingColumn

from cases.results.sweep import SweepAccount
from cases.shell.terminal import progress
from validation.errors import ValidationError
from validation.reference.generated import check_computed
from validation.runs.cache import open_cache
from validation.sweep.account import account_of, digest_of, write_account, write_study
from validation.sweep.chunk import Plan
from validation.sweep.cluster import connected
from validation.sweep.folder import (
    Counts,
    begun,
    claimed,
    cleared,
    part_path,
    parts_present,
    schema_of,
    write_part,
)
from validation.sweep.judging import Standard, Watcher, standards
from validation.sweep.samples import Samples, samples_of_study
from validation.sweep.sensitivity import sensitivity
from validation.sweep.stream import computed
from validation.sweep.study import Study

SMALLEST_CHUNK, LARGEST_CHUNK, PARTS = 8, 64, 500  # samples of a part; parts to aim at
ACCOUNT_EVERY = 1.0  # s

Tell = Callable[[str], None]


@dataclass(frozen=True)
class Where:
    """Where a sweep is run and kept.

    Attributes
    ----------
    folder : pathlib.Path
        Its result.
    scheduler : str
        ``processes``, ``threads`` or the address of a scheduler.
    workers : int
        Processes or threads of a local cluster.
    fresh : bool
        Whether what an earlier run left is removed first.
    """

    folder: Path
    scheduler: str
    workers: int
    fresh: bool = False


def chunk_size(study: Study, total: int) -> int:
    """Return how many samples go into one task and one file."""
    return study.chunk or min(LARGEST_CHUNK, max(SMALLEST_CHUNK, -(-total // PARTS)))


def run_sweep(study: Study, where: Where, tell: Tell) -> Counts:
    """Run the samples of a study that are not recorded yet.

    Returns
    -------
    Counts
        All samples recorded, and failed ones among them.

    Raises
    ------
    CaseError, ValidationError, FebioError
        For a study that gives no case, a folder of something else, a scheduler or reference that fails; what
        was recorded stays.
    KeyboardInterrupt
        When the user interrupts; what was recorded stays, and study.json says so.
    """
    samples = samples_of_study(study)
    size = chunk_size(study, len(samples))
    chunks = [range(first, min(first + size, len(samples))) for first in range(0, len(samples), size)]
    if study.against == "reference":
        check_computed(study.base, study.cases)
    digest = digest_of(study, chunks)
    schema = schema_of(
        [parameter.name for parameter in study.parameters], [output.name for output in study.outputs]
    )
    with claimed(where.folder):
        judges = None
        if where.fresh:
            judges = _standards(study, tell)  # a reference that cannot be read leaves the earlier sweep
            cleared(where.folder)
        _refuse_another(where.folder, digest)
        present = parts_present(where.folder, chunks, schema)
        account = account_of(study, digest, len(samples), size)
        write_study(where.folder, study)
        counts = sum(present.values(), Counts())
        write_account(where.folder, account, "running", counts)
        missing = [number for number in range(len(chunks)) if number not in present]
        keep = _Keeper(where.folder, schema, account, counts, time.monotonic())
        try:
            if missing:
                plan = _plan(study, judges or _standards(study, tell))
                _run_missing(samples, chunks, missing, where, keep, plan, tell)
        except BaseException:
            write_account(where.folder, account, "interrupted", keep.counts)
            raise
        write_account(where.folder, account, "finished", keep.counts, sensitivity(study, where.folder))
    return keep.counts


def _refuse_another(folder: Path, digest: str) -> None:
    earlier = begun(folder)
    if earlier is not None and earlier.get("digest") != digest:
        raise ValidationError(
            f"{folder}: holds a sweep of another study, or of another version of this program; "
            "--fresh removes it and starts anew, --output DIR chooses another folder"
        )


@dataclass
class _Keeper:
    """Records what is computed, and now and then how far the sweep is."""

    folder: Path
    schema: pa.Schema
    account: SweepAccount
    counts: Counts
    written: float

    def keep(self, number: int, records: Sequence[dict[str, object]]) -> None:
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


def _standards(study: Study, tell: Tell) -> dict[str, Standard]:
    bands = [band for output in study.outputs for band in output.bands]
    watcher = Watcher(lambda _done, _total: None, tell)
    return standards(study.cases, study.against, bands, open_cache(), watcher)


def _plan(study: Study, judges: Mapping[str, Standard]) -> Plan:
    return Plan(tuple(parameter.name for parameter in study.parameters), study.outputs, judges)


def _run_missing(
    samples: Samples,
    chunks: Sequence[range],
    missing: Sequence[int],
    where: Where,
    keeper: _Keeper,
    plan: Plan,
    tell: Tell,
) -> None:
    columns = ("{task.description}", BarColumn(), MofNCompleteColumn(), "{task.fields[failed]} failed")
    with progress(*columns, TimeRemainingColumn()) as display:
        task = display.add_task(
            "samples", total=len(samples), completed=keeper.counts.done, failed=keeper.counts.failed
        )
        blocks = ((number, samples.block(chunks[number])) for number in missing)
        with connected(where.scheduler, where.workers, tell) as client:
            for number, records in computed(client, blocks, plan):
                keeper.keep(number, records)
                display.update(task, completed=keeper.counts.done, failed=keeper.counts.failed)
