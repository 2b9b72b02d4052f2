"""Values that the reference states: tables give single ones, a simulation gives fields."""

from collections.abc import Callable, Iterable

import numpy as np

from cases.arrays import Floats
from reports.blocks import Paragraph
from reports.result.load import Comparison
from reports.wording.numbers import listed

_MOSTLY = 0.5  # of the cells: a map of fewer is a grey area with specks


def anywhere(values: Floats) -> bool:
    """Whether a reference has any value here; NaN is what it does not state."""
    return not bool(np.isnan(values).all())


def mostly(values: Floats) -> bool:
    """Whether a reference has values in most cells, so that a map of them can be read."""
    return bool(np.isnan(values).mean() <= 1 - _MOSTLY)


def stated_variants(
    comparison: Comparison, holds: Callable[[str], bool], what: str
) -> tuple[list[tuple[int, str]], tuple[Paragraph, ...]]:
    """Number and name of the variants of which the reference states `what`; a line on the others, if any."""
    shown = [(k, name) for k, name in enumerate(comparison.variants, start=1) if holds(name)]
    line = left_out(comparison, [name for _, name in shown], what)
    return shown, (Paragraph(line),) if line else ()


def left_out(comparison: Comparison, shown: Iterable[str], what: str) -> str:
    """Say in a line of which variants the reference states no `what`; "" where it does of all."""
    without = [name for name in comparison.variants if name not in set(shown)]
    if not without:
        return ""
    if len(without) == len(comparison.variants):
        return f"The reference states no {what}: there is nothing to draw."
    return f"Of {listed(without)} the reference states no {what}: there is nothing to draw."
