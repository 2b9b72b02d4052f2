"""The first section: whether the 2D model may replace 3D, where, by how much, and what each costs."""

from collections.abc import Iterable

from cases.results.metric_row import MetricRow
from reports.blocks import Block, Bullets, Paragraph, Warnings
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared
from reports.sections.parts import trust
from reports.sections.parts.cost import cost_sentence
from reports.sections.parts.error_budget import budget
from reports.sections.parts.heat_table import heat_table
from reports.sections.parts.limits import place_beyond
from reports.sections.parts.models import model_words
from reports.sections.parts.trust_figure import trust_figure
from reports.wording.numbers import listed, share
from reports.wording.words import error_text, limit, quantity_words, statistic_words


def _bands(comparison: Comparison, model: str, variant: str) -> list[MetricRow]:
    return [row for row in comparison.of(model).metrics.bands() if row.variant == variant]


def answer(comparison: Comparison, variant: str) -> str:
    """Say in a sentence or two whether the reduced models may replace 3D in one variant."""
    opening = f"{comparison.titles[variant]}: "
    if trust.not_periodic(comparison, variant):
        change = share(trust.cycle_change(comparison, variant))
        return f"{opening}not judged; 3D is not periodic (it changes by {change} over a cycle)."
    judged = {model: _bands(comparison, model, variant) for model in comparison.models}
    if not any(judged.values()):
        return f"{opening}not judged; no limit was declared."
    failing = {m: [row for row in rows if row.status != "OK"] for m, rows in judged.items()}
    good = [model for model, rows in failing.items() if not rows]
    bad = [model for model in comparison.models if model not in good]
    local = "".join(f" {text}" for model in good if (text := _locally(comparison, model, judged[model])))
    what = listed(dict.fromkeys(quantity_words(row.quantity) for row in judged[comparison.models[0]]))
    if not bad:
        return f"{opening}yes, for {what}, with {model_words(comparison, good)}{_nearest(judged)}.{local}"
    said = " ".join(_missed(comparison, model, failing[model]) for model in bad)
    if not good:
        return f"{opening}no. {said}"
    return f"{opening}yes, for {what}, with {model_words(comparison, good)}.{local} {said}"


def _locally(comparison: Comparison, model: str, rows: Iterable[MetricRow]) -> str:
    """Say where a model that is within its limits as a whole is beyond them; "" where nowhere."""
    view = comparison.of(model)
    places = [(quantity_words(row.quantity), where) for row in rows if (where := place_beyond(view, row))]
    if not places:
        return ""
    said = "; ".join(f"{words} {where}" for words, where in places)
    return f"Locally {model_words(comparison, [model])} is beyond the limit: {said}."


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _nearest(judged: dict[str, list[MetricRow]]) -> str:
    rows = [row for of in judged.values() for row in of if row.error is not None]
    nearest = max(rows, key=lambda row: row.ratio)
    return f" (nearest to its limit: {quantity_words(nearest.quantity)}, {_against(nearest)})"


def _against(row: MetricRow) -> str:
    return f"{statistic_words(row.statistic)} {error_text(row)}, limit {limit(row)}"


def _missed(comparison: Comparison, model: str, rows: Iterable[MetricRow]) -> str:
    """Name what a model misses, by how much and where, and what could not be judged."""
    name = _capital(model_words(comparison, [model]))
    beyond, unknown = [], []
    for row in rows:
        if row.error is None:
            unknown.append(quantity_words(row.quantity))
            continue
        where = place_beyond(comparison.of(model), row)
        beyond.append(
            f"{quantity_words(row.quantity)}, {_against(row)}{_with_inflow(comparison.of(model), row)}"
            f"{f', exceeded {where}' if where else ''}"
        )
    said = [f"{name} misses {'; '.join(beyond)}."] if beyond else []
    if unknown:
        said.append(f"{'It' if beyond else name} could not be judged by {listed(unknown)}.")
    return " ".join(said)


def _with_inflow(view: Comparison, row: MetricRow) -> str:
    """Say what an RMS error is with the inflow of 3D; "" where that was not computed."""
    found = budget(view, row.variant, row.quantity) if row.statistic == "rms_error" else None
    matched = None if found is None else found["matched"]
    return "" if matched is None else f" ({share(matched)} with the inflow of 3D)"


def which_model(comparison: Comparison) -> str:
    """Say which model suffices for which quantity; "" where there is one model, or nothing is judged."""
    bands = comparison.metrics.bands()
    if len(comparison.models) == 1 or not bands:
        return ""
    said = []
    for quantity in dict.fromkeys(row.quantity for row in bands):
        by_model: dict[str, list[str]] = {}
        for variant in dict.fromkeys(row.variant for row in bands if row.quantity == quantity):
            if not trust.not_periodic(comparison, variant):
                holding = [m for m in comparison.models if _holds(comparison, m, variant, quantity)]
                by_model.setdefault(holding[0] if holding else "no model", []).append(variant)
        parts = [f"{model} in {listed(names)}" for model, names in by_model.items()]
        said += [f"{quantity_words(quantity)}: {', '.join(parts)}"] if parts else []
    if not said:
        return ""
    return f"Which model for which question (the first one within its limits): {'; '.join(said)}."


def _holds(comparison: Comparison, model: str, variant: str, quantity: str) -> bool:
    rows = [row for row in _bands(comparison, model, variant) if row.quantity == quantity]
    return all(row.status == "OK" for row in rows)


@declared("answer", "May the 2D model replace 3D?")
def section(comparison: Comparison) -> Blocks:
    """Return the answer for each variant, the errors over their limits, where they are, and the cost."""
    blocks: list[Block] = []
    warnings = (*trust.doubts(comparison), *comparison.provenance.warnings)
    if comparison.metrics.bands():
        blocks.append(Bullets(tuple(answer(comparison, name) for name in comparison.variants), lead=True))
    else:
        told = "The case declares no limit, so nothing is judged: figures are measured, not graded."
        blocks.append(Paragraph(told, lead=True))
    sentence = which_model(comparison)
    if sentence:
        blocks.append(Paragraph(sentence))
    if warnings:
        blocks.append(Warnings(warnings))
    blocks += [block for block in (trust_figure(comparison), heat_table(comparison)) if block]
    cost = cost_sentence(comparison)
    if cost:
        blocks.append(Paragraph(cost))
    return tuple(blocks)
