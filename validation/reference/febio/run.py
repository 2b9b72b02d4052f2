"""What a FEBio run's log and data records tell of it, beside its plot file."""

from dataclasses import dataclass
from typing import Any

from cases.sections.case import FebioReference
from febio_io.xplt import Plot
from validation.reference.febio.log import account_of_log
from validation.reference.febio.records import account_of_record


@dataclass(frozen=True)
class RunAccount:
    """What the files beside the plot file tell of its run."""

    facts: dict[str, Any]
    notes: tuple[str, ...]
    warnings: tuple[str, ...]


def account_of_run(plot: Plot, stated: FebioReference) -> RunAccount:
    """Read the log and the data records, as far as the case states them."""
    log = None if stated.log is None else account_of_log(stated.log, plot)
    records = [account_of_record(record, plot) for record in stated.data_records]
    facts: dict[str, Any] = {} if log is None else {"cost": log.cost}
    if records:
        facts["data_records"] = [record.facts for record in records]
    return RunAccount(
        facts,
        notes=tuple(note for record in records for note in record.notes),
        warnings=(
            *(() if log is None else log.warnings),
            *(warning for record in records for warning in record.warnings),
        ),
    )
