"""Cost of runs against their error."""

from collections.abc import Mapping

from matplotlib import style
from matplotlib.figure import Figure

from cases.arrays import Floats
from reports.figures import colours
from reports.figures.canvas import STYLE, WIDTH, svg_text

_MARKERS = ("o", "s", "^", "D", "v")
_COLOURS = (*(stroke.colour for stroke in colours.MODELS), colours.BEYOND, colours.REFERENCE)


def work_precision(lines: Mapping[str, Mapping[str, tuple[Floats, Floats]]], tolerance: float) -> str:
    """Draw errors over costs as SVG, with a line at a tolerance.

    Parameters
    ----------
    lines : mapping of str to mapping of str to (ndarray (n,), ndarray (n,))
        For each model (a panel) and line, processor seconds and relative errors.
    tolerance : float
        Relative error to be kept.
    """
    names = list(dict.fromkeys(name for panel in lines.values() for name in panel))
    with style.context(["default", STYLE]):
        figure = Figure(figsize=(WIDTH, 3.0), layout="constrained")
        axes = figure.subplots(1, len(lines), sharey=True, squeeze=False)[0]
        for axis, (title, panel) in zip(axes, lines.items(), strict=True):
            for name, (costs, errors) in panel.items():
                kind = names.index(name) % len(_MARKERS)
                axis.loglog(
                    costs, errors, marker=_MARKERS[kind], color=_COLOURS[kind], markersize=3, linewidth=0.8,
                    label=name,
                )  # fmt: skip
            axis.axhline(tolerance, color=colours.QUIET, linewidth=0.6, linestyle=(0, (3, 2)))
            axis.set(title=title, xlabel="processor time of a run (s)")
            axis.grid(which="major", color=colours.GRID, linewidth=0.4)
        axes[0].set_ylabel("largest relative error of an output")
        axes[0].legend(fontsize=6.5, frameon=False)
        return svg_text(figure)
