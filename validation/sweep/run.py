"""One sweep from a study to its folder: what is recorded already stays, what is missing is run."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import pyarrow as pa

from cases.results.sweep import SweepAccount
from cases.shell.interrupts import imports
from validation.errors import ValidationError
from validation.reference.generated import check_computed
from validation.sweep.account import (
    account_of,
    chosen_before,
    digest_of,
    tells_the_same,
    write_account,
    write_study,
)
from validation.sweep.design import samples_of
from validation.sweep.folder import (
    ACCOUNT,
    SAMPLES,
    STUDY,
    Counts,
    begun,
    claimed,
    cleared,
    part_path,
    parts_present,
    schema_of,
)
from validation.sweep.forks import import_ahead
from validation.sweep.samples import samples_of_study
from validation.sweep.sensitivity import sensitivity
from validation.sweep.study import Study

SMALLEST_CHUNK, LARGEST_CHUNK, PARTS = 8, 64, 500  # samples of a part; parts to aim at

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
    workers : int or None
        Processes or threads of a local cluster; None: as many as processors.
    fresh : bool
        Whether what an earlier run left is removed first.
    """

    folder: Path
    scheduler: str
    workers: int | None
    fresh: bool = False


def chunk_size(study: Study, total: int) -> int:
    """Return how many samples go into one task and one file."""
    return study.chunk or min(LARGEST_CHUNK, max(SMALLEST_CHUNK, -(-total // PARTS)))


def run_sweep(study: Study, where: Where, tell: Tell) -> Counts:
    """Run the samples of a study that are not recorded yet; a finished sweep of it is left as it is.

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
    total = samples_of(study.design, study.parameters) * len(study.templates)
    size = chunk_size(study, total)
    chunks = [range(first, min(first + size, total)) for first in range(0, total, size)]
    if study.against == "reference":
        check_computed(study.base, study.cases)
    account = account_of(study, digest_of(study, chunks), total, size)
    schema = schema_of(
        [parameter.name for parameter in study.parameters], [output.name for output in study.outputs]
    )
    if not where.fresh:
        _refuse_another(where.folder, account.digest)
        finished = _finished(study, where.folder, account, chunks, schema)
        if finished is not None:
            return finished
    return _run(study, where, account, chunks, schema, tell)


def _finished(
    study: Study, folder: Path, account: SweepAccount, chunks: Sequence[range], schema: pa.Schema
) -> Counts | None:
    """Count the samples of a sweep that is finished, whole, and told in the same words; None for another."""
    earlier = begun(folder)
    if earlier is None or earlier.get("state") != "finished" or not tells_the_same(earlier, account):
        return None
    kept = folder / STUDY
    if not kept.is_file() or kept.read_bytes() != study.text.encode():
        return None
    with claimed(folder):
        present = parts_present(folder, chunks, schema)
    return sum(present.values(), Counts()) if len(present) == len(chunks) else None


def _run(
    study: Study, where: Where, account: SweepAccount, chunks: Sequence[range], schema: pa.Schema, tell: Tell
) -> Counts:
    there = all(part_path(where.folder, number).exists() for number in range(len(chunks)))
    if where.scheduler == "processes" and not there:
        import_ahead()
    samples = samples_of_study(study)
    with imports():
        from validation.sweep.missing import Keeper, judges_of, run_missing

    with claimed(where.folder):
        judges = None
        if where.fresh:
            judges = judges_of(study, tell)  # a reference that cannot be read leaves the earlier sweep
            cleared(where.folder)
        _refuse_another(where.folder, account.digest)  # it may be another by now
        account = account.model_copy(update={"time_steps": chosen_before(where.folder)})
        present = parts_present(where.folder, chunks, schema)
        write_study(where.folder, study)
        counts = sum(present.values(), Counts())
        write_account(where.folder, account, "running", counts)
        missing = {number: chunk for number, chunk in enumerate(chunks) if number not in present}
        keep = Keeper(where.folder, schema, account, counts, time.monotonic())
        try:
            if missing:
                judges = judges or judges_of(study, tell)
                run_missing(samples, missing, judges, where.scheduler, where.workers, keep, tell)
        except BaseException:
            write_account(where.folder, keep.account, "interrupted", keep.counts)
            raise
        write_account(where.folder, keep.account, "finished", keep.counts, sensitivity(study, where.folder))
    return keep.counts


def _refuse_another(folder: Path, digest: str) -> None:
    earlier = begun(folder)
    if earlier is None and any((folder / SAMPLES).glob("part-*.parquet")):
        raise ValidationError(
            f"{folder}: holds samples, but no {ACCOUNT} that says of which study; "
            "--fresh removes them and starts anew, --output DIR chooses another folder"
        )
    if earlier is not None and earlier.get("digest") != digest:
        raise ValidationError(
            f"{folder}: holds a sweep of another study, or of another version of this program; "
            "--fresh removes it and starts anew, --output DIR chooses another folder"
        )
