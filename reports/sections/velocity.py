"""Section of the velocity profiles at the named instants."""

from functools import partial

import numpy as np

from cases.arrays import Floats
from cases.fields import FIELDS
from reports.blocks import Block, Figure, Interactive, Paragraph
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared, instants
from reports.sections.parts.cells import chunks
from reports.sections.parts.grids import GridPanel, GridRow, grid_figure
from reports.sections.parts.models import headed
from reports.sections.parts.page_data import all_models
from reports.sections.parts.places import around_words, place_words, probe_words, shown_cell
from reports.sections.parts.sections_figure import sections_figure
from reports.sections.parts.stated import anywhere, stated_variants
from reports.wording.numbers import SPACE, listed, signed, with_unit
from reports.wording.words import instant

_FIELD = FIELDS["axial_velocity"]


def _values(variant: str, state: int, i: int, j: int, view: Comparison, model: str) -> Floats:
    """Axial velocity along a ray at a named instant, (y,)."""
    values = view.profiles[f"{model}_axial_velocity"].values[view.variants.index(variant)]
    return np.asarray(values[view.states[state], view.i.index(i), view.j.index(j)], dtype=float)


def profile_row(
    comparison: Comparison, variant: str, state: int, j: int, place: str, columns: tuple[int, ...]
) -> GridRow:
    """Profiles of a variant at a named instant along row j, a panel a probe."""
    panels = tuple(
        GridPanel(partial(_values, variant, state, i, j), comparison.calcified(variant, i, j))
        for i in columns
    )
    return GridRow(_FIELD, "$v_x$", place, panels)


def _farthest(comparison: Comparison, variants: list[str], state: int) -> str:
    """Say for each model where it is farthest from 3D at an instant."""
    said = []
    for model in comparison.models:
        view = comparison.of(model)
        data = view.profiles.isel(time=view.states[state]).sel(variant=variants)
        apart = (data["rom_axial_velocity"] - data["reference_axial_velocity"]).values.astype(float)
        if not np.isfinite(apart).any():
            continue
        at = np.unravel_index(int(np.nanargmax(np.abs(apart))), apart.shape)
        value = with_unit(signed(float(apart[at]) * _FIELD.display_factor), _FIELD.display_unit)
        place = place_words(comparison, comparison.i[int(at[1])], comparison.j[int(at[2])])
        ray = f"r/R{SPACE}={SPACE}{float(data['y'].values[at[3]]):.2f}"
        said.append(f"{headed(comparison, model)} {value} ({variants[int(at[0])]}, {place}, {ray})")
    return "; ".join(said)


def figures(comparison: Comparison, variants: list[str]) -> list[Figure]:
    """Profiles at the first named instant, a row of panels a variant."""
    j = shown_cell(comparison)[1]
    when = instant(*comparison.times[0])
    farthest = _farthest(comparison, variants, 0)
    where = around_words(comparison, j)
    caption = (
        f"Axial velocity from the axis (r/R{SPACE}={SPACE}0) to the wall at {where}, at {when}. "
        f"Farthest from 3D at all probes: {farthest}."
    )
    alt = (
        f"Velocity profiles of all models at {when}, a row of panels for each of {listed(variants)}. "
        f"Farthest from 3D: {farthest}."
    )
    return [
        grid_figure(
            comparison,
            (f"profiles-{columns[0]}", caption, alt),
            ("r/R (–)", comparison.profiles["y"].values.astype(float)),
            [probe_words(comparison, i) for i in columns],
            [profile_row(comparison, name, 0, j, name, columns) for name in variants],
        )
        for columns in chunks(comparison.i)
    ]


def stated(comparison: Comparison) -> tuple[list[str], tuple[Paragraph, ...]]:
    """Variants whose reference states profiles, and a line on the others."""
    values = comparison.profiles["reference_axial_velocity"]
    shown, told = stated_variants(
        comparison, lambda name: anywhere(values.sel(variant=name).values), "velocity profiles"
    )
    return [name for _, name in shown], told


@declared("profiles", "Velocity profiles", instants())
def section(comparison: Comparison) -> Blocks:
    """Return the profiles of each variant whose reference states them."""
    variants, told = stated(comparison)
    if not variants:
        return ()
    blocks: list[Block] = [
        Interactive(
            "profiles-anytime",
            "profiles",
            "The profile at any time",
            "Of the shown cell that is nearest to the chosen place; point at the curves for their values.",
            {"profiles": all_models(comparison, _FIELD, lambda view: view.profiles)},
        ),
        *told,
        *figures(comparison, variants),
        *([sections_figure(comparison, variants)] if comparison.n_phi > 1 else []),
    ]
    return tuple(blocks)
