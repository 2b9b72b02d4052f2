"""Section of the agreement of 2D and 3D over all cells and states: parity, and Bland and Altman."""

from functools import partial

import numpy as np

from cases.arrays import Floats
from cases.fields import FIELDS
from reports.blocks import Figure
from reports.figures.agreement import Agreement, agreement
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared
from reports.sections.parts.limits import limit_of
from reports.sections.parts.models import columns_of, headed
from reports.wording.csv_text import comma_separated
from reports.wording.numbers import SPACE, fixed, listed, plus

_QUANTITIES = {"radius": "$R$", "section_flow_rate": "$q$", "pressure": "$P$"}
_MOST = 2  # quantities, those that limits judge first


def _values(view: Comparison, model: str, quantity: str, variant: str) -> Floats:
    return FIELDS[quantity].display_factor * view.array(f"{model}_{quantity}", variant)


def _row(view: Comparison, quantity: str) -> Agreement:
    limit = limit_of(view, quantity)
    return Agreement(
        _QUANTITIES[quantity],
        FIELDS[quantity].display_unit,
        tuple(_values(view, "reference", quantity, name) for name in view.variants),
        tuple(_values(view, "rom", quantity, name) for name in view.variants),
        None if limit is None else 100 * limit,
    )


def _spread(row: Agreement, variants: tuple[str, ...]) -> list[tuple[str, float, float]]:
    """Bias and 1.96 standard deviations of the difference in percent of 3D, of each variant."""
    found = []
    for name, three, two in zip(variants, row.reference, row.model, strict=True):
        with np.errstate(divide="ignore", invalid="ignore"):
            apart = 100 * (two - three) / np.abs(three)
        known = apart[np.isfinite(apart)]
        if known.size:
            found.append((name, float(known.mean()), 1.96 * float(known.std())))
    return found


def _figure(comparison: Comparison, model: str, quantities: list[str]) -> Figure:
    view = comparison.of(model)
    rows = [_row(view, quantity) for quantity in quantities]
    spreads = {q: _spread(row, comparison.variants) for q, row in zip(quantities, rows, strict=True)}
    said = "; ".join(
        f"{FIELDS[quantity].label} "
        + listed(
            f"{name} {plus(fixed(bias, 1))}{SPACE}±{SPACE}{fixed(spread, 1)}{SPACE}%"
            for name, bias, spread in of
        )
        for quantity, of in spreads.items()
    )
    named = headed(comparison, model)
    return Figure(
        f"agreement-{model}",
        f"Agreement of {named} with 3D over all cells and states: parity above, the difference in percent "
        f"of 3D over the mean of both below (after Bland and Altman 1986) with bias and ±{SPACE}1.96 "
        f"standard deviations: {said}.",
        f"Two-dimensional histograms of {named} over 3D and of their difference in percent of 3D over their "
        f"mean for {listed(comparison.variants)}: {said}.",
        partial(agreement, columns_of(comparison, comparison.variants), rows, named),
        comma_separated(
            ("quantity", "variant", "bias_percent", "spread_percent"),
            [(quantity, *each) for quantity, of in spreads.items() for each in of],
        ),
    )


@declared("agreement", "Agreement over all cells and states", lambda comparison: not comparison.sparse)
def section(comparison: Comparison) -> Blocks:
    """Return a figure a model of the quantities that limits judge, or of the first ones."""
    judged = [name for name in _QUANTITIES if limit_of(comparison, name) is not None]
    shown = [*judged, *(name for name in _QUANTITIES if name not in judged)][:_MOST]
    return tuple(_figure(comparison, model, shown) for model in comparison.models)
