"""The artery unrolled: where each reduced model is within its limits, and where it is not."""

from functools import partial

import numpy as np

from cases.arrays import Floats
from reports.blocks import Figure
from reports.figures.trust_map import TrustRow, inside_words, trust_map
from reports.result.load import Comparison
from reports.sections.parts.limits import over_limit, worst_over_limits
from reports.sections.parts.lumen import cells_table
from reports.sections.parts.models import columns_of, headed
from reports.wording.numbers import SPACE, listed
from reports.wording.words import quantity_words, statistic_words


def _ratios(comparison: Comparison) -> dict[str, list[Floats]] | None:
    """Largest error over its limit in each cell: by model, one array a variant; None if one is unknown."""
    found: dict[str, list[Floats]] = {}
    for model in comparison.models:
        for name in comparison.variants:
            ratio = worst_over_limits(comparison.of(model), name)
            if ratio is None or not np.isfinite(ratio).all():
                return None
            found.setdefault(model, []).append(ratio)
    return found


def _mapped(comparison: Comparison) -> str:
    """Name the bands that have a place in the artery, and say that others have none."""
    of_cells: dict[str, None] = {}
    others = False
    for row in comparison.metrics.bands():
        if over_limit(comparison, row) is None:
            others = True
        else:
            of_cells[f"{statistic_words(row.statistic)} of {quantity_words(row.quantity)}"] = None
    return listed(of_cells) + ("; other limits have no place on it" if others else "")


def trust_figure(comparison: Comparison) -> Figure | None:
    """Return the map of the largest error over its limit, a row of panels a model.

    None unless limits judge fields that the reference states everywhere, around the artery too.
    """
    ratios = _ratios(comparison) if comparison.n_phi > 1 else None
    if ratios is None:
        return None
    fields = comparison.fields
    said = "; ".join(
        f"{name}: {listed(f'{headed(comparison, m)} {inside_words(ratios[m][k])}' for m in ratios)}"
        for k, name in enumerate(comparison.variants)
    ).replace(" %", f"{SPACE}%")
    return Figure(
        "trust-map",
        f"The artery unrolled: in each cell the largest error over its limit ({_mapped(comparison)}), blue "
        f"inside every such limit, orange outside. Share of the wall inside: {said}.",
        f"Maps over x and φ of where each model is within its limits. Share inside: {said}.",
        partial(
            trust_map,
            1e3 * fields["x"].values,
            np.degrees(fields["phi"].values),
            columns_of(comparison, comparison.variants),
            [TrustRow(headed(comparison, model), tuple(maps)) for model, maps in ratios.items()],
            fields["calcified"].values > 0,
        ),
        cells_table(
            comparison,
            {
                f"{name} {model}": values
                for model, maps in ratios.items()
                for name, values in zip(comparison.variants, maps, strict=True)
            },
        ),
    )
