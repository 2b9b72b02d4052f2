"""The order of the sections: one that a user adds stands at its place in both renderings."""

import html
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pypdf
import pytest
import synthetic_comparison as synthetic

from reports.blocks import Paragraph
from reports.build import write_reports
from reports.result.load import Comparison, load
from reports.sections import overview, verdict
from reports.sections.content import report
from reports.sections.declaration import Blocks, declared, result_file
from reports.sections.order import SECTIONS

TITLE = "Narrowest cell"


@declared("narrowest", TITLE, result_file("narrowest.txt"))
def section(comparison: Comparison) -> Blocks:
    return (Paragraph(f"It is {(comparison.directory / 'narrowest.txt').read_text()}."),)


@pytest.fixture
def added() -> Iterator[int]:
    """Its number: it stands before the overview, behind the answer."""
    at = SECTIONS.index(overview.section)
    SECTIONS.insert(at, section)
    yield at + 1
    SECTIONS.remove(section)


def test_an_added_section_is_found_at_its_place(
    tmp_path: Path, small: synthetic.Setup, added: int, pdf_text: Any, undrawn: None
) -> None:
    synthetic.write(tmp_path, small)
    (tmp_path / "narrowest.txt").write_text("at i = 6")
    write_reports(tmp_path)
    page = (tmp_path / "report.html").read_text()
    headings = re.findall(r"<h2 id=\"([^\"]+)\">(\d+)\. ([^<]+)</h2>", page)
    assert [int(number) for _, number, _ in headings] == list(range(1, len(headings) + 1))
    assert (headings[added - 1][0], headings[added - 1][2]) == ("narrowest", TITLE)
    assert headings[added][2] == html.escape(overview.section.title)
    assert "<p>It is at i = 6.</p>" in page
    assert f"{added} {TITLE} It is at i = 6. {added + 1} {overview.section.title}" in pdf_text(
        tmp_path / "report.pdf"
    )
    outline = [
        item.title for item in pypdf.PdfReader(tmp_path / "report.pdf").outline if not isinstance(item, list)
    ]
    assert outline[added - 1].endswith(TITLE)


def test_a_section_without_what_it_needs_is_left_out(
    tmp_path: Path, small: synthetic.Setup, added: int
) -> None:
    synthetic.write(tmp_path, small)
    titles = [shown.title for shown in report(load(tmp_path)).sections]
    assert TITLE not in titles
    assert titles[added - 1] == overview.section.title


@pytest.mark.parametrize("unknown", [(), ("That nothing is known.",)])
def test_nothing_is_announced_where_nothing_is_unknown(
    tmp_path: Path, small: synthetic.Setup, monkeypatch: pytest.MonkeyPatch, unknown: tuple[str, ...]
) -> None:
    synthetic.write(tmp_path, small)
    monkeypatch.setattr(verdict, "unknowns", lambda comparison: unknown)
    blocks = verdict.section.blocks(load(tmp_path))
    assert (Paragraph("What this comparison does not tell:") in blocks) == bool(unknown)
