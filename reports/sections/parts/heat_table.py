"""Errors over their limits, quantity by quantity and pattern by pattern, and what nothing judges."""

from collections.abc import Iterator

from cases.fields import FIELDS
from cases.quantities import of_cycle, pooled
from cases.results.metric_row import MetricRow
from reports.blocks import Column, Shade, Table
from reports.result.load import Comparison
from reports.sections.parts import trust
from reports.sections.parts.error_budget import budget
from reports.sections.parts.models import headed
from reports.wording.numbers import ABSENT, rounded, share
from reports.wording.words import limit, quantity_words, statistic_words

_FAR = 2.0  # times the limit
_FEW = 3  # bands of which each is told what it owes to inflow and mesh; of more, those that fail
_OF_FIELDS, _OF_CYCLE = 1, 1  # quantities that nothing judges: so many, those with the largest errors
_SHARES = {"matched": "with the inflow of 3D", "mesh": "uncertainty of the 3D mesh"}
Line = tuple[list[str], dict[int, Shade]]
Place = tuple[str, str]  # variant and model


def heat_table(comparison: Comparison) -> Table | None:
    """Return the table: a line a quantity, a column a variant and model; None where nothing was scored."""
    places = [(variant, model) for variant in comparison.variants for model in comparison.models]
    lines = [*_judged(comparison, places), *_unjudged(comparison, places)]
    if not lines:
        return None
    return Table(
        "answer-table",
        "Error over its limit (above 1 is beyond it); below it, over the same limit, the error with the "
        "inflow of 3D and what the 3D mesh leaves open; in grey the largest errors that no limit judges.",
        (
            Column("quantity", "prose"),
            *(Column(headed(comparison, model), "number", variant) for variant, model in places),
        ),
        tuple(tuple(texts) for texts, _ in lines),
        shades={
            (k, column): shade for k, (_, shades) in enumerate(lines) for column, shade in shades.items()
        },
    )


def _judged(comparison: Comparison, places: list[Place]) -> Iterator[Line]:
    """A line a band, below it what of its error is owed to others."""
    bands = dict.fromkeys(
        (row.quantity, row.statistic, row.band)
        for model in comparison.models
        for row in comparison.of(model).metrics.bands()
    )
    for band in bands:
        rows = [_band(comparison, place, band) for place in places]
        some = next(row for row in rows if row is not None)
        words = f"{quantity_words(some.quantity)}, {statistic_words(some.statistic)} (limit {limit(some)})"
        shades = {k: _shade(comparison, row) for k, row in enumerate(rows, start=1) if row is not None}
        yield [words, *(_over(row) for row in rows)], shades
        failing = any(row is not None and row.status != "OK" for row in rows)
        if some.statistic == "rms_error" and (len(bands) <= _FEW or failing):
            yield from _owed(comparison, places, rows)


def _band(comparison: Comparison, place: Place, band: tuple[str, str, float | None]) -> MetricRow | None:
    variant, model = place
    for row in comparison.of(model).metrics.bands():
        if (row.quantity, row.statistic, row.band) == band and row.variant == variant:
            return row
    return None


def _over(row: MetricRow | None) -> str:
    """Error over its limit with as many digits as it takes to tell it from 1."""
    if row is None or row.error is None:
        return ABSENT
    texts = (rounded(row.ratio, digits) for digits in range(3, 8))
    return next((text for text in texts if text.rstrip("0") != "1."), rounded(row.ratio, 3))


def _shade(comparison: Comparison, row: MetricRow) -> Shade:
    if row.error is None or trust.not_periodic(comparison, row.variant):
        return "unjudged"
    if row.status == "OK":
        return "within"
    return "beyond" if row.ratio <= _FAR else "far"


def _owed(comparison: Comparison, places: list[Place], rows: list[MetricRow | None]) -> Iterator[Line]:
    """Lines of the error with 3D's own inflow and of the 3D mesh, over the limit."""
    found = [
        None if row is None else budget(comparison.of(model), variant, row.quantity)
        for (variant, model), row in zip(places, rows, strict=True)
    ]
    for part, words in _SHARES.items():
        texts = [_over_limit(None if b is None else b[part], row) for b, row in zip(found, rows, strict=True)]
        if any(text != ABSENT for text in texts):
            yield [f"\u2003{words}", *texts], dict.fromkeys(range(1, len(texts) + 1), "unjudged")


def _over_limit(part: float | None, row: MetricRow | None) -> str:
    return ABSENT if part is None or row is None or not row.band else rounded(part / row.band, 2)


def _unjudged(comparison: Comparison, places: list[Place]) -> Iterator[Line]:
    """Lines of quantities that no band judges of some variant, those with the largest errors first."""
    fields = [name for name in pooled() if "y" not in FIELDS[name].dims]
    cycle = [name for name in of_cycle() if FIELDS[name].unit != "s"]
    for names, statistic, most in ((fields, "rms_error", _OF_FIELDS), (cycle, "cycle", _OF_CYCLE)):
        found = {name: [_error(comparison, place, name, statistic) for place in places] for name in names}
        sized = {
            name: max((abs(e) for e in errors if e is not None), default=0.0)
            for name, errors in found.items()
        }
        for name in sorted((name for name in names if sized[name] > 0), key=lambda n: -sized[n])[:most]:
            texts = [ABSENT if error is None else share(error) for error in found[name]]
            words = f"{quantity_words(name)}, not judged"
            yield [words, *texts], dict.fromkeys(range(len(texts) + 1), "unjudged")


def _error(comparison: Comparison, place: Place, quantity: str, statistic: str) -> float | None:
    """Error of a quantity; None where a band judges it, or it is not known."""
    variant, model = place
    metrics = comparison.of(model).metrics
    judged = any((row.variant, row.quantity) == (variant, quantity) for row in metrics.bands())
    row = None if judged else metrics.find(variant, quantity, statistic)
    return None if row is None else row.error
