"""The reduced models of a comparison in words."""

from collections.abc import Iterable

from cases.results.metric_row import Model
from reports.result.load import Comparison
from reports.wording.numbers import listed

_FEW = 3  # columns that leave room for words


def model_words(comparison: Comparison, models: Iterable[str]) -> str:
    """E.g. "the row model", "the row and coupled models"; "the 2D model" where there is but one."""
    names = list(models)
    if len(comparison.models) == 1:
        return "the 2D model"
    return f"the {listed(names)} model{'s' if len(names) > 1 else ''}"


def sides(comparison: Comparison) -> list[tuple[str, Comparison, Model]]:
    """3D and each reduced model: its heading, the view that holds it, and its name there."""
    models = [(headed(comparison, name), comparison.of(name)) for name in comparison.models]
    return [("3D", comparison, "reference"), *((words, view, "rom") for words, view in models)]


def columns_of(comparison: Comparison, variants: Iterable[str]) -> list[str]:
    """Headings of a figure's columns: titles of a few variants, names of many."""
    names = list(variants)
    return [comparison.titles[name] for name in names] if len(names) <= _FEW else names


def headed(comparison: Comparison, model: str) -> str:
    """Heading of a model's columns, and its name in a legend: its own name, or 2D for the only one."""
    return "2D" if len(comparison.models) == 1 else model
