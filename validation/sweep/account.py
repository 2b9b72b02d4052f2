"""study.json: what a sweep is, how far it is, and what its indices say."""

from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter
from pydantic import ValidationError as PydanticError

from cases.results.sweep import ChosenTimeStep, DrawnDesign, SampleCounts, SobolIndex, State, SweepAccount
from cases.shell.whole import write_text, writing
from cases.values.wording import shown
from validation.errors import ValidationError
from validation.runs.keys import key_of
from validation.runs.output import write_json
from validation.runs.provenance import git_commit, installed, shown_path
from validation.sweep import outputs, parameters
from validation.sweep.folder import ACCOUNT, STUDY, Counts, begun
from validation.sweep.judging import STATES
from validation.sweep.study import Study

OF_ONE_RUN = ("created", "git_commit", "state", "counts", "sensitivity", "page", "time_steps")
LIBRARIES = ("dask", "distributed", "numba", "numpy", "pyarrow", "SALib", "scipy", "xarray")


def digest_of(study: Study, chunks: Sequence[range]) -> str:
    """Digest of what determines a sweep's numbers: cases with their files, design, outputs, chunks, code."""
    parts = {
        "cases": {name: case.model_copy(update={"title": ""}) for name, case in study.cases.items()},
        "parameters": [[p.name, p.kind, dict(p.numbers), p.values] for p in study.parameters],
        "design": study.design,
        "against": study.against,
        "outputs": [output.name for output in study.outputs],
        "error_tolerance": study.error_tolerance,
        "chunks": [[chunk.start, chunk.stop] for chunk in chunks],
    }
    return key_of("sweep", parts)


def account_of(study: Study, digest: str, total: int, chunk: int) -> SweepAccount:
    """Return what is known before the first sample."""
    return SweepAccount(
        name=study.name,
        title=study.title,
        base_case=shown_path(study.base),
        variants={name: case.title for name, case in study.cases.items()},
        created=datetime.now(UTC).isoformat(timespec="seconds"),
        git_commit=git_commit(Path(__file__).parent),
        versions={name: found for name in LIBRARIES if (found := installed(name))},
        digest=digest,
        design=DrawnDesign(
            kind=study.design.kind,
            samples=total,
            count=study.design.count,
            seed=study.design.seed,
            chunk=chunk,
        ),
        against=study.against,
        states_per_cycle=None if study.against == "reference" else STATES,
        parameters=tuple(parameters.described(parameter) for parameter in study.parameters),
        outputs=tuple(outputs.described(output) for output in study.outputs),
        error_tolerance=study.error_tolerance,
        state="running",
        counts=SampleCounts(done=0, failed=0, total=total),
    )


def tells_the_same(earlier: Mapping[str, Any], account: SweepAccount) -> bool:
    """Whether an earlier study.json is of the same sweep in the same words, but for what each run adds."""

    def of_the_sweep(content: Mapping[str, Any]) -> dict[str, Any]:
        return {key: value for key, value in content.items() if key not in OF_ONE_RUN}

    return of_the_sweep(earlier) == of_the_sweep(account.written())


def chosen_before(folder: Path) -> dict[str, ChosenTimeStep] | None:
    """Return the time steps that an earlier run of a sweep chose, by variant; None where it did not yet.

    Raises
    ------
    ValidationError
        If its study.json does not say so as this program does.
    """
    stated = (begun(folder) or {}).get("time_steps")
    try:
        return None if stated is None else TypeAdapter(dict[str, ChosenTimeStep]).validate_python(stated)
    except PydanticError as error:
        raise ValidationError(
            f"{folder / ACCOUNT}: time_steps: {shown(stated)}; no time steps of a sweep; --fresh starts anew"
        ) from error


def write_account(
    folder: Path,
    account: SweepAccount,
    state: State,
    counts: Counts,
    sensitivity: tuple[SobolIndex, ...] | None = None,
) -> None:
    """Write study.json with how far the sweep is.

    Raises
    ------
    ValidationError
        If it cannot be written.
    """
    progress = SampleCounts(done=counts.done, failed=counts.failed, total=account.design.samples)
    found = {"state": state, "counts": progress, "sensitivity": sensitivity}
    with writing(folder / ACCOUNT, ValidationError):
        write_json(folder / ACCOUNT, account.model_copy(update=found).written())


def write_study(folder: Path, study: Study) -> None:
    """Keep the study as it was read.

    Raises
    ------
    ValidationError
        If it cannot be written.
    """
    with writing(folder / STUDY, ValidationError):
        write_text(folder / STUDY, study.text)
