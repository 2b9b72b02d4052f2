"""True cross-sections of the axial velocity at the calcification, in all models."""

from functools import partial

import numpy as np

from cases.fields import FIELDS
from reports.blocks import Figure
from reports.figures.cross_sections import Disc, Section, cross_sections
from reports.result.load import Comparison
from reports.sections.parts.models import headed
from reports.sections.parts.places import place_words, shown_cell
from reports.wording.csv_text import comma_separated
from reports.wording.numbers import listed
from reports.wording.words import instant

_FIELD = FIELDS["axial_velocity"]


def _disc(view: Comparison, model: str, variant: str, i: int) -> Disc:
    radius = view.maps[f"{model}_radius"].sel(variant=variant).isel(time=0, x=i - 1)
    velocity = view.sections[f"{model}_axial_velocity"].sel(variant=variant).isel(x=view.i.index(i))
    return Disc(
        1e3 * radius.values.astype(float), _FIELD.display_factor * np.asarray(velocity.values, dtype=float)
    )


def sections_figure(comparison: Comparison, variants: list[str]) -> Figure:
    """Return the shown section nearest to the middle of the calcification, a row of discs a variant."""
    i = shown_cell(comparison)[0]
    drawn = [
        Section(
            name,
            _disc(comparison, "reference", name, i),
            tuple(_disc(comparison.of(model), "rom", name, i) for model in comparison.models),
            comparison.fields["calcified"].sel(variant=name).values[i - 1] > 0,
        )
        for name in variants
    ]
    where = f"{place_words(comparison, i)}, {instant(*comparison.times[0])}"
    share = comparison.profiles["y"].values.astype(float)
    phi = comparison.fields["phi"].values.astype(float)
    return Figure(
        "sections-figure",
        f"Axial velocity in the section at {where}: 3D, 2D, and their differences within the lumen of "
        "3D, to scale; lumens are outlined, the calcification is the arc outside.",
        f"Cross-sections of the axial velocity in all models for {listed(variants)} at {where}.",
        partial(
            cross_sections,
            phi,
            share,
            drawn,
            [headed(comparison, model) for model in comparison.models],
            _FIELD.display_unit,
        ),
        comma_separated(
            ("variant", "model", "phi_deg", "R_mm", "r_over_R", f"v_x ({_FIELD.display_unit})"),
            [
                (
                    section.label,
                    model,
                    round(float(np.degrees(at)), 3),
                    disc.radius[n],
                    y,
                    disc.velocity[n, k],
                )
                for section in drawn
                for model, disc in zip(
                    ("reference", *comparison.models), (section.reference, *section.models), strict=True
                )
                for n, at in enumerate(phi)
                for k, y in enumerate(share.tolist())
            ],
        ),
    )
