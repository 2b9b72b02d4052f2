"""How the error of the closest profile depends on its exponent γ, at the shown cells."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from reports.blocks import Figure
from reports.cells import chunks
from reports.figures import REFERENCE_COLOUR, ROM_COLOUR, small_multiples
from reports.fit_errors import Array, fit_errors
from reports.load import Comparison
from reports.numbers import SPACE, fixed, listed, percent, unsigned
from reports.panels import Curves, PanelRow
from reports.tabular import comma_separated
from reports.words import column_heading, instant, row_heading, spot, top_to_bottom

_LOW, _HIGH, _MOST = 1.0, 6.0, 30.0  # exponents of the curves: a cusp, a blunt profile, nearly plug flow
_COUNT = 101


@dataclass(frozen=True)
class _Line:
    """Along one row j at one instant: error (i, γ) of a profile, exponents (i) of 3D and 2D."""

    label: str
    t_s: float
    j: int
    errors: Array
    reference: Array
    rom: Array


def _line(comparison: Comparison, variant: str, named: int, j: int, label: str, exponents: Array) -> _Line:
    at = {"time": comparison.states[named], "phi": comparison.j.index(j)}
    profiles = comparison.profiles["reference_axial_velocity"].sel(variant=variant).isel(at)
    cells = comparison.curves.sel(variant=variant).isel(time=comparison.states[named], phi=j - 1)
    both = (cells[f"{model}_profile_exponent"].values.astype(float) for model in ("reference", "rom"))
    y = comparison.profiles["y"].values.astype(float)
    errors = fit_errors(profiles.values.astype(float), y, exponents)
    return _Line(label, comparison.times[named][1], j, errors, *both)


def _lines(comparison: Comparison, variant: str, exponents: Array) -> list[_Line]:
    """All instants where one row stands for all, else all rows at the first instant."""
    rows = comparison.rows_of(variant)
    if len(rows) == 1:
        return [
            _line(comparison, variant, k, rows[0], f"t = {t_s:.3f} s", exponents)
            for k, (_, t_s) in enumerate(comparison.times)
        ]
    return [_line(comparison, variant, 0, j, row_heading(comparison, j), exponents) for j in rows]


def _panel(comparison: Comparison, variant: str, line: _Line, i: int, exponents: Array) -> Curves:
    k = comparison.i.index(i)
    marked = ((float(line.reference[k]), REFERENCE_COLOUR), (float(line.rom[k]), ROM_COLOUR))
    return Curves(
        100 * line.errors[k],
        np.empty(0),
        f"γ 3D {fixed(float(line.reference[k]), 2)}\nγ 2D {fixed(float(line.rom[k]), 2)}",
        comparison.calcified(variant, i, line.j),
        tuple(entry for entry in marked if exponents[0] <= entry[0] <= exponents[-1]),
    )


def _price(comparison: Comparison, lines: Sequence[_Line], exponents: Array) -> str:
    """Say where the 2D exponent costs most against the best possible one."""
    worst, said = -1.0, ""
    for line in lines:
        for k, i in enumerate(comparison.i):
            own = float(np.interp(line.rom[k], exponents, line.errors[k]))
            best = float(line.errors[k].min())
            if np.isfinite(own) and own - best > worst:
                worst = own - best
                said = (
                    f"the 2D exponent costs most at {spot(i, line.j, line.t_s)}: an error of "
                    f"{unsigned(percent(own))} where {unsigned(percent(best))} is possible"
                )
    return said or "no error could be computed"


def figures(comparison: Comparison, variant: str, key: str) -> tuple[Figure, ...]:
    """Draw error(γ) of one variant at the shown cells."""
    values = comparison.curves[["reference_profile_exponent", "rom_profile_exponent"]].sel(variant=variant)
    largest = max(
        float(np.where(np.isfinite(v), v, 0.0).max()) for v in (values[name].values for name in values)
    )
    exponents = np.linspace(_LOW, min(max(_HIGH, 1.1 * largest), _MOST), _COUNT)
    lines = _lines(comparison, variant, exponents)
    price = _price(comparison, lines, exponents)
    several_rows = len(comparison.rows_of(variant)) > 1
    when = instant(*comparison.times[0]) if several_rows else top_to_bottom(comparison.times)
    return tuple(
        Figure(
            key=f"{key}-{columns[0]}",
            caption=f"Variant {variant}, {when}: relative error of the profile with exponent γ against 3D "
            f"at cells i{SPACE}={SPACE}{listed(columns)}, j{SPACE}={SPACE}"
            f"{listed(dict.fromkeys(line.j for line in lines))}. Black dashes: the closest γ; blue dashes: "
            f"that of 2D. What to see: in a deep, narrow trough 3D has one clear γ, in a flat one many do as "
            f"well; {price}.",
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
