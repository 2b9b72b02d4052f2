"""The words of a PDF, read without its drawings: their paths are most of a page, and hold no text."""

import io
import re

import pypdf
from pypdf.generic import DecodedStreamObject, NameObject

_PATHS = re.compile(rb"(?<=\s)(?:(?:-?[\d.]+ ){2}[ml]|(?:-?[\d.]+ ){6}c)(?=\s)")  # moves, lines and curves


def words_of_pages(content: bytes) -> list[str]:
    """Return the text of each page with single spaces between words."""
    return [re.sub(r"\s+", " ", _text(page)) for page in pypdf.PdfReader(io.BytesIO(content)).pages]


def _text(page: pypdf.PageObject) -> str:
    contents = page.get_contents()
    if contents is None:
        return ""
    without = DecodedStreamObject()
    without.set_data(_PATHS.sub(b"", contents.get_data()))
    page[NameObject("/Contents")] = without
    return page.extract_text()
