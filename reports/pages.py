"""Files of a report: both renderings, each written whole or not at all."""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from cases.shell.whole import write_whole
from reports.blocks import Report
from reports.html.render import render_html
from reports.pdf.render import render_pdf


def rendered(content: Report, drawings: Mapping[str, str]) -> tuple[bytes, bytes]:
    """Return a report as HTML and as PDF."""
    with ThreadPoolExecutor(max_workers=1) as pool:  # typst works outside the interpreter's lock
        pdf = pool.submit(render_pdf, content, drawings)
        return render_html(content, drawings).encode(), pdf.result()


def write_pages(pages: Mapping[Path, bytes]) -> None:
    """Write each page whole or not at all: a reader never finds half a file."""
    for path, data in pages.items():
        with write_whole(path) as partial:
            partial.write_bytes(data)
