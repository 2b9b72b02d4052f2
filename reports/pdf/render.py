"""The report as a typeset PDF: content reaches the template as data, so no text is read as markup."""

import json
import shutil
import tempfile
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import Any

import matplotlib
import typst
from matplotlib.ft2font import FT2Font

from reports.blocks import Figure, Report, Table
from reports.errors import ReportError

#: Typeset as they are although no font has them: ends of lines, tabs, places where a word may break.
_WITHOUT_GLYPH = "\n\r\t\u200b"
_FALLBACK_FONT = Path(matplotlib.get_data_path(), "fonts", "ttf", "DejaVuSansMono.ttf")
_TEMPLATE = Path(__file__).with_name("report.typ")


def render_pdf(report: Report, drawings: Mapping[str, str]) -> bytes:
    """Return the PDF of `report`, dated with the comparison's own time stamp.

    Parameters
    ----------
    report : Report
        The content.
    drawings : mapping of str to str
        SVG of each figure, by its key.

    Raises
    ------
    ReportError
        If that time stamp is no ISO time, or the text cannot be typeset.
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
        for key, svg in drawings.items():
            (root / f"{key}.svg").write_text(svg, encoding="utf-8")
        (root / "report.json").write_text(json.dumps(_plain(report, root)), encoding="utf-8")
        try:
            pdf = typst.compile(
                root / _TEMPLATE.name,
                root=root,
                format="pdf",
                font_paths=[_FALLBACK_FONT.parent],
                ignore_system_fonts=True,
                timestamp=int(created.timestamp()),
                pdf_standards="ua-1",
            )
        except typst.TypstError as error:
            raise ReportError(f"the PDF cannot be typeset: {str(error).partition(chr(10))[0]}") from error
    if not isinstance(pdf, bytes):
        raise TypeError(f"one PDF is expected from the typesetter, found {type(pdf).__name__}")
    return pdf


@cache
def _glyphs() -> frozenset[str]:
    return frozenset(chr(code) for code in FT2Font(str(_FALLBACK_FONT)).get_charmap()) | set(_WITHOUT_GLYPH)


def displayable(text: str) -> str:
    """Write characters that the PDF's fonts lack as their code, e.g. [U+6F22], so that none is lost."""
    return "".join(letter if letter in _glyphs() else f"[U+{ord(letter):04X}]" for letter in text)


def _plain(value: Any, root: Path) -> Any:
    """Content as JSON: each block names its kind; drawings and data become files beside the template."""
    if isinstance(value, frozenset):
        return sorted(value)
    if isinstance(value, tuple):
        return [_plain(item, root) for item in value]
    if isinstance(value, str):
        return displayable(value)
    if not is_dataclass(value):
        return value
    names = [field.name for field in fields(value) if field.name not in ("drawing", "data", "shades")]
    plain = {name: _plain(getattr(value, name), root) for name in names}
    plain["kind"] = type(value).__name__ if "kind" not in plain else plain["kind"]
    if isinstance(value, Table):
        plain["groups"], plain["rules"] = value.groups(), value.rules()
        cells = range(len(value.columns))
        plain["shades"] = [[value.shade(row, at) for at in cells] for row in range(len(value.rows))]
    if isinstance(value, Figure):
        (root / f"{value.key}.csv").write_text(plain.pop("csv"), encoding="utf-8")
    return plain
