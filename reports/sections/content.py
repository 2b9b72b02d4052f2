"""Content of a report, once, for every rendering."""

from reports.blocks import Report
from reports.result.load import Comparison
from reports.sections.order import SECTIONS
from reports.sections.parts.page_data import page_data
from reports.wording.numbers import listed


def identity(comparison: Comparison) -> str:
    """Case, commit and date of a run in one line."""
    commit = comparison.provenance.git_commit
    return " · ".join(
        (
            comparison.case,
            _commit(commit),
            comparison.provenance.created[:10],
        )
    )


def _commit(commit: str | None) -> str:
    if not commit:
        return "no commit"
    return f"commit {commit[:9]}" + (" with local changes" if commit.endswith("+") else "")


def _models(comparison: Comparison) -> str:
    if len(comparison.models) == 1:
        return "A two-dimensional reduced-order model of the artery (2D)"
    return f"Two-dimensional reduced-order models of the artery (2D: {listed(comparison.models)})"


def report(comparison: Comparison) -> Report:
    """Compose the report of a comparison; every figure is drawn here."""
    return Report(
        title=comparison.title or comparison.case,
        subtitle=f"{_models(comparison)} against three-dimensional fluid–structure simulation (3D), "
        "cell by cell.",
        identity=identity(comparison),
        created=comparison.provenance.created,
        sections=tuple(section for declared in SECTIONS if (section := declared(comparison))),
        data=page_data(comparison),
    )
