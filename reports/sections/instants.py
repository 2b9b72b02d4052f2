"""Section of the velocity profiles at every named instant and shown row."""

from reports.blocks import Figure
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, Need, declared
from reports.sections.parts.cells import chunks
from reports.sections.parts.grids import grid_figure
from reports.sections.parts.places import probe_words
from reports.sections.velocity import profile_row, stated
from reports.wording.words import instant, row_heading


def _figures(comparison: Comparison, number: int, variant: str) -> list[Figure]:
    lines = [
        (k, j, f"{name}\n{row_heading(comparison, j)}")
        for k, (name, _) in enumerate(comparison.times)
        for j in comparison.rows_of(variant)
    ]
    when = ", ".join(instant(*named) for named in comparison.times)
    return [
        grid_figure(
            comparison,
            (
                f"profiles-{number}-{columns[0]}",
                f"Variant {variant}: axial velocity from the axis to the wall at the probes; {when}.",
                f"Velocity profiles of all models, variant {variant}, {when}.",
            ),
            ("r/R (–)", comparison.profiles["y"].values.astype(float)),
            [probe_words(comparison, i) for i in columns],
            [profile_row(comparison, variant, k, j, place, columns) for k, j, place in lines],
        )
        for columns in chunks(comparison.i)
    ]


@declared(
    "instants", "Profiles at the probes", Need(lambda comparison: bool(comparison.times)), appendix=True
)
def section(comparison: Comparison) -> Blocks:
    """Return a figure a variant."""
    variants, _ = stated(comparison)
    return tuple(
        figure
        for number, name in enumerate(comparison.variants, start=1)
        if name in variants
        for figure in _figures(comparison, number, name)
    )
