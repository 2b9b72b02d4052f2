"""The page of a sweep, drawn where it is not there, or is not what this program draws of these samples."""

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from cases.results.sweep import DrawnPage
from cases.shell.interrupts import imports
from cases.shell.whole import writing
from solver.kernel_cache import ROOT, sources_digest
from validation.errors import ValidationError
from validation.runs.output import write_json
from validation.runs.provenance import checksum
from validation.sweep.folder import ACCOUNT, PAGE_FILES, SAMPLES, STUDY, begun

DRAWN_BY = ("cases", "reports")  # packages with all their files
LIBRARIES = ("jinja2", "matplotlib", "numpy", "pandas", "pyarrow", "pydantic", "typst")


def up_to_date_page(folder: Path) -> Path:
    """Path of a sweep's page, drawn anew unless study.json says that its files are of this code and data.

    Raises
    ------
    ValidationError
        If it cannot be written.
    ReportError
        If the folder is not that of a sweep with at least one sample.
    """
    place = folder / PAGE_FILES[0]
    with writing(place, ValidationError):
        account = begun(folder) or {}
        source = _drawn_from(folder, account)
        if account.get("page") == _page(folder, source):
            return place
        with imports():
            from reports.sweep import write_sweep_page

        write_sweep_page(folder)
        write_json(folder / ACCOUNT, account | {"page": _page(folder, source)})
    return place


def _page(folder: Path, source: str) -> dict[str, Any]:
    """Return what study.json says of a page with these files."""
    files = {name: checksum(folder / name) for name in PAGE_FILES if (folder / name).is_file()}
    return DrawnPage(drawn_from=source, files=files).written()


def _drawn_from(folder: Path, account: Mapping[str, Any]) -> str:
    """Digest of what a page is drawn by and from: code, libraries, study, account and samples."""
    code = (path for name in DRAWN_BY for path in sorted((ROOT / name).rglob("*")) if path.suffix != ".pyc")
    digest = hashlib.sha256(sources_digest(filter(Path.is_file, code), LIBRARIES).encode())
    stated = {key: value for key, value in account.items() if key != "page"}
    digest.update(repr(stated).encode())
    for path in (folder / STUDY, *sorted((folder / SAMPLES).glob("*.parquet"))):
        digest.update(f"{path.name} {checksum(path)}\0".encode())
    return digest.hexdigest()
