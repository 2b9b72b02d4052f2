"""Both renderings of one comparison, written beside it."""

import os
from pathlib import Path

from reports.content import report
from reports.drawn import draw, helper
from reports.html import render_html
from reports.load import load
from reports.pdf import render_pdf


def write_reports(directory: Path) -> tuple[Path, Path]:
    """Write report.html and report.pdf of a finished comparison into its directory.

    Both are rendered before either is written, so that a failure leaves earlier reports as they were.

    Parameters
    ----------
    directory : Path
        Holds comparison.nc, metrics.json and provenance.json.

    Returns
    -------
    tuple of Path
        report.html and report.pdf.

    Raises
    ------
    ReportError
        If the directory is not a finished comparison.
    """
    with helper() as second:
        content = report(load(directory))
        drawings = draw({figure.key: figure.drawing for figure in content.figures()}, second)
    pages = {
        directory / "report.html": render_html(content, drawings).encode(),
        directory / "report.pdf": render_pdf(content, drawings),
    }
    for path, data in pages.items():
        _write(path, data)
    html, pdf = pages
    return html, pdf


def _write(path: Path, data: bytes) -> None:
    """Write all or nothing: a reader never finds half a file."""
    partial = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        partial.write_bytes(data)
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)
