"""Section of the maps of the fields over the unrolled lumen, (x, φ), in both models."""

from collections.abc import Sequence
from functools import partial

import numpy as np
import xarray as xr

from cases.arrays import Floats
from cases.fields import FIELDS, Field
from reports.blocks import Figure, Interactive, Paragraph, Subsection
from reports.figures.heat_maps import MapRow, Maps, heat_maps
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared, instants
from reports.sections.parts.lumen import cells_csv, centres, field, outlined
from reports.sections.parts.stated import mostly, stated_variants
from reports.wording.numbers import DIFFERENCE_UNITS, listed, rounded, signed, with_unit
from reports.wording.words import instant, spot

_MAPPED = ("radius", "sector_flow_rate", "profile_exponent", "pressure")
_SYMBOLS = {"radius": "R", "sector_flow_rate": "$q_φ$", "profile_exponent": "γ", "pressure": "P"}


def _difference(data: xr.Dataset, name: str) -> Floats:
    """2D − 3D in SI; NaN where a profile exponent is infinite in both."""
    with np.errstate(invalid="ignore"):
        return field(data, f"rom_{name}") - field(data, f"reference_{name}")


def _mapped(data: xr.Dataset) -> tuple[str, ...]:
    """Quantities that the reference states in most cells at one instant."""
    return tuple(name for name in _MAPPED if mostly(data[f"reference_{name}"].values))


def _label(symbol: str, unit: str) -> str:
    return symbol if unit in ("", "1") else f"{symbol} ({unit})"


def _row(data: xr.Dataset, quantity: Field) -> MapRow:
    unit, factor = DIFFERENCE_UNITS[quantity.unit]
    both = tuple(
        field(data, f"{model}_{quantity.name}", quantity.display_factor) for model in ("reference", "rom")
    )
    symbol = _SYMBOLS[quantity.name]
    return MapRow(
        "",
        (
            Maps(both, _label(symbol, quantity.display_unit)),
            Maps((factor * _difference(data, quantity.name),), _label("2D − 3D", unit), difference=True),
        ),
    )


def _farthest(data: xr.Dataset, quantity: Field) -> str:
    """Say where the models differ most."""
    difference = _difference(data, quantity.name)
    if not np.isfinite(difference).any():
        return f"{quantity.label} nowhere finite"
    sizes = np.where(np.isfinite(difference), np.abs(difference), -1.0)
    i, j = np.unravel_index(int(sizes.argmax()), sizes.shape)
    unit, factor = DIFFERENCE_UNITS[quantity.unit]
    value = with_unit(signed(factor * float(difference[i, j])), unit)
    return f"{quantity.label} {value} ({spot(int(i) + 1, int(j) + 1, None)})"


def _inside(data: xr.Dataset, quantities: Sequence[Field]) -> str:
    """Compare the size of the differences in calcified cells and elsewhere; "" where all cells are alike."""
    calcified = data["calcified"].values > 0
    if not calcified.any() or calcified.all():
        return ""
    said = []
    for quantity in quantities:
        unit, factor = DIFFERENCE_UNITS[quantity.unit]
        sizes = factor * np.abs(_difference(data, quantity.name))
        if np.isfinite(sizes).all():
            within, without = (
                with_unit(rounded(float(sizes[cells].mean()), 2), unit) for cells in (calcified, ~calcified)
            )
            said.append(f"{quantity.label} {within} and {without}")
    return (
        f" Mean size of the difference in calcified cells and elsewhere: {'; '.join(said)}." if said else ""
    )


def _figure(comparison: Comparison, variant: str, state: int, key: str) -> Figure:
    data = comparison.maps.sel(variant=variant).isel(time=state)
    quantities = [FIELDS[name] for name in _mapped(data)]
    when = instant(*comparison.times[state])
    farthest = "; ".join(_farthest(data, quantity) for quantity in quantities)
    what = listed(quantity.label for quantity in quantities)
    return Figure(
        key=key,
        caption=f"Variant {variant}, {when}: {what} over the unrolled lumen; 3D and 2D in one scale, 2D − 3D "
        f"in a scale centred on zero. What to see: where the right column is pale, 2D is right. "
        f"Farthest apart: {farthest}.{_inside(data, quantities)}{outlined(data)}",
        alt=f"Maps over x and φ of {what} in 3D, in 2D and their difference, variant {variant}, {when}. "
        f"Farthest apart: {farthest}.",
        drawing=partial(
            heat_maps,
            *centres(data),
            ("3D", "2D", "2D − 3D"),
            [_row(data, quantity) for quantity in quantities],
            data["calcified"].values > 0,
        ),
        csv=cells_csv(
            [(comparison.times[state][1], data)],
            [f"{model}_{quantity.name}" for quantity in quantities for model in ("reference", "rom")],
        ),
    )


@declared("maps", "(x, φ) maps", instants("maps"))
def section(comparison: Comparison) -> Blocks:
    """Return the maps of all fields, at the first named instant."""
    shown, told = stated_variants(
        comparison,
        lambda name: bool(_mapped(comparison.maps.sel(variant=name).isel(time=0))),
        "field over all cells",
    )
    if not shown:
        return told
    figures = tuple(
        Subsection(f"maps-{k}", f"Variant {name}", (_figure(comparison, name, 0, f"maps-{k}-figure"),))
        for k, name in shown
    )
    slider = Interactive(
        "maps-anytime",
        "maps",
        "The maps at any time",
        "Choose a variant and a quantity, move the time slider or let it play; point at a map for its "
        "values.",
    )
    opening = Paragraph(
        f"The still maps are at {instant(*comparison.times[0])}; comparison.nc holds all "
        f"{comparison.fields.sizes['time']} states."
    )
    return opening, *told, slider, *figures
