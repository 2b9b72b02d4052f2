"""Section on axial dominance: how small the velocities are that the 2D model neglects."""

from functools import partial

import numpy as np

from cases.arrays import Floats
from cases.results.metric_row import MetricRow, Model
from reports.blocks import Block, Column, Figure, Paragraph, Table
from reports.figures.dominance_map import dominance_map
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared, of_each_model
from reports.sections.parts.cells import chunks
from reports.sections.parts.lumen import cells_table
from reports.sections.parts.models import columns_of, headed, sides
from reports.sections.parts.places import degrees_words, place_words, row_place
from reports.sections.parts.stated import mostly
from reports.wording.numbers import ABSENT, SPACE, fixed, listed

RADIAL, AZIMUTHAL = "axial_dominance_radial", "axial_dominance_azimuthal"
RATIOS = {RADIAL: "|v_r|/v_x", AZIMUTHAL: "|v_φ|/v_x"}
_MODELS: dict[Model, str] = {"reference": "3D", "rom": "2D"}
_DECIMALS = 3
_NEGLIGIBLE = 0.1


def ratio(value: float | None) -> str:
    """Write a ratio; one too small for the decimals is not shown as zero."""
    if value is not None and 0 < value < 0.5 * 10**-_DECIMALS:
        return f"<{SPACE}{10**-_DECIMALS:.{_DECIMALS}f}"
    return fixed(value, _DECIMALS)


def _dominance_tables(comparison: Comparison, quantity: str, model: str = "3D") -> tuple[Table, ...]:
    """Return the ratio of a model at the shown cells, a line per variant and row j; 2D where it has one."""

    def value(row: MetricRow | None) -> float | None:
        return None if row is None else row.reference if model == "3D" else row.rom

    tables = []
    for cells in chunks(comparison.i):
        lines = {
            (variant, j): [comparison.metrics.find(variant, quantity, "value", i, j) for i in cells]
            for variant in comparison.variants
            for j in comparison.rows_of(variant)
        }
        lines = {at: of for at, of in lines.items() if any(value(row) is not None for row in of)}
        if lines:
            columns = (
                Column("variant"),
                Column("φ", "number"),
                *(Column(place_words(comparison, i), "number") for i in cells),
            )
            marked = frozenset(
                (number, 2 + column)
                for number, (variant, j) in enumerate(lines)
                for column, i in enumerate(cells)
                if comparison.calcified(variant, i, j)
            )
            rows = [
                (variant, degrees_words(comparison, j), *(ratio(value(row)) for row in of))
                for (variant, j), of in lines.items()
            ]
            caption = (
                f"Largest {RATIOS[quantity]} of {model} over the ray and the cycle at the shown cells."
                + (" Shaded: inside the calcification." if marked else "")
            )
            key = f"{quantity.replace('_', '-')}-{cells[0]}" + ("" if model == "3D" else "-2d")
            tables.append(Table(key, caption, columns, tuple(rows), 0, marked, "inside the calcification"))
    return tuple(tables)


def _largest_table(comparison: Comparison) -> Table | None:
    shown = [
        (quantity, model)
        for quantity in RATIOS
        for model in _MODELS
        if any(comparison.metrics.largest_row(name, quantity, model) for name in comparison.variants)
    ]
    rows = []
    for variant in comparison.variants:
        found = [comparison.metrics.largest_row(variant, *which) for which in shown]
        if any(found):
            texts = (
                (ratio(getattr(row, model)), row_place(comparison, row)) if row else (ABSENT, ABSENT)
                for row, (_, model) in zip(found, shown, strict=True)
            )
            rows.append((variant, *(text for pair in texts for text in pair)))
    if not rows:
        return None
    columns = [Column("variant")]
    for quantity, model in shown:
        words = f"{RATIOS[quantity]} of {_MODELS[model]}"
        columns += [Column("largest", "number", words), Column("at", "text", words)]
    caption = "The largest ratios over all cells, those at the outlet among them, and where they are."
    return Table("largest-dominance", caption, tuple(columns), tuple(rows))


def outlet_cells(comparison: Comparison) -> int:
    """How many cells 3D's |v_r|/v_x rises over towards the outlet, in every variant; 1 or more.

    The outlet's condition makes that rise, not the flow: it is no longer than the lumen's radius.
    """
    name = f"reference_{RADIAL}"
    if name not in comparison.fields:
        return 1
    along = np.nan_to_num(comparison.fields[name].values.astype(float)).max(axis=-1)  # (variant, x)
    rises = (np.diff(along) > 0).all(axis=0)[::-1]  # from each cell to the next, in every variant
    steps = int(rises.argmin()) if not rises.all() else rises.size
    x = comparison.fields["x"].values
    radius = float(np.mean(comparison.fields["rom_radius"].values))
    return max(1, min(steps, int((x > x[-1] - radius).sum())))


def largest_inside(
    comparison: Comparison, quantity: str, variant: str = ""
) -> tuple[float, str, int, int] | None:
    """Largest ratio of 3D before the outlet's cells, of one variant or all, with variant and cell."""
    name = f"reference_{quantity}"
    if name not in comparison.fields:
        return None
    values = comparison.fields[name].values.astype(float)[:, : -outlet_cells(comparison)]
    if variant:
        values = np.where(np.equal(comparison.variants, variant)[:, None, None], values, np.nan)
    if not np.isfinite(values).any():
        return None
    at = np.unravel_index(int(np.nanargmax(values)), values.shape)
    return float(values[at]), comparison.variants[int(at[0])], int(at[1]) + 1, int(at[2]) + 1


def _dominance_sentence(comparison: Comparison) -> str:
    opening = (
        "The 2D model neglects the radial velocity v_r and the azimuthal velocity v_φ beside the axial v_x. "
    )
    found = {quantity: of for quantity in RATIOS if (of := largest_inside(comparison, quantity))}
    if not found:
        return f"{opening}How small they are in 3D was not measured."
    quantity, (largest, variant, i, j) = max(found.items(), key=lambda item: item[1][0])
    verdict = "nowhere more than a tenth of" if largest <= _NEGLIGIBLE else "not everywhere small beside"
    return (
        f"{opening}In 3D they are {verdict} v_x: the largest ratio before the outlet, {RATIOS[quantity]} = "
        f"{ratio(largest)}, is in variant {variant} at {place_words(comparison, i, j)}."
    )


def _implied_sentence(comparison: Comparison) -> str:
    """Say where the 2D model's own radial velocity is largest, and whether that is at a jump of the wall."""
    rows = [
        row for name in comparison.variants if (row := comparison.metrics.largest_row(name, RADIAL, "rom"))
    ]
    if not rows:
        return ""
    row = max(rows, key=lambda r: r.rom or 0.0)
    said = (
        f"The v_r that follows from the {headed(comparison, comparison.model)} model's own v_x and mass "
        f"balance is largest in variant {row.variant} at {place_words(comparison, row.i or 1, row.j)}, "
        f"{RATIOS[RADIAL]} = {ratio(row.rom)}"
    )
    if not _at_edge(comparison, row):
        return f"{said}."
    return (
        f"{said}: beside the calcification's edge, where the radius of a row-local wall jumps from one cell "
        "to the next. That slope is the jump over one cell, so this figure grows with a finer grid and is no "
        "measure of the flow; 3D has no such jump."
    )


def _at_edge(comparison: Comparison, row: MetricRow) -> bool:
    """Whether a row's cell or a neighbour along x differs from it in being calcified."""
    if row.i is None or row.j is None:
        return False
    inside = comparison.fields["calcified"].sel(variant=row.variant).values[:, row.j - 1]
    near = inside[max(0, row.i - 2) : row.i + 1]
    return bool(near.any() and not near.all())


def _maps(comparison: Comparison, variant: str, model: str) -> Floats:
    """Largest |v_r|/v_x over the ray and the cycle, (x, phi)."""
    return np.asarray(comparison.fields[f"{model}_{RADIAL}"].sel(variant=variant).values, dtype=float)


def _left_out(comparison: Comparison) -> str:
    count = outlet_cells(comparison)
    cells = "The last cell is" if count == 1 else f"The last {count} cells are"
    return f"{cells} left out: the outlet's condition makes what is there."


def _figure(comparison: Comparison) -> Figure:
    lines = [
        (words, [_maps(view, name, model) for name in comparison.variants])
        for words, view, model in sides(comparison)
        if f"{model}_{RADIAL}" in view.fields
    ]
    fields = comparison.fields
    of_2d = " and as it follows from 2D" if len(lines) > 1 else ""
    return Figure(
        "dominance-figure",
        f"Largest {RATIOS[RADIAL]} over the ray and the cycle, in 3D{of_2d}. {_left_out(comparison)}",
        f"Maps over x and φ of the largest {RATIOS[RADIAL]} in 3D{of_2d} for {listed(comparison.variants)}.",
        partial(
            dominance_map,
            1e3 * fields["x"].values,
            np.degrees(fields["phi"].values),
            columns_of(comparison, comparison.variants),
            lines,
            fields["calcified"].values > 0,
            label="$|v_r|/v_x$",
            outlet_columns=outlet_cells(comparison),
        ),
        cells_table(
            comparison,
            {
                f"{name} {label}": values
                for label, of in lines
                for name, values in zip(comparison.variants, of, strict=True)
            },
        ),
    )


@declared("dominance", "Axial dominance")
def section(comparison: Comparison) -> Blocks:
    """Return how small the neglected velocities are, and where."""
    said = (_dominance_sentence(comparison), _implied_sentence(comparison))
    name = f"reference_{RADIAL}"
    drawn = name in comparison.fields and comparison.n_phi > 1 and mostly(comparison.fields[name].values)
    return (Paragraph(" ".join(filter(None, said))), *((_figure(comparison),) if drawn else ()))


@declared("dominance-tables", "Axial dominance, in numbers", appendix=True)
@of_each_model
def tables(comparison: Comparison) -> Blocks:
    """Return the ratios of the neglected velocities to the axial one."""
    blocks: list[Block] = []
    largest = _largest_table(comparison)
    if largest:
        blocks.append(largest)
    for quantity in RATIOS:
        blocks += _dominance_tables(comparison, quantity)
        blocks += _dominance_tables(comparison, quantity, "2D")
    return tuple(blocks)
