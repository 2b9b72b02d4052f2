"""Section of the exponent of the velocity profile closest to 3D, beside that of the 2D model."""

from functools import partial
from typing import Any

import numpy as np
import xarray as xr

from cases.arrays import Floats
from reports.blocks import Figure, Interactive, Paragraph, Subsection
from reports.figures.heat_maps import MapRow, Maps, heat_maps
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared, instants
from reports.sections.parts import error_curves
from reports.sections.parts.lumen import cells_csv, centres, field, outlined
from reports.sections.parts.page_data import digits, pack
from reports.sections.parts.stated import mostly, stated_variants
from reports.wording.numbers import SPACE, listed, percent, span, unsigned
from reports.wording.words import spot, top_to_bottom


def _row(data: xr.Dataset, label: str, limits: tuple[float, float] | None) -> MapRow:
    both = tuple(field(data, f"{model}_profile_exponent") for model in ("reference", "rom"))
    return MapRow(
        label,
        (
            Maps(both, "γ", limits=limits),
            Maps((field(data, "reference_profile_error", 100.0),), "error of the fit (%)"),
        ),
    )


def _exponents(data: xr.Dataset) -> Floats:
    both = [field(data, f"{model}_profile_exponent").ravel() for model in ("reference", "rom")]
    values = np.concatenate(both)
    return values[np.isfinite(values)]


def _worst_fit(comparison: Comparison, data: xr.Dataset) -> str:
    errors = field(data, "reference_profile_error")
    if not np.isfinite(errors).any():
        return ""
    state, i, j = np.unravel_index(int(np.nanargmax(errors)), errors.shape)
    median = unsigned(percent(float(np.nanmedian(errors))))
    largest = unsigned(percent(float(errors[state, i, j])))
    where = spot(int(i) + 1, int(j) + 1, comparison.times[int(state)][1])
    return f" The closest profile is off 3D by {median} in the median, by {largest} at most ({where})."


def _spans(data: xr.Dataset) -> str:
    spans = []
    for model, name in (("reference", "3D"), ("rom", "2D")):
        values = field(data, f"{model}_profile_exponent")
        values = values[np.isfinite(values)]
        if values.size:
            spans.append(f"{span(float(values.min()), float(values.max()), 2)} in {name}")
    return f"γ is {' and '.join(spans)}" if spans else "γ is nowhere finite"


def _figure(comparison: Comparison, variant: str, key: str) -> Figure:
    data = comparison.maps.sel(variant=variant)
    found = _exponents(data)
    limits = (float(found.min()), float(found.max())) if found.size else None
    states = [data.isel(time=k) for k in range(len(comparison.times))]
    when = top_to_bottom(comparison.times)
    summary = f"{_spans(data)}.{_worst_fit(comparison, data)}"
    instants = list(zip((t for _, t in comparison.times), states, strict=True))
    columns = ("rom_profile_exponent", "reference_profile_exponent", "reference_profile_error")
    return Figure(
        key=key,
        caption=f"Variant {variant}, {when}: exponent γ of the profile closest to "
        f"3D, exponent of the 2D model, and how far the closest profile still is from 3D. {summary}"
        f"{outlined(data)}",
        alt=f"Maps over x and φ of the exponent closest to 3D, of the 2D exponent and of the error of the "
        f"closest profile, variant {variant}, {when}. {summary}",
        drawing=partial(
            heat_maps,
            *centres(data),
            ("3D: closest γ", "2D: γ", "3D: error of the closest profile"),
            [_row(state, f"t = {t:.3f} s", limits) for t, state in instants],
            data["calcified"].values > 0,
        ),
        csv=cells_csv(instants, columns),
    )


@declared("exponents", "Closest γ", instants("maps"))
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
    any_cell = Interactive(
        "exponents-anywhere",
        "errors",
        "The error over γ, with its values",
        "Choose a variant, a time and a cell; point at the curve for its values.",
        {"errors": _error_data(comparison)} if shown else {},
    )
    return (
        opening,
        *((two_modes,) if with_modes else ()),
        *told,
        *((any_cell,) if shown else ()),
        *(
            Subsection(
                f"exponents-{k}",
                f"Variant {name}",
                (
                    *error_curves.figures(comparison, name, f"exponents-{k}-errors"),
                    _figure(comparison, name, f"exponents-{k}-figure"),
                ),
            )
            for k, name in shown
        ),
    )


def _error_data(comparison: Comparison) -> dict[str, Any]:
    """Error (%) of the closest profile over its exponent: instant, i, j, γ for each variant."""
    curves = comparison.error_curves
    return {
        "gamma": digits(curves["exponent"].values),
        "values": [pack(100 * curves.sel(variant=name).values).plain() for name in comparison.variants],
    }
