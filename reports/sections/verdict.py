"""Section of the verdict: whether the declared bands hold, in sentences computed from the metrics."""

from collections import Counter

from cases.results.metric_row import MetricRow, Status
from reports.blocks import Block, Bullets, Column, Paragraph, Table, numbers, prose
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared, of_each_model
from reports.sections.parts import error_budget, pooled, trust
from reports.sections.parts.places import row_place
from reports.wording.numbers import ABSENT, counted, listed, rounded, share
from reports.wording.words import error_text, limit, quantity_words, statistic_words

_ORDER = {"FAIL": 0, "MISSING": 1, "OK": 2}


def worst_first(rows: tuple[MetricRow, ...]) -> list[MetricRow]:
    """Bands that fail by how far, then those that could not be judged, then those that hold by how close."""
    return sorted(rows, key=lambda r: (_ORDER[r.status], -r.ratio if r.error is not None else 0.0))


def headline(comparison: Comparison) -> str:
    """Say in one line how many bands hold, fail and are missing, variant by variant."""
    bands = comparison.metrics.bands()
    if not bands:
        return "The case declares no band, so nothing is judged: the figures below are measured, not graded."
    judged = [row for row in bands if not trust.not_periodic(comparison, row.variant)]
    counts = [(name, Counter(r.status for r in judged if r.variant == name)) for name in comparison.variants]
    parts = [f"{name}: {_tally(count)}" for name, count in counts if count]
    parts += [f"{name}: 3D is not periodic" for name in _unsettled(comparison)]
    if not judged:
        return f"Nothing is judged ({'; '.join(parts)})."
    total = Counter(r.status for r in judged)
    opening = (
        f"All {len(judged)} bands hold"
        if total["OK"] == len(judged) > 1
        else f"{total['OK']} of {counted(len(judged), 'band')} {'holds' if total['OK'] == 1 else 'hold'}"
    )
    return f"{opening} ({'; '.join(parts)})."


def _unsettled(comparison: Comparison) -> list[str]:
    """Variants whose 3D changes too much over a cycle for a verdict on the 2D model."""
    return [name for name in comparison.variants if trust.not_periodic(comparison, name)]


def _tally(count: Counter[Status]) -> str:
    words = [f"{count['OK']} of {count.total()} hold"]
    words += [f"{count['FAIL']} fail"] if count["FAIL"] else []
    words += [f"{count['MISSING']} missing"] if count["MISSING"] else []
    return ", ".join(words)


def worst(comparison: Comparison) -> str:
    """Name the band furthest beyond its limit, or nearest to it, with its numbers."""
    unsettled = _unsettled(comparison)
    judged = [
        row
        for row in comparison.metrics.bands()
        if row.error is not None and row.band is not None and row.variant not in unsettled
    ]
    if not judged:
        return ""
    row = max(judged, key=lambda r: r.ratio)
    where = row_place(comparison, row)
    opening = "Furthest beyond its limit" if row.status == "FAIL" else "Nearest to its limit"
    return (
        f"{opening}: {statistic_words(row.statistic)} of {quantity_words(row.quantity)} in variant "
        f"{row.variant}, {error_text(row)} against a limit of {limit(row)}"
        f"{f' (at {where})' if where else ''}."
    )


def by_variant(comparison: Comparison) -> tuple[str, ...]:
    """Say for each variant whether its bands hold, and by how much the furthest is missed or held."""
    said = []
    for name in comparison.variants:
        if trust.not_periodic(comparison, name):
            change = share(trust.cycle_change(comparison, name))
            said.append(
                f"{name}: 3D is not periodic (it changes by {change} over a cycle), so that its difference "
                "from 2D is no model error."
            )
            continue
        bands = [row for row in comparison.metrics.bands() if row.variant == name]
        judged = [row for row in bands if row.error is not None]
        failed = [row for row in worst_first(tuple(judged)) if row.status == "FAIL"]
        missing = len(bands) - len(judged)
        if not bands:
            said.append(f"{name}: no band was declared, so nothing is judged.")
            continue
        if failed:
            text = "the 2D model is not within what was declared: " + "; ".join(
                _with_budget(comparison, row) for row in failed
            )
        elif judged:
            nearest = max(judged, key=lambda row: row.ratio)
            text = (
                f"the 2D model is within every judged limit; nearest is {_with_budget(comparison, nearest)}"
            )
        else:
            text = "nothing can be said"
        unjudged = f"; {counted(missing, 'band')} could not be judged" if missing else ""
        said.append(f"{name}: {text}{unjudged}.")
    return tuple(said)


def _with_budget(comparison: Comparison, row: MetricRow) -> str:
    """Write an error against its limit, and behind it whose error it is."""
    owed = error_budget.of_band(comparison, row)
    return _against_limit(row) + (f" ({owed})" if owed else "")


def _against_limit(row: MetricRow) -> str:
    return (
        f"{statistic_words(row.statistic)} of {quantity_words(row.quantity)} {error_text(row)}, "
        f"limit {limit(row)}"
    )


def unknowns(comparison: Comparison) -> tuple[str, ...]:
    """Say what this comparison cannot tell: bands without a figure, mesh convergence, too few cycles."""
    missing = [r for r in comparison.metrics.bands() if r.status == "MISSING"]
    said = [
        f"{row.variant}: {statistic_words(row.statistic)} of {quantity_words(row.quantity)} was declared "
        f"({limit(row)}) but could not be computed; it counts as not held."
        for row in missing
    ]
    if comparison.sparse:
        said.append(
            "The reference states values at some cells and instants only; elsewhere, nothing is compared."
        )
    single = [
        name
        for name in comparison.variants
        if all(found["mesh"] is None for found in error_budget.budgets(comparison, name))
    ]
    if single:
        said.append(
            f"The 3D reference of {listed(single)} is one run on one mesh: how far its values are from those "
            "of a finer mesh is not measured here, so a difference smaller than that error says nothing "
            "about the 2D model."
        )
    variants = comparison.provenance.variants
    uncovered = [name for name in comparison.variants if variants[name].reference.coverage is None]
    if uncovered:
        said.append(f"How much of the cycle the 3D states of {listed(uncovered)} cover was not recorded.")
    unmeasured = [name for name in comparison.variants if variants[name].reference.cycle_change is None]
    if unmeasured:
        said.append(
            "Of 3D one cycle is compared; whether 3D had become periodic by then is not measured in "
            f"{listed(unmeasured)}: no two of its states are a cycle apart."
        )
    unrated = [name for name in comparison.variants if comparison.settings(name).cycle_change is None]
    if unrated:
        said.append(f"Whether the 2D model of {listed(unrated)} had become periodic was not recorded.")
    once = [name for name in comparison.variants if comparison.settings(name).cycles == 1]
    if once:
        said.append(
            f"The 2D model ran a single cycle for {listed(once)}: whether it had become periodic is not "
            "known."
        )
    return tuple(said)


def reason(comparison: Comparison, row: MetricRow) -> str:
    """Return the reason declared with the band that a row judges; "" if none is known."""
    for band in comparison.provenance.bands:
        same = (band.quantity, band.statistic, band.limit) == (row.quantity, row.statistic, row.band)
        if same and row.variant in (comparison.variants if band.variants is None else band.variants):
            return band.reason
    return ""


def _band_table(comparison: Comparison) -> Table:
    rows = tuple(
        (
            row.variant,
            row.status,
            quantity_words(row.quantity),
            statistic_words(row.statistic)
            + (f" ({row_place(comparison, row)})" if row_place(comparison, row) else ""),
            error_text(row),
            limit(row),
            rounded(row.ratio, 2) if row.error is not None else ABSENT,
            reason(comparison, row),
        )
        for row in worst_first(comparison.metrics.bands())
    )
    return Table(
        "bands",
        "Every declared band, worst first: failed by how far, then missing, then held by how close. "
        "Error is (2D − 3D) over 3D; of limit is the error's size over the limit, above 1 is a failure.",
        (
            Column("variant"),
            Column("verdict", "status"),
            *prose("quantity", "statistic"),
            *numbers("error", "limit", "of limit"),
            Column("reason for the limit", "prose"),
        ),
        rows,
        rule_by=1,
    )


def _other_references(comparison: Comparison) -> str:
    """Say of which variants the reference is no 3D simulation; "" where all are."""
    records = comparison.provenance.variants
    other = [name for name in comparison.variants if records[name].reference.simulation == "2D"]
    return (
        f"In {listed(other)} the reference is another 2D model: there, what is headed 3D is that one."
        if other
        else ""
    )


@declared("verdict", "Bands and checks", appendix=True)
@of_each_model
def section(comparison: Comparison) -> Blocks:
    """Return the bands, what the comparison cannot tell, and how far 3D can be trusted."""
    blocks: list[Block] = [Paragraph(headline(comparison), lead=True)]
    told = _other_references(comparison)
    if told:
        blocks.append(Paragraph(told))
    sentence = worst(comparison)
    if sentence:
        blocks.append(Paragraph(sentence))
    if comparison.metrics.bands():
        blocks += [Bullets(by_variant(comparison)), _band_table(comparison)]
    unknown = unknowns(comparison)
    if unknown:
        blocks += [Paragraph("What this comparison does not tell:"), Bullets(unknown)]
    blocks += [table for table in (trust.table(comparison), pooled.table(comparison)) if table]
    return tuple(blocks)
