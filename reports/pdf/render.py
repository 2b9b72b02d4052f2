"""The report as a typeset PDF: content reaches the template as data, so no text is read as markup."""

import json
import shutil
import tempfile
from dataclasses import fields, is_dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import typst

from reports.blocks import Figure, Report, Table
from reports.errors import ReportError

_TEMPLATE = Path(__file__).with_name("report.typ")


def render_pdf(report: Report) -> bytes:
    """Return the PDF of `report`, dated with the comparison's own time stamp.

    Raises
    ------
    ReportError
        If that time stamp is no ISO time.
    """
    try:
        created = datetime.fromisoformat(report.created)
    except ValueError as error:
        raise ReportError(
            f"provenance.json: created is {report.created!r}; an ISO time is expected"
        ) from error
    if created.tzinfo is None:
        created = created.replace(tzinfo=UTC)  # the reader's own time zone must not enter the file
    with tempfile.TemporaryDirectory(prefix="report-") as folder:
        root = Path(folder)
        shutil.copyfile(_TEMPLATE, root / _TEMPLATE.name)
        (root / "report.json").write_text(json.dumps(_plain(report, root)), encoding="utf-8")
        pdf = typst.compile(
            root / _TEMPLATE.name,
            root=root,
            format="pdf",
            ignore_system_fonts=True,
            timestamp=int(created.timestamp()),
            pdf_standards="ua-1",
        )
    if not isinstance(pdf, bytes):
        raise TypeError(f"one PDF is expected from the typesetter, found {type(pdf).__name__}")
    return pdf


def _plain(value: Any, root: Path) -> Any:
    """Content as JSON: each block names its kind; drawings and data become files beside the template."""
    if isinstance(value, tuple):
        return [_plain(item, root) for item in value]
    if not is_dataclass(value):
        return value
    plain = {field.name: _plain(getattr(value, field.name), root) for field in fields(value)}
    plain["kind"] = type(value).__name__ if "kind" not in plain else plain["kind"]
    if isinstance(value, Table):
        plain["groups"], plain["rules"] = value.groups(), value.rules()
    if isinstance(value, Figure):
        for suffix in ("svg", "csv"):
            (root / f"{value.key}.{suffix}").write_text(plain.pop(suffix), encoding="utf-8")
    return plain
