"""A finished result that would come out the same once more: told, not computed anew."""

import hashlib
import platform
import sys
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
SOURCES = (".css", ".html", ".js", ".py", ".typ")
OTHER_LIBRARIES = ("h5py", "jinja2", "llvmlite", "meshio", "pint", "pydantic", "ruamel.yaml")
# formats whose files name others, of which not every way is followed
NAMING_OTHERS = (".case", ".encas", ".foam", ".pvd", ".pvtp", ".pvtu", ".series", ".vtm", ".xdmf", ".xmf")
_ROWS = TypeAdapter(list[MetricRow])


def determinants(file: CaseFile) -> str:
    """Digest of the case file, of all files that it reads, of the code and of the libraries' versions."""
    inputs = sorted({file.path, *file.input_files})
    sums = [checksum(path) if path.is_file() else "yet to be made" for path in inputs]
    parts = [f"{shown_path(path)} {each}" for path, each in zip(inputs, sums, strict=True)]
    return hashlib.sha256("\n".join([*parts, _code()]).encode()).hexdigest()


def _code() -> str:
    files = [path for package in PACKAGES for path in sorted((ROOT / package).rglob("*"))]
    sources = [path for path in files if path.suffix in SOURCES]
    libraries = [name for name in (*LIBRARIES, *OTHER_LIBRARIES) if installed(name)]
    return f"{sys.version} {platform.machine()} {sources_digest(sources, libraries)}"


def _cannot_be_followed(file: CaseFile) -> bool:
    """Whether something determines the result that the digest may miss: code, or files that files name."""
    cases = [case for variants in file.models.values() for case in variants.values()]
    parts = [part for case in cases for part in (case.wall, case.reference) if part is not None]
    from_outside = any(type(part).__module__.partition(".")[0] not in PACKAGES for part in parts)
    return from_outside or any(path.suffix.lower() in NAMING_OTHERS for path in file.input_files)


def _files(directory: Path) -> dict[str, str]:
    return {path.name: checksum(path) for path in sorted(directory.iterdir()) if path.name != SEAL}


def seal(
    directory: Path, file: CaseFile, determined_by: str, created: str, warnings: tuple[str, ...]
) -> None:
    """Write checksums.json of a result that is complete but for it; not where its case changed meanwhile."""
    if determinants(file) != determined_by:
        return
    found = Seal(determined_by=determined_by, created=created, warnings=warnings, files=_files(directory))
    write_json(directory / SEAL, found.written())


def unchanged(file: CaseFile, determined_by: str, target: Path) -> Outcome | None:
    """Return what ``target`` holds if it would come out the same; None where it must be computed.

    That is: the case, every file that it reads, the code and the libraries are as they were, and each file
    of the result is as it was written. A case with a wall law or a reference from outside the packages, or
    with files that name others, is always computed.
    """
    if _cannot_be_followed(file) or not all(each.is_file() for each in target.glob("*")):
        return None
    try:
        kept = Seal.model_validate_json((target / SEAL).read_bytes())
        if kept.determined_by != determined_by or kept.files != _files(target):
            return None
        rows = _ROWS.validate_json((target / "metrics.json").read_bytes())
    except (OSError, ValueError):  # none, of another version, or damaged: it is computed anew
        return None
    return Outcome(rows, list(kept.warnings), kept.created)
