"""Section of the deformed lumen in space."""

from dataclasses import dataclass
from functools import partial

import numpy as np

from cases.arrays import Floats
from reports.blocks import Figure, Interactive
from reports.figures.tubes import Tube, tubes
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, Need, declared, instants
from reports.sections.parts.lumen import cells_header, cells_text, field
from reports.wording.numbers import SPACE, fixed, listed, share
from reports.wording.words import baseline_words, instant, spot

_EXAGGERATIONS = (20, 10, 5, 3, 2)
_NARROWER = 0.01  # a difference of the radius that is read as narrowing
_MOST_DRAWN = 0.35  # of the radius: a change drawn larger is no artery any more


@dataclass(frozen=True)
class View:
    """How the lumen is drawn so that its deformation can be seen.

    Attributes
    ----------
    rest_radius : float
        Mean radius (m) of all variants and both models; changes from it are drawn larger.
    exaggeration : int
        How many times larger.
    seen_from : float
        Angle φ (rad) of the side that faces the reader: the middle of the calcification.
    """

    rest_radius: float
    exaggeration: int
    seen_from: float


def has_shape(comparison: Comparison) -> bool:
    """Whether both models have a radius in every cell of every state."""
    radii = (comparison.fields[f"{model}_radius"].values for model in ("reference", "rom"))
    return all(bool(np.isfinite(values).all()) for values in radii)


def view(comparison: Comparison) -> View:
    """Choose the view from the radii of the whole cycle and the calcified cells."""
    radii = np.stack([comparison.fields[f"{model}_radius"].values for model in ("reference", "rom")])
    rest = float(radii.mean())
    largest = float(np.abs(radii - rest).max())
    times = next((k for k in _EXAGGERATIONS if k * largest <= _MOST_DRAWN * rest), 1)
    return View(rest, times, _middle(comparison))


def _middle(comparison: Comparison) -> float:
    """Middle angle of the calcified cells that do not reach all around; π/2 if there are none."""
    inside = comparison.fields["calcified"].values > 0
    partly = inside & ~inside.all(axis=-1, keepdims=True)
    share = partly.sum(axis=(0, 1))
    if not share.any():
        return float(np.pi / 2)
    return float(np.angle((share * np.exp(1j * comparison.fields["phi"].values)).sum()) % (2 * np.pi))


def _tube(data: Floats, calcified: Floats, seen: View) -> Tube:
    drawn = seen.rest_radius + seen.exaggeration * (data - seen.rest_radius)
    return Tube(1e3 * drawn, 1e3 * data, calcified > 0)


def _narrowest(comparison: Comparison, state: int) -> str:
    """Say where each variant is narrowest in both models."""
    said = []
    for name in comparison.variants:
        data = comparison.fields.sel(variant=name).isel(time=state)
        found = []
        for model, words in (("reference", "3D"), ("rom", "2D")):
            radius = field(data, f"{model}_radius", 1e3)
            i, j = np.unravel_index(int(radius.argmin()), radius.shape)
            found.append(
                f"{fixed(float(radius[i, j]), 3)}{SPACE}mm in {words} ({spot(int(i) + 1, int(j) + 1, None)})"
            )
        said.append(f"{name}: {' and '.join(found)}")
    return "; ".join(said)


def _reach(comparison: Comparison, state: int) -> str:
    """Say how much of the wall beside the calcification is narrower than the baseline's; "" without one."""
    fields = comparison.fields.isel(time=state)
    said = []
    for name in comparison.changed:
        data, base = fields.sel(variant=name), fields.sel(variant=comparison.baselines[name])
        beside = data["calcified"].values == 0
        if beside.any():
            three, two = (
                share(float((data[radius] < (1 - _NARROWER) * base[radius]).values[beside].mean()))
                for radius in ("reference_radius", "rom_radius")
            )
            said.append(f"{name} {three} in 3D and {two} in 2D")
    return (
        f"; of the other cells, narrower than in {baseline_words(comparison)} by more than "
        f"{share(_NARROWER)} are: {', '.join(said)}"
        if said
        else ""
    )


SHAPE = Need(
    has_shape, "The reference does not state the radius of all cells, so there is no 3D artery to show."
)


@declared("artery", "3D view", instants("the artery"), SHAPE)
def section(comparison: Comparison) -> Blocks:
    """Return a still, and a picture to be turned."""
    name, t_s = comparison.times[0]
    state = comparison.states[0]
    seen = view(comparison)
    fields = comparison.fields.isel(time=state)
    rows = [
        (
            variant,
            [
                _tube(data[f"{model}_radius"].values.astype(float), data["calcified"].values, seen)
                for data, model in [(of_3d, "reference"), *((data, "rom") for data in of_models)]
            ],
        )
        for variant in comparison.variants
        for of_3d in (fields.sel(variant=variant),)
        for of_models in (
            [
                comparison.of(name).fields.isel(time=state).sel(variant=variant)
                for name in comparison.models
            ],
        )
    ]
    least = _narrowest(comparison, state)
    drawn = (
        "deformation true to scale"
        if seen.exaggeration == 1
        else f"deviations of the radius from {fixed(1e3 * seen.rest_radius, 2)}{SPACE}mm drawn "
        f"{seen.exaggeration} times larger, colours true"
    )
    still = Figure(
        key="artery-still",
        caption=f"The deformed lumen at {instant(name, t_s)} in 3D and 2D, coloured by its radius, in one "
        f"scale; {drawn}. Narrowest: {least}. What to see: how far the narrowing reaches beyond the "
        f"calcified cells (framed){_reach(comparison, state)}. Drawn by projection, without OpenGL.",
        alt=f"The deformed lumen of {listed(comparison.variants)} in 3D and 2D seen from the side. "
        f"Narrowest: {least}.",
        drawing=partial(
            tubes,
            1e3 * fields["x"].values,
            fields["phi"].values,
            seen.seen_from,
            ("3D", *(headed(comparison, model) for model in comparison.models)),
            rows,
            "R (mm)",
        ),
        csv=_csv(comparison, t_s, state),
    )
    turned = Interactive(
        "artery-turned",
        "artery",
        "The artery, to be turned",
        "Drag to turn, point at the wall for its values, click to choose a place; both models turn together. "
        "Without a pointer, use the sliders.",
        {
            "artery": {
                "rest_radius": 1e3 * seen.rest_radius,
                "exaggeration": seen.exaggeration,
                "seen_from": float(np.degrees(seen.seen_from)),
            }
        },
    )
    return still, turned


def _csv(comparison: Comparison, t_s: float, state: int) -> str:
    names = ("reference_radius", "rom_radius", "calcified")
    fields = comparison.fields.isel(time=state)
    lines = (cells_text(t_s, fields.sel(variant=name), names, (name,)) for name in comparison.variants)
    return "".join((cells_header(("variant",), names), *lines))
