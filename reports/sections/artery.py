"""Section of the deformed lumen in space."""

from dataclasses import dataclass
from functools import partial

import numpy as np

from reports.blocks import Figure, Interactive
from reports.figures.tubes import Tube, tubes
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared, instants
from reports.sections.parts.lumen import cells_table
from reports.sections.parts.models import sides
from reports.sections.parts.places import place_words
from reports.wording.numbers import SPACE, fixed, listed
from reports.wording.words import instant

_EXAGGERATIONS = (20, 10, 5, 3, 2)
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


def _lumens(comparison: Comparison, variant: str, state: int, seen: View) -> list[Tube]:
    """One variant's lumen in 3D and in each reduced model."""
    calcified = comparison.fields["calcified"].sel(variant=variant).values > 0
    found = []
    for _, of, model in sides(comparison):
        radius = of.array(f"{model}_radius", variant)[state]
        drawn = seen.rest_radius + seen.exaggeration * (radius - seen.rest_radius)
        found.append(Tube(1e3 * drawn, 1e3 * radius, calcified))
    return found


def _narrowest(comparison: Comparison, state: int) -> str:
    """Say where each variant is narrowest in each model."""
    said = []
    for name in comparison.variants:
        found = []
        for words, of, model in sides(comparison):
            radius = 1e3 * of.array(f"{model}_radius", name)[state]
            i, j = np.unravel_index(int(radius.argmin()), radius.shape)
            where = place_words(comparison, int(i) + 1, int(j) + 1)
            found.append(f"{words} {fixed(float(radius[i, j]), 3)}{SPACE}mm ({where})")
        said.append(f"{name}: {', '.join(found)}")
    return "; ".join(said)


@declared("artery", "3D view", instants(), has_shape)
def section(comparison: Comparison) -> Blocks:
    """Return a still, and a picture to be turned."""
    name, t_s = comparison.times[0]
    state = comparison.states[0]
    seen = view(comparison)
    fields = comparison.fields.isel(time=state)
    rows = [(variant, _lumens(comparison, variant, state, seen)) for variant in comparison.variants]
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
        f"scale; {drawn}; framed: calcified. Narrowest: {least}.",
        alt=f"The deformed lumen of {listed(comparison.variants)} in 3D and 2D seen from the side. "
        f"Narrowest: {least}.",
        drawing=partial(
            tubes,
            1e3 * fields["x"].values,
            fields["phi"].values,
            seen.seen_from,
            [words for words, *_ in sides(comparison)],
            rows,
            "R (mm)",
        ),
        csv=_csv(comparison, state),
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


def _csv(comparison: Comparison, state: int) -> str:
    return cells_table(
        comparison,
        {
            f"{name} {side} R_m": of.array(f"{model}_radius", name)[state]
            for name in comparison.variants
            for side, of, model in sides(comparison)
        },
    )
