"""The page of a sweep, written beside its samples."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from cases.results.sweep import OK, KeptOutput, VariedParameter
from reports.blocks import Report
from reports.figures.two_processes import draw
from reports.html.gallery import Entry, summed_up
from reports.pages import rendered, write_pages
from reports.sweep.amounts import DESIGNS, is_error
from reports.sweep.folder import STUDY, Sweep, load_sweep, shown
from reports.sweep.held import all_held, sentence
from reports.sweep.indices import indices_section
from reports.sweep.provenance import failures_section, provenance_section
from reports.sweep.responses import held_section, logarithmic, responses_section
from reports.sweep.verdict import headline, status, verdict_section
from reports.wording.numbers import counted, listed

HTML, PDF = "index.html", "index.pdf"


def is_sweep(directory: Path) -> bool:
    """Whether a folder is that of a sweep."""
    return (directory / STUDY).is_file()


def write_sweep_page(directory: Path) -> tuple[Path, Path]:
    """Write index.html and index.pdf of a sweep, finished or not, into its folder.

    Parameters
    ----------
    directory : Path
        Holds study.json and samples/.

    Raises
    ------
    ReportError
        If the folder is not that of a sweep with at least one sample.
    """
    write_sweep_entry(directory)
    return directory / HTML, directory / PDF


def write_sweep_entry(directory: Path) -> Entry:
    """Write the page of a sweep as :func:`write_sweep_page` does, and return what a gallery shows of it."""
    sweep = load_sweep(directory)
    content = sweep_report(sweep)
    drawings = draw({figure.key: figure.drawing for figure in content.figures()}, None)
    html, pdf = rendered(content, drawings)
    write_pages({directory / HTML: html, directory / PDF: pdf})
    bands = all_held(sweep)
    said = (headline(sweep, bands), tuple(sentence(found, sweep.study.parameters) for found in bands))
    judged = ([status(found) for found in bands], [found.furthest for found in bands])
    return summed_up(directory, content, drawings, said, judged, "held-", (HTML, PDF))


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


MOST_SAMPLES = 5000  # points that a browser still moves at ease


def page_data(sweep: Sweep) -> dict[str, Any]:
    """Return JSON values for the page's scripts: display units, every n-th sample of a very large sweep."""
    done = sweep.samples[sweep.samples["status"] == OK]
    done = done.iloc[:: -(-len(done) // MOST_SAMPLES) or 1]
    judged = [k for k, output in enumerate(sweep.study.outputs) if output.band]
    errors = [k for k, output in enumerate(sweep.study.outputs) if is_error(output)]
    return {
        "variants": sweep.variants,
        "variant": [sweep.variants.index(name) for name in done["variant"]],
        "sample": [int(number) for number in done["sample"]],
        "start": next(iter((*judged, *errors)), 0),
        "parameters": [
            {**_column(p, done), "logarithmic": logarithmic(p, done)} for p in sweep.study.parameters
        ],
        "outputs": [
            {**_column(o, done), "limits": [_limit(sweep, variant, o) for variant in sweep.variants]}
            for o in sweep.study.outputs
        ],
    }


def _column(item: VariedParameter | KeptOutput, samples: pd.DataFrame) -> dict[str, object]:
    values = [float(f"{value:.6g}") if np.isfinite(value) else None for value in shown(item, samples)]
    return {"label": item.label, "unit": item.unit, "values": values}


def _limit(sweep: Sweep, variant: str, output: KeptOutput) -> float | None:
    band = sweep.band(variant, output)
    return None if band is None else float(f"{band.limit * output.display_factor:.6g}")
