"""Section of the velocity profiles at the named instants."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from cases.arrays import Floats
from cases.fields import FIELDS
from reports.blocks import Figure, Interactive, Subsection
from reports.figures.curves import small_multiples
from reports.figures.panels import Curves, PanelRow
from reports.result.load import Comparison
from reports.result.metrics import Metrics
from reports.sections.declaration import Blocks, declared, instants
from reports.sections.parts.cells import chunks
from reports.sections.parts.page_data import both_models
from reports.sections.parts.stated import anywhere, stated_variants
from reports.wording.csv_text import comma_separated
from reports.wording.numbers import SPACE, fixed, listed, signed, span, with_unit
from reports.wording.words import column_heading, instant, row_heading, spot, top_to_bottom

_FIELD = FIELDS["axial_velocity"]


@dataclass(frozen=True)
class _Line:
    """Both models' profiles at one instant along one row j: SI, (i, y)."""

    label: str
    t_s: float
    j: int
    reference: Floats
    rom: Floats


def _line(comparison: Comparison, variant: str, state: int, j: int, label: str) -> _Line:
    data = comparison.profiles.sel(variant=variant).isel(
        time=comparison.states[state], phi=comparison.j.index(j)
    )
    reference, rom = (data[f"{m}_axial_velocity"].values.astype(float) for m in ("reference", "rom"))
    return _Line(label, comparison.times[state][1], j, reference, rom)


def _exponents(metrics: Metrics, variant: str, i: int, line: _Line) -> str:
    row = metrics.find(variant, "profile_exponent", "value", i, line.j, line.t_s)
    return f"γ 3D {fixed(row.reference, 2)}\nγ 2D {fixed(row.rom, 2)}" if row else ""


def _panel_row(comparison: Comparison, variant: str, line: _Line, columns: Sequence[int]) -> PanelRow:
    factor = _FIELD.display_factor
    return PanelRow(
        quantity=f"$v_x$ ({_FIELD.display_unit})",
        label=line.label,
        panels=tuple(
            Curves(
                factor * line.reference[k],
                factor * line.rom[k],
                _exponents(comparison.metrics, variant, i, line),
                comparison.calcified(variant, i, line.j),
            )
            for i in columns
            for k in (comparison.i.index(i),)
        ),
    )


def _farthest(comparison: Comparison, lines: Sequence[_Line]) -> str:
    differences = np.stack([line.rom - line.reference for line in lines])
    row, column, ray = np.unravel_index(int(np.abs(differences).argmax()), differences.shape)
    y = float(comparison.profiles["y"].values[ray])
    value = with_unit(
        signed(float(differences[row, column, ray]) * _FIELD.display_factor), _FIELD.display_unit
    )
    line = lines[int(row)]
    return (
        f"the models are farthest apart, 2D − 3D = {value}, at r/R{SPACE}={SPACE}{y:.2f} "
        f"({spot(comparison.i[int(column)], line.j, line.t_s)})"
    )


def _spans(comparison: Comparison, variant: str, lines: Sequence[_Line]) -> str:
    """Say between what exponents the shown cells are in each model."""
    found = [
        row
        for line in lines
        for i in comparison.i
        if (row := comparison.metrics.find(variant, "profile_exponent", "value", i, line.j, line.t_s))
    ]
    said = [
        f"{span(min(values), max(values), 2)} in {name}"
        for name, values in (
            ("3D", [row.reference for row in found if row.reference is not None]),
            ("2D", [row.rom for row in found if row.rom is not None]),
        )
        if values
    ]
    return " and ".join(said) or "not scored here"


def _figures(
    comparison: Comparison, variant: str, key: str, when: str, lines: Sequence[_Line]
) -> tuple[Figure, ...]:
    farthest = _farthest(comparison, lines)
    spans = _spans(comparison, variant, lines)
    figures = []
    for columns in chunks(comparison.i):
        rows = dict.fromkeys(line.j for line in lines)
        cells = f"cells i = {listed(columns)}, j = {listed(rows)}"
        figures.append(
            Figure(
                key=f"{key}-{columns[0]}",
                caption=f"Variant {variant}, {when}: axial velocity along the ray from the axis "
                f"(r/R{SPACE}={SPACE}0) to the wall (r/R{SPACE}={SPACE}1) at {cells}; 3D as points, 2D as a "
                f"line. What to see: where the line runs below the points, 2D is too slow; {farthest}. "
                "γ, the exponent of the 2D model's profile and of the profile closest to 3D (2 is a "
                f"parabola, more is flatter), is {spans}.",
                alt=f"Velocity profiles of 3D and 2D, variant {variant}, {when}, a panel for each of "
                f"{cells}; {farthest}.",
                drawing=partial(
                    small_multiples,
                    comparison.profiles["y"].values.astype(float),
                    "r/R (–)",
                    [column_heading(comparison, i) for i in columns],
                    [_panel_row(comparison, variant, line, columns) for line in lines],
                    from_zero=True,
                ),
                csv=_csv(comparison, lines, columns),
            )
        )
    return tuple(figures)


def _csv(comparison: Comparison, lines: Sequence[_Line], columns: Sequence[int]) -> str:
    rows = [
        (line.t_s, i, line.j, float(y), line.reference[k, ray], line.rom[k, ray])
        for line in lines
        for i in columns
        for k in (comparison.i.index(i),)
        for ray, y in enumerate(comparison.profiles["y"].values)
    ]
    return comma_separated(("t_s", "i", "j", "r_over_R", "reference_v_x_m_s", "rom_v_x_m_s"), rows)


def _variant(comparison: Comparison, number: int, variant: str) -> Subsection:
    key = f"profiles-{number}"
    rows = comparison.rows_of(variant)
    states = range(len(comparison.times))
    if len(rows) == 1:
        lines = [
            _line(comparison, variant, k, rows[0], f"t = {comparison.times[k][1]:.3f} s") for k in states
        ]
        when = top_to_bottom(comparison.times)
        return Subsection(key, f"Variant {variant}", _figures(comparison, variant, f"{key}-all", when, lines))
    figures: tuple[Figure, ...] = ()
    for k in states:
        lines = [_line(comparison, variant, k, j, row_heading(comparison, j)) for j in rows]
        figures += _figures(comparison, variant, f"{key}-{k + 1}", instant(*comparison.times[k]), lines)
    return Subsection(key, f"Variant {variant}", figures)


@declared("profiles", "Velocity profiles", instants("profiles"))
def section(comparison: Comparison) -> Blocks:
    """Return the profiles of each variant whose reference states them."""
    stated = comparison.profiles["reference_axial_velocity"]
    shown, told = stated_variants(
        comparison, lambda name: anywhere(stated.sel(variant=name).values), "velocity profiles"
    )
    if not shown:
        return told
    return (
        Interactive(
            "profiles-anytime",
            "profiles",
            "The profile at any time",
            "Choose a variant and a cell, move the time slider or let it play; point at the curves for "
            "their values.",
            {"profiles": both_models(comparison, _FIELD, comparison.profiles)},
        ),
        *told,
        *(_variant(comparison, k, name) for k, name in shown),
    )
