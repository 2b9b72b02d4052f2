"""Reports of one comparison, written beside it; a page for several."""

from pathlib import Path

from reports.figures.two_processes import draw, helper
from reports.html.gallery import Entry, entry, gallery_place, render_gallery
from reports.pages import rendered, write_pages
from reports.result.load import load
from reports.sections.content import report
from reports.sweep.build import is_sweep, write_sweep_entry


def write_reports(directory: Path) -> tuple[Path, Path]:
    """Write report.html and report.pdf of a finished comparison into its directory.

    Both are rendered before either is written, so that a failure leaves earlier reports as they were.

    Parameters
    ----------
    directory : Path
        Holds comparison.nc, metrics.json and provenance.json, and ablation.json if there is one.

    Raises
    ------
    ReportError
        If the directory is not a finished comparison.
    """
    _write_reports(directory)
    return directory / "report.html", directory / "report.pdf"


def write_gallery(directories: list[Path]) -> Path:
    """Write the reports of several comparisons and sweeps, and a page that leads to them, the worst first.

    Parameters
    ----------
    directories : list of Path
        As for :func:`write_reports`, or folders of sweeps.

    Returns
    -------
    Path
        gallery.html in the nearest folder that holds all directories.

    Raises
    ------
    ReportError
        If one is neither; the page is then not written.
    """
    entries = [
        write_sweep_entry(directory) if is_sweep(directory) else _write_reports(directory)
        for directory in directories
    ]
    place = gallery_place(directories)
    write_pages({place: render_gallery(entries, place).encode()})
    return place


def _write_reports(directory: Path) -> Entry:
    with helper() as second:
        comparison = load(directory)
        content = report(comparison)
        drawings = draw({figure.key: figure.drawing for figure in content.figures()}, second)
    html, pdf = rendered(content, drawings)
    write_pages({directory / "report.html": html, directory / "report.pdf": pdf})
    return entry(directory, comparison, content, drawings)
