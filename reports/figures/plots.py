"""Plots of studies, which are no reports: convergence of numbers, figures of the thesis."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from cases.arrays import Floats

_LEAST_CHANGE = 1e-16  # a logarithmic axis has no zero


@dataclass(frozen=True)
class Plot:
    """One plot of some lines.

    Attributes
    ----------
    title, x_label, y_label : str
        With units.
    lines : sequence of (str, ndarray, ndarray)
        Label ("" for none), abscissas and ordinates of each.
    points : bool
        Whether only their points are drawn.
    guides : (float, float), optional
        Where a horizontal and a vertical line tell what is expected.
    """

    title: str
    x_label: str
    y_label: str
    lines: Sequence[tuple[str, Floats, Floats]]
    points: bool = False
    guides: tuple[float, float] | None = None


def stacked_plots(plots: Sequence[Plot], size: tuple[float, float], path: Path) -> Path:
    """Draw plots with one abscissa from top to bottom, `size` in inches, into `path`; return it."""
    figure = Figure(figsize=size, layout="constrained")
    for axes, plot in zip(
        figure.subplots(len(plots), 1, sharex=True, squeeze=False)[:, 0], plots, strict=True
    ):
        style = {"marker": ".", "markersize": 3, "linestyle": "none"} if plot.points else {"linewidth": 0.8}
        for label, x, y in plot.lines:
            axes.plot(x, y, label=label, **style)
        if plot.guides:
            axes.axhline(plot.guides[0], color="0.6", linewidth=0.8)
            axes.axvline(plot.guides[1], color="0.6", linewidth=0.8, linestyle="--")
        axes.set(xlabel=plot.x_label, ylabel=plot.y_label, title=plot.title)
        if any(label for label, _, _ in plot.lines):
            axes.legend(fontsize="x-small", ncols=2)
    figure.savefig(path, dpi=150)
    return path


def convergence_plots(found: Mapping[tuple[str, str], Sequence[tuple[str, Floats]]], path: Path) -> None:
    """Draw the change of numbers from level to level, with slopes of orders 1 and 2.

    Parameters
    ----------
    found : mapping of (str, str) to sequence of (str, ndarray of shape (n,))
        For each variant (a row) and study (a column), symbol and values on its levels, coarse to fine.
    path : Path
        Of the SVG.
    """
    variants, studies = (list(dict.fromkeys(names)) for names in zip(*found, strict=True))
    figure = Figure(figsize=(9.0, 3.2 * len(variants)))
    axes = figure.subplots(len(variants), len(studies), squeeze=False, sharey=True)
    for (variant, study), numbers in found.items():
        axis = axes[variants.index(variant), studies.index(study)]
        for symbol, values in numbers:
            changes = np.abs(np.diff(values)) / max(abs(values[-1]), np.finfo(float).tiny)
            axis.loglog([1.0, 0.5], np.maximum(changes, _LEAST_CHANGE), "o-", label=symbol)
        for order, style in ((1, ":"), (2, "--")):
            axis.loglog([1.0, 0.5], [1e-3, 1e-3 * 0.5**order], style, color="0.5", label=f"order {order}")
        axis.invert_xaxis()
        axis.set_title(f"{variant}: {study}")
        axis.set_xlabel("finer level's spacing over the case's own")
        axis.set_ylabel("relative change")
    axes[0, 0].legend(fontsize=7, ncols=2)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
