"""Section of the exponent of the velocity profile closest to 3D, beside that of the 2D model."""

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np

from cases.arrays import Floats
from reports.blocks import Figure, Interactive, Paragraph
from reports.figures.heat_maps import MapRow, Maps, heat_maps
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared, instants
from reports.sections.parts.lumen import cells_table
from reports.sections.parts.models import columns_of, sides
from reports.sections.parts.page_data import digits, pack
from reports.sections.parts.places import place_words
from reports.sections.parts.stated import mostly, stated_variants
from reports.wording.numbers import SPACE, listed, percent, span, unsigned
from reports.wording.words import instant


def _exponents(comparison: Comparison, variant: str, model: str) -> Floats:
    """γ of a model at the first named instant, (x, phi)."""
    data = comparison.maps[f"{model}_profile_exponent"].sel(variant=variant).isel(time=0)
    return np.asarray(data.values, dtype=float)


def _worst_fit(comparison: Comparison, variants: Sequence[str]) -> str:
    """Say how far the closest profile is from 3D at the named instants."""
    errors = comparison.maps["reference_profile_error"].sel(variant=list(variants)).values.astype(float)
    if not np.isfinite(errors).any():
        return ""
    at = np.unravel_index(int(np.nanargmax(errors)), errors.shape)
    median = unsigned(percent(float(np.nanmedian(errors))))
    largest = unsigned(percent(float(errors[at])))
    where = place_words(comparison, int(at[2]) + 1, int(at[3]) + 1)
    when = instant(*comparison.times[int(at[1])])
    return (
        f" The closest profile is off 3D by {median} in the median, by {largest} at most "
        f"({variants[int(at[0])]}, {where}, {when})."
    )


def _spans(comparison: Comparison, variants: Sequence[str]) -> str:
    """Say between what exponents each model is."""
    said = []
    for words, view, model in sides(comparison):
        values = np.concatenate([_exponents(view, variant, model).ravel() for variant in variants])
        values = values[np.isfinite(values)]
        if values.size:
            said.append(f"{span(float(values.min()), float(values.max()), 2)} in {words}")
    return f"γ is {listed(said)}" if said else "γ is nowhere finite"


def _figure(comparison: Comparison, variants: Sequence[str]) -> Figure:
    lines = [
        (words, [_exponents(view, name, model) for name in variants])
        for words, view, model in sides(comparison)
    ]
    values = np.concatenate([each.ravel() for _, of in lines for each in of])
    values = values[np.isfinite(values)]
    limits = (float(values.min()), float(values.max())) if values.size else None
    shown = comparison.maps.sel(variant=list(variants)).isel(time=0)
    when = instant(*comparison.times[0])
    summary = f"{_spans(comparison, variants)}.{_worst_fit(comparison, variants)}"
    return Figure(
        key="exponents-figure",
        caption=f"Exponent γ of the profile closest to 3D, and that of 2D, at {when}. {summary}",
        alt=f"Maps over x and φ of the exponent closest to 3D and of the 2D exponent at {when}. {summary}",
        drawing=partial(
            heat_maps,
            1e3 * shown["x"].values,
            np.degrees(shown["phi"].values),
            columns_of(comparison, variants),
            [MapRow(label, (Maps(tuple(of), "γ", limits=limits),)) for label, of in lines],
            shown["calcified"].values > 0,
            "framed: calcified",
        ),
        csv=cells_table(
            comparison,
            {
                f"{name} {label}": values
                for label, of in lines
                for name, values in zip(variants, of, strict=True)
            },
        ),
    )


@declared("exponents", "Closest γ", instants())
def section(comparison: Comparison) -> Blocks:
    """Return the closest profile exponents."""
    records = comparison.variants
    with_modes = [name for name in records if comparison.settings(name).profile == "two_mode"]
    profile = f"v{SPACE}={SPACE}v₀{SPACE}(1{SPACE}−{SPACE}(r/R)^γ)"
    assumed = (
        f"γ is the exponent of the profile {profile} that is closest along each ray"
        if len(with_modes) == len(records)
        else f"The 2D model assumes {profile} along each ray. In 3D, γ is that of the closest such profile"
    )
    opening = Paragraph(f"{assumed}; where its error is large, no γ describes the 3D profile.")
    two_modes = Paragraph(
        f"In {listed(with_modes)} the 2D model has profiles of two modes, D (1 − (r/R)ⁿ) + B (r/R)² "
        "(1 − (r/R)⁴), and its γ is that of the closest profile with one, as in 3D."
    )
    stated = comparison.maps["reference_profile_exponent"]
    shown, told = stated_variants(
        comparison, lambda name: mostly(stated.sel(variant=name).values), "profiles to fit an exponent to"
    )
    if not shown:
        return ()
    any_cell = Interactive(
        "exponents-anywhere",
        "errors",
        "The error over γ, with its values",
        "Of the shown cell and instant nearest to the chosen ones; point at the curve for its values.",
        {"errors": _error_data(comparison)},
    )
    figure = _figure(comparison, [name for _, name in shown])
    return opening, *((two_modes,) if with_modes else ()), *told, any_cell, figure


def _error_data(comparison: Comparison) -> dict[str, Any]:
    """Error (%) of the closest profile over its exponent: instant, i, j, γ for each variant."""
    curves = comparison.error_curves
    return {
        "gamma": digits(curves["exponent"].values),
        "values": [pack(100 * curves.sel(variant=name).values).plain() for name in comparison.variants],
    }
