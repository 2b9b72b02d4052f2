"""Draw the figures of docs/coupled_model.md, from the project folder: python docs/draw_coupled_model.py."""

from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib import style
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

from cases.reading.case_file import load_case_file
from reports.figures import colours
from reports.figures.canvas import STYLE, WIDTH, svg_text
from solver.case.model import grid_of
from validation.ablation.ladder import models_between
from validation.mapping.rays import rays
from validation.reference.febio.series import KIND
from validation.runs.reduced_model import run_reduced_model

ROOT = Path(__file__).parents[1]
MEMBRANE = colours.MODELS[0].colour
MODELS = {"thick wall, row pressure": colours.BEYOND, "membrane wall, section pressure": MEMBRANE}
SHOWN_ROWS = (4, 15, 25)
EDGE, MIDDLE = 39, 61  # cells along the artery


def runs() -> dict[str, xr.Dataset]:
    """Fields of the 3D run of the local calcification and of both models, at its instants."""
    case = load_case_file(ROOT / "cases/coupled.yaml").variants["local"]
    grid = grid_of(case)
    points = rays(grid.x, grid.phi)
    reference = KIND.read(case, points)
    models = models_between(case)
    found = {"3D": reference.fields}
    return found | {
        name: run_reduced_model(models[name], reference.alignment, points).fields for name in MODELS
    }


def lines(axes, fields, values, x):
    """3D as points, both models as lines."""
    axes.plot(x, values(fields["3D"]), ".", color=colours.REFERENCE, markersize=3, label="3D (FEBio)")
    for name, colour in MODELS.items():
        dashes = (None, None) if colour == MEMBRANE else (4, 2)
        axes.plot(x, values(fields[name]), color=colour, dashes=dashes, linewidth=1, label=name)


def radius_figure(fields: dict[str, xr.Dataset], state: int) -> Figure:
    """R around the artery at two sections, and along it opposite to and in the patch, at systole."""
    figure = Figure(figsize=(WIDTH, 2.3), layout="constrained")
    FigureCanvasSVG(figure)
    left, right = figure.subplots(1, 2, sharey=True)
    degrees, along = np.degrees(fields["3D"]["phi"].to_numpy()), fields["3D"]["x"].to_numpy() * 1e3
    for cell in (EDGE, MIDDLE):
        lines(left, fields, lambda run, i=cell: run["radius"][state, i - 1] * 1e3, degrees)
    for row in (1, 25):
        lines(right, fields, lambda run, j=row: run["radius"][state, :, j - 1] * 1e3, along)
    left.set(xlabel="φ (deg)", ylabel="R (mm)", title=f"sections i = {EDGE} and {MIDDLE}")
    right.set(xlabel="x (mm)", title="rows opposite to the patch (upper) and in it (lower)")
    left.set_xticks(range(0, 361, 90))
    handles, labels = left.get_legend_handles_labels()
    figure.legend(handles[:3], labels[:3], frameon=False, loc="outside upper center", ncols=3)
    return figure


def share_figure(fields: dict[str, xr.Dataset], state: int) -> Figure:
    """Flow rate of three sectors over their section's mean sector, along the artery, at systole."""
    figure = Figure(figsize=(WIDTH, 2.1), layout="constrained")
    FigureCanvasSVG(figure)
    panels = figure.subplots(1, len(SHOWN_ROWS), sharey=True)
    along = fields["3D"]["x"].to_numpy() * 1e3
    for axes, row in zip(panels, SHOWN_ROWS, strict=True):

        def share(run: xr.Dataset, j: int = row) -> xr.DataArray:
            sectors = run["sector_flow_rate"][state]
            return sectors[:, j - 1] / sectors.mean("phi")

        lines(axes, fields, share, along)
        axes.set(xlabel="x (mm)", title=f"row j = {row}")
    panels[0].set_ylabel("sector flow / mean of section")
    figure.legend(*panels[0].get_legend_handles_labels(), frameon=False, loc="outside upper center", ncols=3)
    return figure


def main() -> None:
    """Write both figures beside the page."""
    fields = runs()
    state = int(fields["3D"]["section_flow_rate"].mean("x").argmax("time"))
    with style.context(STYLE):
        for name, draw in (("radius", radius_figure), ("sectors", share_figure)):
            (ROOT / f"docs/coupled_{name}.svg").write_text(svg_text(draw(fields, state)), encoding="utf-8")


if __name__ == "__main__":
    main()
