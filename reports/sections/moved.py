"""Section of what calcification moves, along the artery and around it, in all models."""

from functools import partial

import numpy as np

from cases.arrays import Floats
from cases.fields import FIELDS
from cases.quantities import of_cycle
from reports.blocks import Block, Column, Figure, Paragraph, Table
from reports.figures.along_and_around import Change, ChangeRow, along_and_around
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared, instants
from reports.sections.parts import change_uncertainty
from reports.sections.parts.models import headed, model_words, sides
from reports.sections.parts.places import place_words, shown_cell
from reports.sections.parts.stated import anywhere
from reports.wording.csv_text import comma_separated
from reports.wording.numbers import (
    DIFFERENCE_UNITS,
    SPACE,
    decimals_for,
    fixed,
    listed,
    percent,
    plus,
    unsigned,
)
from reports.wording.words import baseline_words, instant, quantity_words

_LINES = (("radius", "x"), ("radius", "phi"), ("sector_flow_rate", "phi"))
_SYMBOLS = {"radius": "$R$", "sector_flow_rate": r"$q_\varphi$"}
_TURN = (0.0, 90.0, 180.0, 270.0, 360.0)
_UNSURE = (
    "±: the most that the 3D mesh leaves open, its uncertainty in both variants; less is not told from none."
)
_FOLLOWED = ("pressure", "radius", "section_flow_rate", "sector_flow_share")


def _along(comparison: Comparison, variant: str, name: str, axis: str, place: tuple[int, int]) -> Floats:
    """Change of a variable from the baseline at the first named instant, along one axis, SI."""
    both = comparison.maps[name].isel(time=0)
    line = both.isel(phi=place[1] - 1) if axis == "x" else both.isel(x=place[0] - 1)
    change = line.sel(variant=variant).values - line.sel(variant=comparison.baselines[variant]).values
    return np.asarray(change, dtype=float)


def _panel(comparison: Comparison, variant: str, quantity: str, axis: str, place: tuple[int, int]) -> Change:
    factor = DIFFERENCE_UNITS[FIELDS[quantity].unit][1]
    inside = comparison.fields["calcified"].sel(variant=variant).values.astype(bool)
    return Change(
        factor * _along(comparison, variant, f"reference_{quantity}", axis, place),
        tuple(
            factor * _along(comparison.of(model), variant, f"rom_{quantity}", axis, place)
            for model in comparison.models
        ),
        inside[:, place[1] - 1] if axis == "x" else inside[place[0] - 1],
    )


def _row(comparison: Comparison, quantity: str, axis: str, place: tuple[int, int]) -> ChangeRow:
    unit = DIFFERENCE_UNITS[FIELDS[quantity].unit][0]
    along, around = place_words(comparison, place[0]), place_words(comparison, *place).partition(", ")[2]
    if axis == "x":
        abscissa, where = 1e3 * comparison.fields["x"].values, f"x (mm), at {around}"
    else:
        abscissa, where = np.degrees(comparison.fields["phi"].values), f"φ (°), at {along}"
    return ChangeRow(
        f"{_SYMBOLS[quantity]} change ({unit})",
        where,
        abscissa,
        tuple(_panel(comparison, name, quantity, axis, place) for name in comparison.changed),
        _TURN if axis == "phi" else (),
    )


def _followed(comparison: Comparison, model: str, variant: str) -> str:
    """Say how far a model's change is from that of 3D, over all cells and instants."""
    said = []
    for quantity in _FOLLOWED:
        row = comparison.of(model).metrics.find(variant, quantity, "change_rms")
        if row is not None and row.error is not None:
            said.append(f"{quantity_words(quantity)} {unsigned(percent(row.error, 0))}")
    return listed(said)


def _sentence(comparison: Comparison, variant: str) -> str:
    parts = [
        f"{model_words(comparison, [model])} {said}"
        for model in comparison.models
        if (said := _followed(comparison, model, variant))
    ]
    if not parts:
        return ""
    return (
        f"{comparison.titles[variant]}: how far its change in 2D is from its change in 3D, over the latter "
        f"(RMS; 100{SPACE}% is no better than to expect no change): {'; '.join(parts)}."
        + _open(comparison, variant)
    )


def _open(comparison: Comparison, variant: str) -> str:
    """Say what the 3D mesh leaves open of these shares; "" where no coarser mesh tells."""
    said = [
        f"{quantity_words(quantity)} ±{SPACE}{unsigned(percent(found, 0))}"
        for quantity in _FOLLOWED
        if (found := change_uncertainty.of_field(comparison, variant, quantity)) is not None
    ]
    return f" The 3D mesh leaves open of them at most {listed(said)}." if said else ""


def _table(comparison: Comparison) -> Table | None:
    """Return what calcification changes of the numbers of the cycle, in 3D and in each model."""
    rows, known, count = [], False, len(sides(comparison))
    for quantity in of_cycle():
        unit, factor = DIFFERENCE_UNITS.get(FIELDS[quantity].unit, (FIELDS[quantity].unit, 1.0))
        found = [
            None if row is None or getattr(row, side) is None else factor * getattr(row, side)
            for name in comparison.changed
            for _, view, side in sides(comparison)
            for row in (view.metrics.find(name, quantity, "change"),)
        ]
        if unit != "ms" and any(value is not None for value in found):
            decimals = decimals_for(found, 3, most=3)
            texts = [plus(fixed(value, decimals)) for value in found]
            for number, name in enumerate(comparison.changed):
                unsure = change_uncertainty.of_cycle(comparison, name, quantity)
                if unsure is not None:
                    known = True
                    texts[number * count] += f" ±{SPACE}{fixed(factor * unsure, decimals)}"
            rows.append((quantity_words(quantity), unit, *texts))
    if not rows:
        return None
    columns = [
        Column(title, "number", name) for name in comparison.changed for title, *_ in sides(comparison)
    ]
    return Table(
        "moved-table",
        f"What calcification changes of the cycle: variant minus {baseline_words(comparison)}."
        + (f" {_UNSURE}" if known else ""),
        (Column("quantity", "prose"), Column("unit"), *columns),
        tuple(rows),
    )


@declared(
    "moved",
    "What calcification moves",
    lambda comparison: bool(comparison.changed),
    instants(),
)
def section(comparison: Comparison) -> Blocks:
    """Return how well each model follows the change, and the change along and around."""
    place = shown_cell(comparison)
    blocks: list[Block] = [
        Paragraph(text) for name in comparison.changed if (text := _sentence(comparison, name))
    ]
    shown = [
        (quantity, axis)
        for quantity, axis in _LINES
        if (axis == "x" or comparison.n_phi > 1)
        and any(
            anywhere(_along(comparison, name, f"reference_{quantity}", axis, place))
            for name in comparison.changed
        )
    ]
    if not shown:
        return tuple(blocks)
    rows = [_row(comparison, quantity, axis, place) for quantity, axis in shown]
    when = instant(*comparison.times[0])
    what = f"variant minus {baseline_words(comparison)}, at {when}"
    drawn = listed(
        f"{quantity_words(quantity)} {'along the artery' if axis == 'x' else 'around it'}"
        for quantity, axis in shown
    )
    blocks.append(
        Figure(
            "moved-figure",
            f"What calcification changes ({what}): {drawn}; 3D as points. What to see: where a line leaves "
            "the points, that model gets calcification wrong.",
            f"Curves of the change of {drawn}, {what}, in 3D and in {listed(comparison.models)}.",
            partial(
                along_and_around,
                [f"{name} − {comparison.baselines[name]}" for name in comparison.changed],
                rows,
                [headed(comparison, model) for model in comparison.models],
            ),
            _csv(comparison, shown, rows),
        )
    )
    table = _table(comparison)
    return (*blocks, *((table,) if table else ()))


def _csv(comparison: Comparison, shown: list[tuple[str, str]], rows: list[ChangeRow]) -> str:
    lines = [
        (name, quantity, axis, at, panel.reference[n], *(m[n] for m in panel.models))
        for (quantity, axis), row in zip(shown, rows, strict=True)
        for name, panel in zip(comparison.changed, row.panels, strict=True)
        for n, at in enumerate(row.abscissa.tolist())
    ]
    return comma_separated(("variant", "quantity", "axis", "at", "reference", *comparison.models), lines)
