"""Section of all patterns at a glance: pressure, radius and flow over the cycle in all models."""

from functools import partial

import numpy as np

from cases.arrays import Floats
from cases.fields import FIELDS
from reports.blocks import Block, Figure, Interactive, Paragraph
from reports.figures.artery_sketch import Place, artery_sketch
from reports.figures.overview import Cycle, OverviewRow, overview
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared
from reports.sections.parts.limits import limit_of
from reports.sections.parts.models import columns_of, headed
from reports.sections.parts.places import in_calcification, place_words, shown_cell
from reports.sections.parts.stated import anywhere, left_out
from reports.wording.csv_text import comma_separated
from reports.wording.numbers import SPACE, listed

_QUANTITIES = {"pressure": "$P$", "radius": "$R$", "section_flow_rate": "$q$"}


def _cell(comparison: Comparison, variant: str, name: str, i: int, j: int) -> Floats:
    """Values of a variable over the cycle in a cell, or in its section."""
    values = comparison.array(name, variant)[:, i - 1]
    return values[:, j - 1] if values.ndim > 1 else values


def _cycle(comparison: Comparison, variant: str, quantity: str, i: int, j: int) -> Cycle:
    factor = FIELDS[quantity].display_factor
    return Cycle(
        factor * _cell(comparison, variant, f"reference_{quantity}", i, j),
        tuple(
            factor * _cell(comparison.of(model), variant, f"rom_{quantity}", i, j)
            for model in comparison.models
        ),
        comparison.calcified(variant, i, j if "phi" in FIELDS[quantity].dims else None),
    )


def _row(comparison: Comparison, quantity: str, variants: list[str], place: tuple[int, int]) -> OverviewRow:
    limit = limit_of(comparison, quantity)
    return OverviewRow(
        f"{_QUANTITIES[quantity]} ({FIELDS[quantity].display_unit})",
        None if limit is None else 100 * limit,
        tuple(_cycle(comparison, name, quantity, *place) for name in variants),
    )


def _worst(comparison: Comparison, rows: dict[str, OverviewRow], variants: list[str]) -> str:
    """Say where a model is farthest from 3D in each quantity."""
    said = []
    for quantity, row in rows.items():
        errors = {
            (model, variant): float(np.nanmax(np.abs(values / cycle.reference - 1)))
            for variant, cycle in zip(variants, row.panels, strict=True)
            for model, values in zip(comparison.models, cycle.models, strict=True)
            if anywhere(cycle.reference) and np.all(cycle.reference != 0)
        }
        if errors:
            (model, variant), error = max(errors.items(), key=lambda item: item[1])
            said.append(
                f"{FIELDS[quantity].label} {100 * error:.1f}{SPACE}% ({variant}, {headed(comparison, model)})"
            )
    return listed(said)


@declared("overview", "All patterns at a glance")
def section(comparison: Comparison) -> Blocks:
    """Return one figure of all variants, quantities and models at the middle of the calcification."""
    place = shown_cell(comparison)
    variants = [
        name
        for name in comparison.variants
        if any(anywhere(_cell(comparison, name, f"reference_{q}", *place)) for q in _QUANTITIES)
    ]
    blocks: list[Block] = [
        Interactive(
            "curves-anywhere",
            "curves",
            "The chosen place over the cycle",
            "Point at the curves for their values, click to choose a time.",
        )
    ]
    told = left_out(comparison, variants, "value over the cycle there")
    if told:
        blocks.append(Paragraph(told))
    if not variants:
        return ()
    rows = {name: _row(comparison, name, variants, place) for name in _QUANTITIES}
    where = place_words(comparison, *place) + in_calcification(comparison, *place)
    worst = _worst(comparison, rows, variants)
    figure = Figure(
        "overview-figure",
        f"Pressure P, lumen radius R and flow rate q through the section over the cycle at {where}; "
        f"below each the error 2D/3D{SPACE}−{SPACE}1. Largest there: {worst}.",
        f"Curves over the cycle of pressure, radius and flow in 3D and {listed(comparison.models)}, a "
        f"column for each of {listed(variants)}, with errors below. Largest: {worst}.",
        partial(
            overview,
            comparison.fields["time"].values.astype(float),
            columns_of(comparison, variants),
            list(rows.values()),
            [headed(comparison, model) for model in comparison.models],
            marks=[t for _, t in comparison.times],
        ),
        _csv(comparison, rows, variants),
    )
    return (*blocks, figure, _sketch(comparison))


def _sketch(comparison: Comparison) -> Figure:
    """Return the artery from the side with the shown places, numbered."""
    j = shown_cell(comparison)[1]
    fields = comparison.fields
    phi = float(np.degrees(fields["phi"].values[j - 1]))
    places = [
        Place(number, 1e3 * float(fields["x"].values[i - 1]), phi)
        for number, i in enumerate(comparison.i, start=1)
    ]
    said = listed(f"{n} at {place_words(comparison, i, j)}" for n, i in enumerate(comparison.i, start=1))
    radius = next(
        (
            1e3 * float(np.nanmean(fields[name].values))
            for name in ("reference_radius", "rom_radius")
            if anywhere(fields[name].values)
        ),
        1.0,
    )
    return Figure(
        "sketch",
        f"The artery from the side, and the probes: {said}.",
        f"Drawing of the artery with inlet, outlet, calcification and the probes {said}.",
        partial(
            artery_sketch,
            1e3 * fields["x"].values,
            np.degrees(fields["phi"].values),
            radius,
            [(name, fields["calcified"].sel(variant=name).values > 0) for name in comparison.variants],
            places,
            phi,
        ),
        comma_separated(("number", "x_mm", "phi_deg"), [(p.number, p.x, p.phi) for p in places]),
    )


def _csv(comparison: Comparison, rows: dict[str, OverviewRow], variants: list[str]) -> str:
    lines = [
        (
            variant,
            quantity,
            FIELDS[quantity].display_unit,
            t,
            cycle.reference[n],
            *(m[n] for m in cycle.models),
        )
        for quantity, row in rows.items()
        for variant, cycle in zip(variants, row.panels, strict=True)
        for n, t in enumerate(comparison.fields["time"].values.tolist())
    ]
    return comma_separated(("variant", "quantity", "unit", "t_s", "reference", *comparison.models), lines)
