"""The PDF of two models as a document: its length, headings, contents, attachments and bytes."""

import io
import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pypdf
import pytest
import synthetic_comparison as synthetic
import typst
from PIL import Image

from reports.blocks import Interactive, Section, Subsection
from reports.build import write_reports
from reports.result.load import load
from reports.sections.content import report

Finished = tuple[Path, list[dict[str, Any]]]
MOST_PAGES = 10  # before the appendix


@pytest.fixture(scope="module")
def reader(two_models: Finished) -> pypdf.PdfReader:
    """The PDF of the comparison of two models."""
    return pypdf.PdfReader(two_models[0] / "report.pdf")


def _outline(reader: pypdf.PdfReader) -> list[tuple[str, int]]:
    """Titles of the sections, and their pages counted from 1."""
    found = []
    for item in reader.outline:
        if not isinstance(item, list):
            page = reader.get_destination_page_number(item)
            assert page is not None
            found.append((str(item.title), page + 1))
    return found


def test_what_is_read_has_few_pages_and_the_appendix_begins_one(
    reader: pypdf.PdfReader, two_models: Finished, pdf_pages: Callable[[Path], list[str]]
) -> None:
    outline = _outline(reader)
    first, page = next((title, page) for title, page in outline if title.startswith("A "))
    assert first == "A Bands and checks"
    assert page - 1 <= MOST_PAGES
    assert len(reader.pages) > page
    assert all(before < page for title, before in outline if title[0].isdigit())
    assert pdf_pages(two_models[0] / "report.pdf")[page - 1].startswith(first)


def test_no_word_is_lost_where_drawings_are_not_read(
    reader: pypdf.PdfReader, two_models: Finished, pdf_pages: Callable[[Path], list[str]]
) -> None:
    first = re.sub(r"\s+", " ", reader.pages[0].extract_text())
    assert pdf_pages(two_models[0] / "report.pdf")[0] == first


def _printed(section: Section) -> Iterator[tuple[str, bool]]:
    """Heading of a section and of its parts, and whether a page of paper has anything below."""
    inner = [part for part in section.blocks if isinstance(part, Subsection)]
    yield section.title, any(not isinstance(part, Interactive) for part in section.blocks)
    for part in inner:
        yield part.title, any(not isinstance(block, Interactive) for block in part.blocks)


def test_every_heading_has_content(reader: pypdf.PdfReader, two_models: Finished) -> None:
    content = report(load(two_models[0]))
    printed = [heading for section in content.sections for heading in _printed(section)]
    without = [title for title, filled in printed if not filled]
    assert without == ["Every figure of this comparison"]  # what only a page with scripts has
    titles = [title.partition(" ")[2] for title, _ in _outline(reader)]
    assert titles == [section.title for section in content.sections if section.title not in without]


def test_the_contents_name_what_is_read_and_its_pages(
    reader: pypdf.PdfReader, two_models: Finished, pdf_text: Callable[[Path], str]
) -> None:
    text = pdf_text(two_models[0] / "report.pdf").replace("\u00a0", " ")
    contents = text.partition("Contents: ")[2]
    outline = _outline(reader)
    read = [f"{title} (p. {page})" for title, page in outline if title[0].isdigit()]
    appendix = next(page for title, page in outline if title.startswith("A "))
    assert contents.startswith(" · ".join([*read, f"Appendix (p. {appendix})"]))
    assert text.index("Which model for which question") < text.index("Contents: ")


def test_figures_and_tables_are_numbered_in_order(
    two_models: Finished, pdf_text: Callable[[Path], str]
) -> None:
    text = pdf_text(two_models[0] / "report.pdf")
    for kind in ("Figure", "Table"):
        numbers = [int(n) for n in re.findall(rf"{kind} (\d+)\. ", text)]
        assert numbers == list(range(1, len(numbers) + 1))
        assert len(numbers) > 10


def test_each_page_says_whose_it_is(
    reader: pypdf.PdfReader, two_models: Finished, pdf_pages: Callable[[Path], list[str]]
) -> None:
    texts = pdf_pages(two_models[0] / "report.pdf")
    for number, (page, text) in enumerate(zip(reader.pages, texts, strict=True), start=1):
        assert tuple(round(float(n)) for n in page.mediabox[2:]) == (595, 842)
        assert f"page {number} of {len(reader.pages)}" in text
        assert "synthetic · commit 012345678 · 2026-03-04" in text


def test_the_case_file_and_the_data_of_every_figure_are_attached(
    reader: pypdf.PdfReader, two_models: Finished
) -> None:
    attached = {name: files[0].decode() for name, files in reader.attachments.items()}
    expected = {f"{figure.key}.csv": figure.csv for figure in report(load(two_models[0])).figures()}
    assert attached == expected | {"case.yaml": synthetic.CASE_YAML}


@pytest.fixture(scope="module")
def again(two_models: Finished, tmp_path_factory: pytest.TempPathFactory) -> tuple[bool, list[bytes]]:
    """Whether the same reports are written again, and the PDF's pages as small pictures."""
    before = [(two_models[0] / name).read_bytes() for name in ("report.html", "report.pdf")]
    copied = shutil.copytree(two_models[0], tmp_path_factory.mktemp("again") / "copy")
    pages: list[bytes] = []
    compile_pdf = typst.compile

    def also_as_pictures(source: Path, **options: Any) -> bytes:
        kept = {name: options[name] for name in ("root", "font_paths", "ignore_system_fonts")}
        pages.extend(compile_pdf(source, format="png", ppi=30.0, **kept))  # type: ignore[arg-type]
        made = compile_pdf(source, **options)
        assert isinstance(made, bytes)
        return made

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(typst, "compile", also_as_pictures)
        written = write_reports(copied)
    return [path.read_bytes() for path in written] == before, pages


@pytest.mark.slow
def test_same_input_same_bytes(again: tuple[bool, list[bytes]]) -> None:
    assert again[0]


def test_no_page_is_half_empty(again: tuple[bool, list[bytes]], reader: pypdf.PdfReader) -> None:
    """But the last of what is read, and those of the appendix where the next thing, whole, did not fit."""
    appendix = next(page for title, page in _outline(reader) if title.startswith("A "))
    filled = {}
    for number, page in enumerate(again[1], start=1):
        picture = np.asarray(Image.open(io.BytesIO(page)).convert("L"))
        body = picture[: int(0.925 * picture.shape[0])]  # above the footer
        filled[number] = np.flatnonzero((body < 200).any(axis=1)).max() / body.shape[0]
    assert [n for n in range(1, appendix - 1) if filled[n] < 0.6] == [], filled
    assert [n for n in range(appendix, len(filled)) if filled[n] < 0.45] == [], filled


def test_no_number_and_no_unit_is_torn(two_models: Finished, pdf_text: Callable[[Path], str]) -> None:
    text = pdf_text(two_models[0] / "report.pdf")
    assert re.findall(r"= \d+\.[\u200b ]+\d+ ?s", text) == []
    assert re.findall(r"[cm]m[²³]?/[\u200b ]+s\b", text) == []
