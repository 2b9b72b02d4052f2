"""Error of the closest profile over its exponent γ, at the shown cells."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from cases.arrays import Flags, Floats
from cases.results.metric_row import MetricRow
from reports.blocks import Figure
from reports.figures.curves import REFERENCE_COLOUR, ROM_COLOUR, small_multiples
from reports.figures.panels import Curves, PanelRow
from reports.result.load import Comparison
from reports.sections.parts.cells import chunks
from reports.wording.csv_text import comma_separated
from reports.wording.numbers import SPACE, fixed, listed, percent, unsigned
from reports.wording.words import column_heading, instant, place, row_heading, top_to_bottom

_LOW, _HIGH, _MOST = 1.0, 6.0, 30.0  # exponents of the curves: a cusp, a blunt profile, nearly plug flow


@dataclass(frozen=True)
class _Line:
    """Along one row j at one instant: error (i, γ) of a profile, exponents (i) of 3D and 2D."""

    label: str
    t_s: float
    j: int
    errors: Floats
    reference: Floats
    rom: Floats


def _line(comparison: Comparison, variant: str, named: int, j: int, label: str, drawn: Flags) -> _Line:
    curves = comparison.error_curves.sel(variant=variant).isel(
        compare_time=named, compare_phi=comparison.j.index(j)
    )
    cells = comparison.curves.sel(variant=variant).isel(time=comparison.states[named], phi=j - 1)
    both = (cells[f"{model}_profile_exponent"].values.astype(float) for model in ("reference", "rom"))
    return _Line(label, comparison.times[named][1], j, curves.values[:, drawn], *both)


def _lines(comparison: Comparison, variant: str, drawn: Flags) -> list[_Line]:
    """All instants where one row stands for all, else all rows at the first instant."""
    rows = comparison.rows_of(variant)
    if len(rows) == 1:
        return [
            _line(comparison, variant, k, rows[0], f"t = {t_s:.3f} s", drawn)
            for k, (_, t_s) in enumerate(comparison.times)
        ]
    return [_line(comparison, variant, 0, j, row_heading(comparison, j), drawn) for j in rows]


def _panel(comparison: Comparison, variant: str, line: _Line, i: int, exponents: Floats) -> Curves:
    k = comparison.i.index(i)
    marked = ((float(line.reference[k]), REFERENCE_COLOUR), (float(line.rom[k]), ROM_COLOUR))
    return Curves(
        100 * line.errors[k],
        np.empty(0),
        f"γ 3D {fixed(float(line.reference[k]), 2)}\nγ 2D {fixed(float(line.rom[k]), 2)}",
        comparison.calcified(variant, i, line.j),
        tuple(entry for entry in marked if exponents[0] <= entry[0] <= exponents[-1]),
    )


def _price(comparison: Comparison, variant: str, lines: Sequence[_Line]) -> str:
    """Say how small the error can be at the shown cells, and where the 2D exponent costs most."""
    found = [
        row
        for line in lines
        for i in comparison.i
        if (row := comparison.metrics.find(variant, "profile_error", "value", i, line.j, line.t_s))
    ]
    best = [row.reference for row in found if row.reference is not None]
    if not best:
        return "no error was scored at these cells"
    said = f"at its closest γ the profile is off 3D by {_size(min(best))} to {_size(max(best))}"
    both = [row for row in found if row.rom is not None and row.reference is not None]
    if not both:
        return said
    worst = max(both, key=_cost)
    return (
        f"{said}; the 2D exponent costs most at {place(worst)}: an error of {_size(worst.rom)} where "
        f"{_size(worst.reference)} is possible"
    )


def _cost(row: MetricRow) -> float:
    return (row.rom or 0.0) - (row.reference or 0.0)


def _size(error: float | None) -> str:
    return unsigned(percent(error))


def _drawn(comparison: Comparison, variant: str) -> Flags:
    """Which of the stored exponents are drawn: up to the largest of both models, within reason."""
    values = comparison.curves.sel(variant=variant)
    both = np.concatenate(
        [values[f"{model}_profile_exponent"].values.ravel() for model in ("reference", "rom")]
    )
    largest = float(both[np.isfinite(both)].max(initial=0.0))
    exponents = comparison.error_curves["exponent"].values
    return np.asarray((exponents >= _LOW) & (exponents <= min(max(_HIGH, 1.1 * largest), _MOST)))


def figures(comparison: Comparison, variant: str, key: str) -> tuple[Figure, ...]:
    """Draw error(γ) of one variant at the shown cells."""
    drawn = _drawn(comparison, variant)
    exponents = comparison.error_curves["exponent"].values[drawn]
    lines = _lines(comparison, variant, drawn)
    price = _price(comparison, variant, lines)
    several_rows = len(comparison.rows_of(variant)) > 1
    when = instant(*comparison.times[0]) if several_rows else top_to_bottom(comparison.times)
    return tuple(
        Figure(
            key=f"{key}-{columns[0]}",
            caption=f"Variant {variant}, {when}: relative error of the profile with exponent γ against 3D "
            f"at cells i{SPACE}={SPACE}{listed(columns)}, j{SPACE}={SPACE}"
            f"{listed(dict.fromkeys(line.j for line in lines))}. Black dashes: the closest γ; blue dashes: "
            f"that of 2D. What to see: {price}. In a deep, narrow trough 3D has one clear γ; in a flat one "
            "many do as well.",
            alt=f"Curves of the error over γ, variant {variant}, {when}, with the closest γ and that of "
            f"2D marked; {price}.",
            drawing=partial(
                small_multiples,
                exponents,
                "exponent γ (–)",
                [column_heading(comparison, i) for i in columns],
                [
                    PanelRow(
                        "error (%)",
                        line.label,
                        tuple(_panel(comparison, variant, line, i, exponents) for i in columns),
                    )
                    for line in lines
                ],
                from_zero=True,
                names=("error against 3D", "γ of 2D"),
            ),
            csv=comma_separated(
                ("t_s", "i", "j", "gamma", "relative_error"),
                (
                    (line.t_s, i, line.j, float(gamma), float(error))
                    for line in lines
                    for i in columns
                    for gamma, error in zip(exponents, line.errors[comparison.i.index(i)], strict=True)
                ),
                6,
            ),
        )
        for columns in chunks(comparison.i)
    )
