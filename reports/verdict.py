"""Section 1: whether the declared bands hold, in sentences computed from the metrics."""

from collections import Counter

from reports import trust
from reports.blocks import Block, Bullets, Column, Interactive, Paragraph, Section, Table, Warnings
from reports.load import Comparison
from reports.metrics import Row, Status
from reports.numbers import ABSENT, counted, listed, percent, rounded, unsigned
from reports.words import limit, measure, place, quantity_words, statistic_words

_ORDER = {"FAIL": 0, "MISSING": 1, "OK": 2}


def worst_first(rows: tuple[Row, ...]) -> list[Row]:
    """Bands that fail by how far, then those that could not be judged, then those that hold by how close."""
    return sorted(rows, key=lambda r: (_ORDER[r.status], -r.ratio if r.error is not None else 0.0))


def headline(comparison: Comparison) -> str:
    """Say in one line how many bands hold, fail and are missing, variant by variant."""
    bands = comparison.metrics.bands()
    if not bands:
        return "The case declares no band, so nothing is judged: the figures below are measured, not graded."
    counts = [(name, Counter(r.status for r in bands if r.variant == name)) for name in comparison.variants]
    parts = [f"{name}: {_tally(count)}" for name, count in counts if count]
    total = Counter(r.status for r in bands)
    opening = (
        f"All {len(bands)} bands hold"
        if total["OK"] == len(bands) > 1
        else f"{total['OK']} of {counted(len(bands), 'band')} {'holds' if total['OK'] == 1 else 'hold'}"
    )
    return f"{opening} ({'; '.join(parts)})."


def _tally(count: Counter[Status]) -> str:
    words = [f"{count['OK']} of {count.total()} hold"]
    words += [f"{count['FAIL']} fail"] if count["FAIL"] else []
    words += [f"{count['MISSING']} missing"] if count["MISSING"] else []
    return ", ".join(words)


def worst(comparison: Comparison) -> str:
    """Name the band furthest beyond its limit, or nearest to it, with its numbers."""
    judged = [r for r in comparison.metrics.bands() if r.error is not None and r.band is not None]
    if not judged:
        return ""
    row = max(judged, key=lambda r: r.ratio)
    where = place(row)
    opening = "Furthest beyond its limit" if row.status == "FAIL" else "Nearest to its limit"
    return (
        f"{opening}: {statistic_words(row.statistic)} of {quantity_words(row.quantity)} in variant "
        f"{row.variant}, {_error_text(row)} against a limit of {limit(row)}"
        f"{f' (at {where})' if where else ''}."
    )


def unknowns(comparison: Comparison) -> tuple[str, ...]:
    """Say what this comparison cannot tell: bands without a figure, mesh convergence, too few cycles."""
    missing = [r for r in comparison.metrics.bands() if r.status == "MISSING"]
    said = [
        f"{row.variant}: {statistic_words(row.statistic)} of {quantity_words(row.quantity)} was declared "
        f"({limit(row)}) but could not be computed; it counts as not held."
        for row in missing
    ]
    said.append(
        "Each 3D reference is one run on one mesh: how far its values are from those of a finer mesh is not "
        "measured here, so a difference smaller than that error says nothing about the 2D model."
    )
    variants = comparison.provenance.variants
    single = [name for name in comparison.variants if variants[name].rom.cycles == 1]
    if single:
        said.append(
            f"The 2D model ran a single cycle for {listed(single)}: whether it had become periodic is not "
            "known."
        )
    return tuple(said)


def _error_text(row: Row) -> str:
    """Write the error with as many decimals as it takes to tell it from its limit."""
    for decimals in range(2, 7):
        text = measure(row, row.error, decimals)
        if text.lstrip("+−") != measure(row, row.band, decimals).lstrip("+"):
            break
    return text


def reason(comparison: Comparison, row: Row) -> str:
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
            statistic_words(row.statistic) + (f" ({place(row)})" if place(row) else ""),
            _error_text(row),
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
            Column("quantity", "prose"),
            Column("statistic", "prose"),
            Column("error", "number"),
            Column("limit", "number"),
            Column("of limit", "number"),
            Column("reason for the limit", "prose"),
        ),
        rows,
        rule_by=1,
    )


def _pooled_table(comparison: Comparison) -> Table | None:
    found: dict[tuple[str, str], dict[str, Row]] = {}
    for statistic in ("bias", "scatter", "rms_error", "max_error"):
        for row in comparison.metrics.pooled(statistic):
            found.setdefault((row.variant, row.quantity), {})[statistic] = row
    order = {name: k for k, name in enumerate(comparison.variants)}
    rows = []
    for (variant, quantity), by in sorted(found.items(), key=lambda kv: order.get(kv[0][0], len(order))):
        figures = [by.get(name) for name in ("bias", "scatter", "rms_error", "max_error")]
        largest = figures[3]
        rows.append(
            (
                variant,
                quantity_words(quantity),
                percent(figures[0].error if figures[0] else None),
                unsigned(percent(figures[1].error if figures[1] else None)),
                unsigned(percent(figures[2].error if figures[2] else None)),
                percent(largest.error if largest else None),
                place(largest) if largest else ABSENT,
            )
        )
    if not rows:
        return None
    return Table(
        "pooled",
        "Errors over all cells and all states of the cycle. A bias near the RMS error means that the 2D "
        "model is off by the same share everywhere; a scatter near it, that it is off differently from place "
        "to place.",
        (
            Column("variant"),
            Column("quantity", "prose"),
            Column("bias", "number"),
            Column("scatter", "number"),
            Column("RMS error", "number"),
            Column("largest error", "number"),
            Column("found at"),
        ),
        tuple(rows),
        rule_by=0,
    )


def section(comparison: Comparison) -> Section:
    """Build the section."""
    blocks: list[Block] = [Paragraph(headline(comparison), lead=True)]
    warnings = (*trust.doubts(comparison), *comparison.provenance.warnings)
    if warnings:
        blocks.append(Warnings(warnings))
    sentence = worst(comparison)
    if sentence:
        blocks += [Paragraph(sentence), _band_table(comparison)]
    elif comparison.metrics.bands():
        blocks.append(_band_table(comparison))
    blocks.append(trust.table(comparison))
    pooled = _pooled_table(comparison)
    if pooled:
        blocks.append(pooled)
    blocks.append(
        Interactive(
            "metrics-all",
            "metrics",
            "Every figure of this comparison",
            "All rows of metrics.json, values in SI units, errors relative to 3D. Choose what to see; a "
            "click on a heading sorts.",
        )
    )
    blocks += [Paragraph("What this comparison does not tell:"), Bullets(unknowns(comparison))]
    return Section("verdict", "Verdict", tuple(blocks))
