"""Section on the assumptions checked: whether 3D allows what the 2D model assumes."""

from collections.abc import Callable, Iterator

from cases.results.metric_row import MetricRow
from cases.statistics import BUDGET, PLACED
from reports.blocks import Column, Table, numbers, prose
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared, of_each_model
from reports.sections.dominance import AZIMUTHAL, RADIAL, RATIOS, largest_inside, ratio
from reports.sections.parts.models import headed
from reports.sections.parts.places import row_place
from reports.wording.numbers import ABSENT, percent, rounded, share, with_unit
from reports.wording.words import field_of, quantity_words, statistic_words

_BY_CELL_AND_STATE = ("plane_integral", "prescribed_inflow")
_WITH_TABLES = ("bias_low", "bias_high", "change_rms", "cost")  # statistics that have tables of their own


def further_figures(comparison: Comparison, placed: frozenset[str]) -> Table | None:
    """Return the rows of other statistics, and the largest values of quantities that are not `placed`."""
    rows = tuple(
        _further(comparison, row)
        for row in comparison.metrics.rows
        if not row.status
        and not row.inflow
        and row.statistic not in (*PLACED, *BUDGET)
        and row.statistic not in (*_BY_CELL_AND_STATE, *_WITH_TABLES)
        and (row.statistic != "largest" or row.quantity not in placed)
        and (row.i is None or row.statistic == "largest")
        and (row.reference is not None or row.error is not None)
    )
    if not rows:
        return None
    return Table(
        "further",
        "Further figures of the whole artery and cycle; metrics.csv holds all there are.",
        (Column("variant"), *prose("quantity", "statistic"), *numbers("3D", "2D", "error"), Column("at")),
        rows,
        rule_by=0,
    )


def _further(comparison: Comparison, row: MetricRow) -> tuple[str, ...]:
    field = field_of(row.quantity, row.unit)
    shown = field if row.unit == field.unit else field_of("", row.unit)  # a ratio has no unit

    def value(number: float | None) -> str:
        text = rounded(None if number is None else number * shown.display_factor)
        return with_unit(text, shown.display_unit)

    texts = (quantity_words(row.quantity), statistic_words(row.statistic), value(row.reference))
    return (row.variant, *texts, value(row.rom), percent(row.error), row_place(comparison, row) or ABSENT)


_PLACED = frozenset({*RATIOS, "axis_velocity_spread", "mass_defect", "backflow_fraction"})

Figures = Callable[[Comparison, str], tuple[str, str]]


def _largest(quantity: str, words: Callable[[float | None], str] = share) -> Figures:
    def figures(comparison: Comparison, variant: str) -> tuple[str, str]:
        three = comparison.metrics.largest_row(variant, quantity, "reference")
        two = comparison.metrics.largest_row(variant, quantity, "rom")
        return words(three.reference if three else None), words(two.rom if two else None)

    return figures


def _dominance(quantity: str) -> Figures:
    """Of 3D before the outlet's cells, which its condition makes."""
    of_all = _largest(quantity, ratio)

    def figures(comparison: Comparison, variant: str) -> tuple[str, str]:
        three, two = of_all(comparison, variant)
        inside = largest_inside(comparison, quantity, variant)
        return three if inside is None else ratio(inside[0]), two

    return figures


def _pressure_range(comparison: Comparison, variant: str) -> tuple[str, str]:
    ranges = comparison.pressure_range_over_section.sel(variant=variant)
    three, two = (float(ranges[f"{model}_pressure"]) for model in ("reference", "rom"))
    return with_unit(rounded(three, 3), "Pa"), with_unit(rounded(two, 3), "Pa")


_ASSUMPTIONS: tuple[tuple[str, str, Figures], ...] = (
    (
        "one axial velocity on the axis",
        "spread over φ of v_x on the axis, over its mean",
        _largest("axis_velocity_spread"),
    ),
    ("mass is conserved", "inflow − outflow − change of volume, over the inflow", _largest("mass_defect")),
    ("the blood flows forward", "share of points off the wall with v_x ≤ 0", _largest("backflow_fraction")),
    ("no radial velocity", "|v_r|/v_x", _dominance(RADIAL)),
    ("no azimuthal velocity", "|v_φ|/v_x", _dominance(AZIMUTHAL)),
    (
        "the pressure is uniform over a section",
        "range over φ of the pressure that is averaged along each ray",
        _pressure_range,
    ),
)


@declared("assumptions", "Assumptions checked")
def section(comparison: Comparison) -> Blocks:
    """Return what the 2D model assumes with the figures of all models."""
    sides = ("3D", *comparison.models)
    return (
        Table(
            "assumption-figures",
            "What the 2D model assumes of the flow, and how far each model is from it: the largest "
            "figures over the artery and the cycle, of ratios in 3D before the outlet's cells. "
            f"{ABSENT}: the model has none by construction, or it "
            "was not measured.",
            (
                *prose("assumption", "measured by"),
                *(
                    Column(side if side == "3D" else headed(comparison, side), "number", name)
                    for name in comparison.variants
                    for side in sides
                ),
            ),
            tuple(
                (title, measure, *_of_sides(comparison, figures)) for title, measure, figures in _ASSUMPTIONS
            ),
        ),
    )


def _of_sides(comparison: Comparison, figures: Figures) -> Iterator[str]:
    """Figures of 3D and of each reduced model, variant by variant."""
    for name in comparison.variants:
        yield figures(comparison, name)[0]
        for model in comparison.models:
            yield figures(comparison.of(model), name)[1]


@declared("further", "Further figures", appendix=True)
@of_each_model
def others(comparison: Comparison) -> Blocks:
    """Return the figures that have no table of their own."""
    table = further_figures(comparison, _PLACED)
    return (table,) if table else ()
