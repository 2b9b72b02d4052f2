"""Both renderings of one comparison, written beside it."""

import os
from dataclasses import replace
from pathlib import Path

from reports.ablation import ablation_section
from reports.content import report
from reports.html import render_html
from reports.load import load
from reports.pdf import render_pdf


def write_reports(directory: Path) -> tuple[Path, Path]:
    """Write report.html and report.pdf of a finished comparison into its directory.

    Both are rendered before either is written, so that a failure leaves earlier reports as they were.

    Parameters
    ----------
    directory : Path
        Holds comparison.nc, metrics.json and provenance.json, and ablation.json if there is one.

    Returns
    -------
    tuple of Path
        report.html and report.pdf.

    Raises
    ------
    ReportError
        If the directory is not a finished comparison.
    """
    content = report(load(directory))
    bought = ablation_section(directory)
    if bought is not None:  # before the provenance
        content = replace(content, sections=(*content.sections[:-1], bought, content.sections[-1]))
    pages = {
        directory / "report.html": render_html(content).encode(),
        directory / "report.pdf": render_pdf(content),
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
