"""Page for several comparisons and sweeps, the worst first, with links to their reports."""

import os
from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path
from urllib.parse import quote

from cases.results.metric_row import Status
from reports.blocks import Report, Table
from reports.html.render import environment
from reports.result.load import Comparison
from reports.sections.answer import answer, which_model
from reports.sections.parts.heat_table import heat_table

RANKS: dict[Status, int] = {"FAIL": 0, "MISSING": 1, "OK": 2}


@dataclass(frozen=True)
class Entry:
    """One comparison, or one sweep, of the gallery.

    Attributes
    ----------
    directory : Path
        Where its reports are.
    title, identity, headline : str
        As in its report.
    sentences : tuple of str
        The verdict on each variant.
    counts : tuple of (str, int)
        How many bands fail, are missing and hold; those that occur.
    rank : tuple of float
        The worst has the least.
    picture, alt : str
        SVG of the artery, and the words that stand for it; "" for none.
    page, pdf : str
        Names of its report's files.
    table : Table or None
        Errors over their limits by pattern, model and quantity.
    """

    directory: Path
    title: str
    identity: str
    headline: str
    sentences: tuple[str, ...]
    counts: tuple[tuple[str, int], ...]
    rank: tuple[float, float]
    picture: str
    alt: str
    page: str
    pdf: str
    table: Table | None = None


def entry(directory: Path, comparison: Comparison, report: Report, drawings: dict[str, str]) -> Entry:
    """Sum up one comparison: bands that fail come first, by how far, then missing ones, then held ones."""
    bands = [row for model in comparison.models for row in comparison.of(model).metrics.bands()]
    judged = ([row.status for row in bands], [row.ratio for row in bands if row.error is not None])
    said = (which_model(comparison), tuple(answer(comparison, name) for name in comparison.variants))
    summary = summed_up(directory, report, drawings, said, judged, "artery-still")
    return replace(summary, table=heat_table(comparison))


def summed_up(
    directory: Path,
    report: Report,
    drawings: dict[str, str],
    said: tuple[str, tuple[str, ...]],
    judged: tuple[list[Status], list[float]],
    picture: str,
    files: tuple[str, str] = ("report.html", "report.pdf"),
) -> Entry:
    """Sum up a report.

    Parameters
    ----------
    directory, report, drawings
        Where it is, what it says, and its figures' SVG.
    said : (str, tuple of str)
        Its headline, and the verdicts.
    judged : (list of str, list of float)
        Verdicts of the bands, and how far errors are, over their limits.
    picture : str
        How the key of its picture begins.
    files : (str, str)
        Names of its page and of its PDF.
    """
    statuses, ratios = judged
    counts = Counter(statuses)
    figure = next((figure for figure in report.figures() if figure.key.startswith(picture)), None)
    return Entry(
        directory,
        report.title,
        report.identity,
        *said,
        tuple((status, counts[status]) for status in RANKS if counts[status]),
        (min((RANKS[status] for status in statuses), default=len(RANKS)), -max(ratios, default=0.0)),
        drawings[figure.key] if figure else "",
        figure.alt if figure else "",
        *files,
    )


def gallery_place(directories: list[Path]) -> Path:
    """Return where the page goes: gallery.html in the nearest folder that holds all directories."""
    parents = [str(directory.resolve().parent) for directory in directories]
    return Path(os.path.commonpath(parents)) / "gallery.html"


def render_gallery(entries: list[Entry], place: Path) -> str:
    """Return the HTML of the page that will be at `place`; its links are relative to there."""
    ordered = sorted(entries, key=lambda e: (e.rank, e.title))
    links = [quote(os.path.relpath(e.directory.resolve(), place.parent.resolve())) for e in ordered]
    template = environment().get_template("gallery.html")
    return template.render(entries=list(zip(ordered, links, strict=True)))
