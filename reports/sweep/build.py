"""The page of a sweep, written beside its samples."""

from pathlib import Path

from reports.blocks import Report
from reports.build import rendered, write_pages
from reports.drawn import draw
from reports.numbers import counted, listed
from reports.sweep.account import failures_section, provenance_section, verdict_section
from reports.sweep.held import all_held
from reports.sweep.indices import indices_section
from reports.sweep.load import STUDY, Sweep, load_sweep
from reports.sweep.page_data import page_data
from reports.sweep.responses import held_section, responses_section
from reports.sweep.words import DESIGNS


def is_sweep(directory: Path) -> bool:
    """Whether a folder is that of a sweep."""
    return (directory / STUDY).is_file()


def write_sweep_page(directory: Path) -> tuple[Path, Path]:
    """Write index.html and index.pdf of a sweep, finished or not, into its folder.

    Parameters
    ----------
    directory : Path
        Holds study.json and samples/.

    Returns
    -------
    tuple of Path
        index.html and index.pdf.

    Raises
    ------
    ReportError
        If the folder is not that of a sweep with at least one sample.
    """
    content = sweep_report(load_sweep(directory))
    drawings = draw({figure.key: figure.drawing for figure in content.figures()}, None)
    html, pdf = rendered(content, drawings)
    pages = (directory / "index.html", directory / "index.pdf")
    write_pages(dict(zip(pages, (html, pdf), strict=True)))
    return pages


def sweep_report(sweep: Sweep) -> Report:
    """Compose the page of a sweep."""
    study = sweep.study
    bands = all_held(sweep)
    commit = f"commit {study.git_commit[:9]}" if study.git_commit else "no commit"
    design = DESIGNS.get(study.design.kind, study.design.kind)
    return Report(
        title=study.title or study.name,
        subtitle=f"{counted(study.counts.total, 'run')} of the two-dimensional reduced-order model around "
        f"{study.base_case} ({listed(sweep.variants)}), over {listed(p.label for p in study.parameters)}; "
        f"design: {design}.",
        identity=" · ".join((study.name, commit, study.created[:10])),
        created=study.created,
        sections=(
            verdict_section(sweep, bands),
            held_section(sweep, bands),
            responses_section(sweep),
            indices_section(sweep),
            failures_section(sweep),
            provenance_section(sweep),
        ),
        data=page_data(sweep),
    )
