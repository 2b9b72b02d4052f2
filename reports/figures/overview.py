"""All variants at a glance: a column a variant, a row a quantity over the cycle, its error below."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib import style
from matplotlib.axes import Axes

from cases.arrays import Floats
from reports.figures import sheet
from reports.figures.canvas import STYLE, WIDTH, svg_text
from reports.figures.colours import CALCIFIED, LIMIT, QUIET

_LEFT, _RIGHT, _TOP, _BOTTOM = 0.66, 0.10, 0.46, 0.38
_CURVES, _ERRORS, _NARROW, _WIDE = 0.92, 0.40, 0.07, 0.20  # inches: heights, and gaps below each


@dataclass(frozen=True)
class Cycle:
    """One quantity of one variant at one place over the cycle, in display units.

    Attributes
    ----------
    reference : ndarray, shape (time,)
        3D; NaN is not stated.
    models : tuple of ndarray, each of shape (time,)
        The reduced models.
    calcified : bool
        Whether the place is in the calcification; the panel is then tinted.
    """

    reference: Floats
    models: tuple[Floats, ...]
    calcified: bool = False


@dataclass(frozen=True)
class OverviewRow:
    """One quantity of all variants.

    Attributes
    ----------
    label : str
        Symbol and unit, as in ``"$P$ (kPa)"``.
    limit : float, optional
        Of the error's size, in percent; None where nothing judges it.
    panels : tuple of Cycle
        One a variant.
    """

    label: str
    limit: float | None
    panels: tuple[Cycle, ...]


def overview(
    time: Floats,
    variants: Sequence[str],
    rows: Sequence[OverviewRow],
    models: Sequence[str],
    reference: str = "3D",
    marks: Sequence[float] = (),
) -> str:
    """Draw rows × variants panels, each row with one scale, and the errors in percent below each.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Into the cycle (s).
    variants, models : sequence of str
        Headings of the columns, and names of the reduced models.
    rows : sequence of OverviewRow
        From top to bottom.
    reference : str
        Name of the reference.
    marks : sequence of float
        Named instants (s).

    Returns
    -------
    str
        SVG; the same text for the same input.
    """
    with style.context(STYLE):
        block = _CURVES + _NARROW + _ERRORS + _WIDE
        total = _TOP + block * len(rows) - _WIDE + _BOTTOM
        figure, axis = sheet.sheet(total)
        x = (min(0.0, float(time.min())), float(time.max()))
        span = (_LEFT, WIDTH - _RIGHT)
        abscissa = [time] * len(variants)
        top = total - _TOP
        for number, row in enumerate(rows):
            bottom = top - _CURVES
            known = [v for p in row.panels for v in (p.reference, *p.models)]
            upper = sheet.in_a_row(len(variants), (bottom, _CURVES), span, x, sheet.limits(known))
            errors = [[_percent(m, p.reference) for m in p.models] for p in row.panels]
            place = (bottom - _NARROW - _ERRORS, _ERRORS)
            lower = sheet.in_a_row(len(variants), place, span, x, _error_limits(errors, row.limit))
            if number == 0:
                sheet.headings(axis, upper, variants)
            inside = [p for p, cycle in zip(upper, row.panels, strict=True) if cycle.calcified]
            sheet.band(axis, inside, *upper[0].y, CALCIFIED)
            sheet.ordinates(axis, upper, row.label, 4)
            sheet.model_curves(axis, upper, abscissa, _by_model([p.models for p in row.panels]))
            sheet.reference_points(axis, upper, abscissa, [p.reference for p in row.panels])
            if row.limit is not None:
                sheet.band(axis, lower, -row.limit, row.limit, LIMIT)
            sheet.ordinates(axis, lower, _error_label(row.limit), 2, grid=False)
            sheet.across_panels(axis, lower, [0.0], color=QUIET, linewidth=0.5)
            sheet.model_curves(axis, lower, abscissa, _by_model(errors))
            sheet.frames(axis, [*upper, *lower])
            sheet.up_panels(axis, [*upper, *lower], [m for m in marks if x[0] <= m <= x[1]])
            top -= block
        sheet.abscissas(axis, lower, "time into the cycle (s)")
        _legend(axis, rows, models, reference, bool(marks), total - 0.12)
        return svg_text(figure)


def _percent(model: Floats, reference: Floats) -> Floats:
    with np.errstate(divide="ignore", invalid="ignore"):
        error = 100 * (model / reference - 1)
    return np.asarray(np.where(np.isfinite(error), error, np.nan))


def _by_model(panels: Sequence[Sequence[Floats]]) -> list[list[Floats]]:
    return [list(curves) for curves in zip(*panels, strict=True)]


def _error_limits(errors: Sequence[Sequence[Floats]], limit: float | None) -> tuple[float, float]:
    """Limits that show zero, all errors and the band."""
    shown = np.array([0.0] if limit is None else [-limit, limit])
    return sheet.limits([shown, *(e for panel in errors for e in panel)], 0.1)


def _error_label(limit: float | None) -> str:
    return "error (%)\nno limit" if limit is None else f"error (%)\nlimit ±{limit:g}"


def _legend(
    axis: Axes, rows: Sequence[OverviewRow], models: Sequence[str], reference: str, marked: bool, up: float
) -> None:
    keys = list(sheet.models_keys(reference, models))
    if marked:
        keys.append(sheet.Key("named times", dashes=(0, (1.0, 1.6))))
    if any(row.limit is not None for row in rows):
        keys.append(sheet.Key("within the limit", fill=LIMIT))
    if any(panel.calcified for row in rows for panel in row.panels):
        keys.append(sheet.Key("in the calcification", fill=CALCIFIED))
    sheet.legend(axis, keys, _LEFT, up)
