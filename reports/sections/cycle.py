"""Section of pressure, radius and flow over the cycle at the chosen cells."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from cases.arrays import Floats
from cases.fields import FIELDS, Field
from reports.blocks import Block, Figure, Paragraph, Subsection
from reports.figures.curves import small_multiples
from reports.figures.panels import Curves, PanelRow
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared
from reports.sections.parts.cells import chunks
from reports.sections.parts.stated import anywhere, left_out
from reports.wording.csv_text import comma_separated
from reports.wording.numbers import (
    DIFFERENCE_UNITS,
    SPACE,
    fixed,
    listed,
    percent,
    rounded,
    signed,
    unsigned,
    with_unit,
)
from reports.wording.words import column_heading, row_heading, spot

_SYMBOLS = {"pressure": "P", "radius": "R", "sector_flow_rate": "$q_φ$", "section_flow_rate": "q"}


@dataclass(frozen=True)
class _Line:
    """Both models' curves of one quantity along one row j (None: of the whole section), SI, (time, i)."""

    field: Field
    j: int | None
    reference: Floats
    rom: Floats


def _line(comparison: Comparison, variant: str, quantity: str, j: int | None) -> _Line:
    data = comparison.curves.sel(variant=variant)
    if j is not None:
        data = data.isel(phi=j - 1)
    reference, rom = (data[f"{m}_{quantity}"].values.astype(float) for m in ("reference", "rom"))
    return _Line(FIELDS[quantity], j, reference, rom)


def _panel_row(comparison: Comparison, variant: str, line: _Line, columns: Sequence[int]) -> PanelRow:
    field = line.field
    unit, factor = DIFFERENCE_UNITS[field.unit]
    return PanelRow(
        quantity=f"{_SYMBOLS[field.name]} ({field.display_unit})",
        label="section" if line.j is None else row_heading(comparison, line.j),
        panels=tuple(
            Curves(
                field.display_factor * line.reference[:, k],
                field.display_factor * line.rom[:, k],
                calcified=comparison.calcified(variant, i, line.j),
            )
            for i in columns
            for k in (comparison.i.index(i),)
        ),
        difference=f"2D − 3D ({unit})",
        difference_factor=factor / field.display_factor,
    )


def _farthest(comparison: Comparison, line: _Line) -> str:
    """Say where the models differ most."""
    difference = line.rom - line.reference
    state, column = np.unravel_index(int(np.nanargmax(np.abs(difference))), difference.shape)
    unit, factor = DIFFERENCE_UNITS[line.field.unit]
    t = float(comparison.curves["time"].values[state])
    value = with_unit(signed(float(difference[state, column]) * factor), unit)
    where = spot(comparison.i[int(column)], line.j, t)
    return f"{line.field.label} {value} ({where}){_kind(difference[:, column], unit, factor)}"


def _kind(difference: Floats, unit: str, factor: float) -> str:
    """Say whether a difference over the cycle is an offset or changes; "" where too little is stated."""
    if not np.isfinite(difference).all():
        return ""
    mean, spread = factor * float(difference.mean()), factor * float(difference.std())
    kind = "a constant offset" if abs(mean) > 2 * spread else "a change over the cycle"
    numbers = f"{signed(mean)}{SPACE}±{SPACE}{with_unit(rounded(spread, 2), unit)}"
    return f", there mostly {kind} of {numbers}"


def _worst_line(lines: Sequence[_Line]) -> _Line:
    return max(lines, key=lambda line: float(np.nanmax(np.abs(line.rom - line.reference))))


def _whole(comparison: Comparison, variant: str, lines: Sequence[_Line]) -> str:
    """Say the RMS errors over all cells and states; "" where none was scored."""
    fields = {line.field.name: line.field for line in lines}
    found = [(f, comparison.metrics.find(variant, name, "rms_error")) for name, f in fields.items()]
    said = [f"{f.label} {unsigned(percent(r.error))}" for f, r in found if r and r.error is not None]
    return f" RMS error over all cells and states: {listed(said)}." if said else ""


def _figures(comparison: Comparison, variant: str, key: str, lines: Sequence[_Line]) -> tuple[Figure, ...]:
    time = comparison.curves["time"].values.astype(float)
    names = list(dict.fromkeys(line.field.label for line in lines))
    by_name = [_worst_line([line for line in lines if line.field.label == name]) for name in names]
    farthest = "; ".join(_farthest(comparison, line) for line in by_name)
    what = listed(names)
    whole = _whole(comparison, variant, lines)
    figures = []
    for columns in chunks(comparison.i):
        cells = f"cells i = {listed(columns)}"
        drawing = partial(
            small_multiples,
            time,
            "time into the cycle (s)",
            [column_heading(comparison, i) for i in columns],
            [_panel_row(comparison, variant, line, columns) for line in lines],
            marks=[t for _, t in comparison.times],
        )
        figures.append(
            Figure(
                key=f"{key}-{columns[0]}",
                caption=f"Variant {variant}: {what} over the cycle at {cells}; 3D as points, 2D as a line, "
                "2D − 3D below; each row has its own scale. What to see: the closer the lower panels stay "
                f"to zero, the better 2D follows 3D. Farthest apart: {farthest}.{whole}",
                alt=f"Curves of {what} over time in 3D and 2D with their difference, variant {variant}, a "
                f"column of panels for each of {cells}. Farthest apart: {farthest}.",
                drawing=drawing,
                csv=_csv(comparison, lines, columns),
            )
        )
    return tuple(figures)


def _csv(comparison: Comparison, lines: Sequence[_Line], columns: Sequence[int]) -> str:
    time = comparison.curves["time"].values
    rows = [
        (line.field.name, i, line.j, t, line.reference[state, k], line.rom[state, k], line.field.unit)
        for line in lines
        for i in columns
        for k in (comparison.i.index(i),)
        for state, t in enumerate(time)
    ]
    return comma_separated(("quantity", "i", "j", "t_s", "reference", "rom", "unit"), rows)


def _spread(comparison: Comparison, variant: str) -> str:
    """Say how little the fields vary around an artery whose wall is the same all around."""
    j = comparison.rows_of(variant)[0]
    three, two = (
        float(np.ptp(comparison.curves[f"{model}_radius"].sel(variant=variant).values, axis=-1).max())
        for model in ("reference", "rom")
    )
    return (
        f"The wall of variant {variant} is the same all around, so one row stands for all: j = {j}. At the "
        f"shown columns the radius varies around the artery by {_micrometres(three)} in 3D and "
        f"{_micrometres(two)} in 2D."
    )


def _micrometres(length: float) -> str:
    return (
        f"at most {with_unit(fixed(1e6 * length, 2), 'μm')}" if length >= 5e-9 else f"less than 0.01{SPACE}μm"
    )


def _variant(comparison: Comparison, number: int, variant: str) -> Subsection:
    key = f"cycle-{number}"
    rows = comparison.rows_of(variant)
    section_flow = _line(comparison, variant, "section_flow_rate", None)
    blocks: tuple[Block, ...] = ()
    if not comparison.wall_varies_around[variant]:
        lines = [_line(comparison, variant, name, rows[0]) for name in ("pressure", "radius")]
        lines = [line for line in (*lines, section_flow) if anywhere(line.reference)]
        if any(line.field.name == "radius" for line in lines):
            blocks += (Paragraph(_spread(comparison, variant)),)
        blocks += _figures(comparison, variant, f"{key}-all", lines) if lines else ()
        return Subsection(key, f"Variant {variant}", blocks)
    for name in ("pressure", "radius", "sector_flow_rate"):
        lines = [_line(comparison, variant, name, j) for j in rows]
        lines = [line for line in lines if anywhere(line.reference)]
        blocks += _figures(comparison, variant, f"{key}-{name}", lines) if lines else ()
    if anywhere(section_flow.reference):
        blocks += _figures(comparison, variant, f"{key}-section", [section_flow])
    return Subsection(key, f"Variant {variant}", blocks)


@declared("cycle", "Pressure, radius and flow over the cycle")
def section(comparison: Comparison) -> Blocks:
    """Return the curves of each variant at the shown cells."""
    parts = {name: _variant(comparison, k, name) for k, name in enumerate(comparison.variants, start=1)}
    drawn = [name for name, part in parts.items() if part.blocks]
    told = left_out(comparison, drawn, "value over the cycle at the shown cells")
    return (
        *((Paragraph(told),) if told else ()),
        *(parts[name] for name in drawn),
    )
