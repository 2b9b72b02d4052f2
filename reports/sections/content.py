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


def _subtitle(comparison: Comparison) -> str:
    """Say what is compared, and of several reduced models the wall law and what has a pressure of its own."""
    against = "against three-dimensional fluid–structure simulation (3D), cell by cell."
    if len(comparison.models) == 1:
        return f"A two-dimensional reduced-order model of the artery (2D) {against}"
    said = []
    for model in comparison.models:
        facts = comparison.of(model).settings(comparison.variants[0]).facts()
        words = {"wall_law": "wall law {}", "pressure": "one pressure in each {}"}
        told = ", ".join(text.format(facts[key]) for key, text in words.items() if key in facts)
        said.append(f"{model} ({told})" if told else model)
    return f"Two-dimensional reduced-order models of the artery (2D) {against} They are {listed(said)}."


def report(comparison: Comparison) -> Report:
    """Compose the report of a comparison; every figure is drawn here."""
    return Report(
        title=comparison.title or comparison.case,
        subtitle=_subtitle(comparison),
        identity=identity(comparison),
        created=comparison.provenance.created,
        sections=tuple(section for declared in SECTIONS if (section := declared(comparison))),
        data=page_data(comparison),
    )
