"""A finished result that would come out the same once more: told, not computed anew."""

import hashlib
from pathlib import Path

from pydantic import TypeAdapter

from cases.reading.case_file import CaseFile
from cases.results.metric_row import MetricRow
from cases.results.seal import Seal
from solver.kernel_cache import ROOT, sources_digest
from validation.compare.outcome import Outcome
from validation.runs.output import SEAL, write_json
from validation.runs.provenance import LIBRARIES, checksum, installed, shown_path

PACKAGES = ("cases", "febio_io", "reports", "solver", "validation")
_ROWS = TypeAdapter(list[MetricRow])


def determinants(file: CaseFile) -> str:
    """Digest of the case file, of all files that it reads, of the code and of the libraries' versions."""
    cases = [case for variants in file.models.values() for case in variants.values()]
    inputs = sorted({file.path, *(path for case in cases for path in case.input_files)})
    parts = [f"{shown_path(path)} {checksum(path)}" for path in inputs]
    return hashlib.sha256("\n".join([*parts, _code()]).encode()).hexdigest()


def _code() -> str:
    files = [path for package in PACKAGES for path in sorted((ROOT / package).rglob("*")) if path.is_file()]
    sources = [path for path in files if path.parent.name != "__pycache__"]
    return sources_digest(sources, [name for name in LIBRARIES if installed(name)])


def _from_outside(file: CaseFile) -> bool:
    cases = [case for variants in file.models.values() for case in variants.values()]
    parts = [part for case in cases for part in (case.wall, case.reference) if part is not None]
    return any(type(part).__module__.partition(".")[0] not in PACKAGES for part in parts)


def _files(directory: Path) -> dict[str, str]:
    return {path.name: checksum(path) for path in sorted(directory.iterdir()) if path.name != SEAL}


def seal(directory: Path, determined_by: str, created: str, warnings: tuple[str, ...]) -> None:
    """Write checksums.json of a result that is complete but for it."""
    found = Seal(determined_by=determined_by, created=created, warnings=warnings, files=_files(directory))
    write_json(directory / SEAL, found.written())


def unchanged(file: CaseFile, target: Path) -> Outcome | None:
    """Return what ``target`` holds if it would come out the same; None where it must be computed.

    That is: the case, every file that it reads, the code and the libraries are as they were, and each file
    of the result is as it was written. What comes from outside the packages is not followed: a case with
    such a wall law or reference is always computed.
    """
    if _from_outside(file):
        return None
    try:
        kept = Seal.model_validate_json((target / SEAL).read_bytes())
    except (OSError, ValueError):  # none, of another version, or damaged: it is computed anew
        return None
    if kept.files != _files(target) or kept.determined_by != determinants(file):
        return None
    rows = _ROWS.validate_json((target / "metrics.json").read_bytes())
    return Outcome(rows, list(kept.warnings), kept.created)
