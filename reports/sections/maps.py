"""Section of the maps of where 2D differs from 3D over the unrolled lumen, (x, φ)."""

from functools import partial

import numpy as np

from cases.arrays import Floats
from cases.fields import FIELDS
from reports.blocks import Figure, Interactive
from reports.figures.limit_maps import LimitRow, limit_maps
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared, instants
from reports.sections.parts.limits import limit_of
from reports.sections.parts.lumen import cells_table
from reports.sections.parts.models import columns_of, headed
from reports.sections.parts.places import place_words
from reports.sections.parts.stated import mostly, stated_variants
from reports.wording.numbers import SPACE, listed, percent
from reports.wording.words import instant

_MAPPED = {"radius": "$R$", "sector_flow_rate": r"$q_\varphi$", "pressure": "$P$"}
_UNJUDGED = 0.01  # ends of the scale where no limit is declared
_AS = {"sector_flow_rate": "section_flow_rate"}  # whose limit counts where a quantity has none of its own


def _percent(comparison: Comparison, variant: str, quantity: str) -> Floats:
    """2D − 3D at the first named instant, in percent of 3D, (x, phi)."""
    state = comparison.states[0]
    rom, reference = (comparison.array(f"{m}_{quantity}", variant)[state] for m in ("rom", "reference"))
    with np.errstate(divide="ignore", invalid="ignore"):
        found = 100 * (rom / reference - 1)
    return np.asarray(np.where(np.isfinite(found), found, np.nan))


def _limit(comparison: Comparison, quantity: str) -> float | None:
    return limit_of(comparison, quantity) or limit_of(comparison, _AS.get(quantity, quantity))


def _whose(comparison: Comparison, quantity: str) -> str:
    """Say of a scale that it is not the quantity's own limit."""
    if limit_of(comparison, quantity):
        return ""
    other = _AS.get(quantity, quantity)
    return f" (the limit of the {FIELDS[other].label})" if limit_of(comparison, other) else " (no limit)"


def _rows(comparison: Comparison, quantities: list[str], variants: list[str]) -> list[LimitRow]:
    return [
        LimitRow(
            f"{headed(comparison, model)}, {_MAPPED[quantity]}",
            100 * (_limit(comparison, quantity) or _UNJUDGED),
            tuple(_percent(comparison.of(model), name, quantity) for name in variants),
        )
        for quantity in quantities
        for model in comparison.models
    ]


def _farthest(comparison: Comparison, quantities: list[str], variants: list[str]) -> str:
    """Say where each model is farthest from 3D in each quantity, in percent."""
    said = []
    for quantity in quantities:
        for model in comparison.models:
            maps = np.stack([_percent(comparison.of(model), name, quantity) for name in variants])
            if not np.isfinite(maps).any():
                continue
            at = np.unravel_index(int(np.nanargmax(np.abs(maps))), maps.shape)
            where = place_words(comparison, int(at[1]) + 1, int(at[2]) + 1)
            value = percent(float(maps[at]) / 100, 1)
            label = FIELDS[quantity].label
            said.append(f"{label} {value} ({headed(comparison, model)}, {variants[int(at[0])]}, {where})")
    return "; ".join(said)


def _figure(comparison: Comparison, variants: list[str]) -> Figure:
    stated = comparison.maps.sel(variant=variants).isel(time=0)
    known = [name for name in _MAPPED if mostly(stated[f"reference_{name}"].values)]
    quantities = [name for name in known if _limit(comparison, name)] or known
    when = instant(*comparison.times[0])
    scales = [
        f"{FIELDS[name].label} ±{100 * (limit or _UNJUDGED):g}{SPACE}%{_whose(comparison, name)}"
        for name in quantities
        for limit in (_limit(comparison, name),)
    ]
    farthest = _farthest(comparison, quantities, variants)
    return Figure(
        "maps-figure",
        f"2D − 3D in percent of 3D over the unrolled lumen at {when}; scales end at the limits: "
        f"{listed(scales)}. A uniform panel is a number. Farthest: {farthest}.",
        f"Maps over x and φ of the differences from 3D at {when}, for {listed(variants)}. Farthest: "
        f"{farthest}.",
        partial(
            limit_maps,
            1e3 * stated["x"].values,
            np.degrees(stated["phi"].values),
            columns_of(comparison, variants),
            _rows(comparison, quantities, variants),
            stated["calcified"].values > 0,
        ),
        _csv(comparison, quantities, variants),
    )


def _csv(comparison: Comparison, quantities: list[str], variants: list[str]) -> str:
    return cells_table(
        comparison,
        {
            f"{name} {model} {quantity} percent": _percent(comparison.of(model), name, quantity)
            for name in variants
            for model in comparison.models
            for quantity in quantities
        },
    )


@declared("maps", "Where 2D differs", instants())
def section(comparison: Comparison) -> Blocks:
    """Return the maps of the differences at the first named instant, and all maps at any time."""
    first = comparison.maps.isel(time=0)
    shown, told = stated_variants(
        comparison,
        lambda name: any(mostly(first[f"reference_{q}"].sel(variant=name).values) for q in _MAPPED),
        "field over all cells",
    )
    if not shown:
        return ()
    slider = Interactive(
        "maps-anytime",
        "maps",
        "The maps at any time",
        "Point at a map for its values; a click chooses the place and opens its curves.",
    )
    return *told, slider, _figure(comparison, [name for _, name in shown])
