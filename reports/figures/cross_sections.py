"""Cross-sections to scale: the axial velocity within the lumen in 3D, in each model, and their difference."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib import style
from matplotlib.axes import Axes

from cases.arrays import Flags, Floats
from reports.figures import sheet
from reports.figures.canvas import STYLE, WIDTH, svg_text
from reports.figures.colour_scale import Scale, bar, scale_of
from reports.figures.colours import MODELS, REFERENCE, Stroke
from reports.figures.lumen_cells import edges_of, runs

_LEFT, _RIGHT, _TOP, _BOTTOM = 0.22, 0.10, 0.50, 0.26
_BAR_ROOM = 0.66  # inches; a colour bar with its numbers
_LARGEST = 1.2  # inches; of a panel
_LEVELS = 12
_MARGIN, _WALL = 1.14, 0.95  # a panel's half over the largest radius; where in it the calcification is
_CALCIFICATION = "#b08d57"


@dataclass(frozen=True)
class Disc:
    """One model's lumen and axial velocity in a section.

    Attributes
    ----------
    radius : ndarray, shape (phi,)
        Of the lumen (mm).
    velocity : ndarray, shape (phi, y)
        Axial velocity in display units at shares y of the radius.
    """

    radius: Floats
    velocity: Floats


@dataclass(frozen=True)
class Section:
    """One section: its label, 3D, the reduced models, and the rows of cells that are calcified."""

    label: str
    reference: Disc
    models: tuple[Disc, ...]
    calcified: Flags


def cross_sections(
    phi: Floats,
    share: Floats,
    sections: Sequence[Section],
    models: Sequence[str],
    unit: str,
    reference: str = "3D",
) -> str:
    """Draw a row a section: 3D and each model in one scale, then each model minus 3D in one around zero.

    The lumens are to scale, seen against the flow, φ = 0 on the right and counted upwards. A difference is
    drawn in the lumen of 3D, of values at equal φ and r/R; both outlines are drawn there.

    Parameters
    ----------
    phi, share : ndarray
        Angles of the cells (rad), shares of the radius r/R from 0 to 1.
    sections : sequence of Section
        From top to bottom.
    models : sequence of str
        Names of the reduced models.
    unit : str
        Of the velocity.
    reference : str
        Name of the reference.

    Returns
    -------
    str
        SVG; the same text for the same input.
    """
    with style.context(STYLE):
        count = len(models)
        diameter = (WIDTH - _LEFT - _RIGHT - 2 * _BAR_ROOM) / (1 + 2 * count)
        diameter = min(diameter, _LARGEST)
        total = _TOP + _BOTTOM + diameter * len(sections)
        figure, axis = sheet.sheet(total)
        discs = [disc for section in sections for disc in (section.reference, *section.models)]
        most = _MARGIN * max(float(np.nanmax(disc.radius)) for disc in discs)
        fields = scale_of([disc.velocity for disc in discs], False)
        apart = [[m.velocity - s.reference.velocity for m in s.models] for s in sections]
        differences = scale_of([values for line in apart for values in line], True)
        lefts = [_LEFT + k * diameter + (_BAR_ROOM if k > count else 0.0) for k in range(1 + 2 * count)]
        for number, section in enumerate(sections):
            bottom = total - _TOP - (number + 1) * diameter
            panels = [
                sheet.Panel(left, bottom, diameter, diameter, (-most, most), (-most, most)) for left in lefts
            ]
            lumens = [section.reference, *section.models]
            for panel, disc in zip(panels, lumens, strict=False):
                _fill(axis, panel, phi, share, disc.radius, disc.velocity, fields)
            for panel, values in zip(panels[count + 1 :], apart[number], strict=True):
                _fill(axis, panel, phi, share, section.reference.radius, values, differences)
            _outlines(axis, panels, phi, section)
            sheet.upright(axis, 0.10, bottom + diameter / 2, section.label)
            if number == 0:
                apart_names = [f"{name} − {reference}" for name in models]
                sheet.headings(axis, panels, [reference, *models, *apart_names])
        height = 0.8 * diameter * min(len(sections), 2)
        middle = _BOTTOM + diameter * len(sections) / 2 - height / 2
        bar(axis, (lefts[count] + diameter + 0.03, middle, height), fields, f"$v_x$ ({unit})")
        bar(axis, (lefts[-1] + diameter + 0.03, middle, height), differences, f"difference ({unit})")
        _legend(axis, sections, models, reference, total - 0.12)
        _length(axis, panels[0])
        return svg_text(figure)


def _around(phi: Floats, values: Floats) -> tuple[Floats, Floats]:
    """Angles and values, (n,) and (n, ...), once around and closed; one row of cells stands for all."""
    if phi.size == 1:
        return np.linspace(0.0, 2 * np.pi, 49), np.repeat(values, 49, axis=0)
    return np.append(phi, phi[0]), np.append(values, values[:1], axis=0)


def _fill(
    axis: Axes, panel: sheet.Panel, phi: Floats, share: Floats, radius: Floats, values: Floats, scale: Scale
) -> None:
    """Fill a lumen with contours of values of shape (phi, y)."""
    if not np.isfinite(values).any():
        return
    angle, closed = _around(phi, values)
    length = _around(phi, radius)[1][:, None] * share
    filled = axis.contourf(
        panel.across(length * np.cos(angle)[:, None]),
        panel.up(length * np.sin(angle)[:, None]),
        np.ma.masked_invalid(closed),
        levels=np.linspace(*scale.ends, _LEVELS + 1),
        norm=scale.norm,
        cmap=scale.colours,
        extend="both",
    )
    filled.set_zorder(0.5)


def _outlines(axis: Axes, panels: Sequence[sheet.Panel], phi: Floats, section: Section) -> None:
    """Draw the lumen of 3D in every panel, a model's where it is shown, and the calcified wall."""
    count = len(section.models)
    _lumen(axis, panels, phi, section.reference.radius, Stroke(REFERENCE, "-"))
    for number, (stroke, disc) in enumerate(zip(MODELS, section.models, strict=False)):
        _lumen(axis, [panels[1 + number], panels[1 + count + number]], phi, disc.radius, stroke)
    edges = edges_of(phi) if phi.size > 1 else np.array([0.0, 2 * np.pi])
    for first, last in runs(section.calcified):
        angle = np.linspace(edges[first], edges[last], 60)
        length = np.full(angle.shape, _WALL * panels[0].x[1])
        sheet.curves(
            axis,
            panels,
            [length * np.cos(angle)] * len(panels),
            [length * np.sin(angle)] * len(panels),
            color=_CALCIFICATION,
            linewidth=2.6,
            solid_capstyle="butt",
        )


def _lumen(axis: Axes, panels: Sequence[sheet.Panel], phi: Floats, radius: Floats, stroke: Stroke) -> None:
    angle, length = _around(phi, radius)
    across, up = [length * np.cos(angle)] * len(panels), [length * np.sin(angle)] * len(panels)
    sheet.curves(axis, panels, across, up, color=stroke.colour, linestyle=stroke.dashes, linewidth=1.0)


def _legend(
    axis: Axes, sections: Sequence[Section], models: Sequence[str], reference: str, up: float
) -> None:
    keys = [sheet.Key(f"lumen in {reference}", REFERENCE, "-")]
    keys += [sheet.Key(f"in {name}", s.colour, s.dashes) for s, name in zip(MODELS, models, strict=False)]
    if any(section.calcified.any() for section in sections):
        keys.append(sheet.Key("calcified wall", fill=_CALCIFICATION))
    sheet.legend(axis, keys, _LEFT, up)


def _length(axis: Axes, panel: sheet.Panel) -> None:
    """Draw a bar of one millimetre below the first section."""
    ends = panel.across(np.array([-0.5, 0.5])) + 0.1
    sheet.line(axis, ends, [0.12, 0.12], color="#000000", linewidth=1.0)
    axis.text(float(ends[1]) + 0.05, 0.12, "1 mm; $φ$ = 0 on the right, 90° above", va="center", fontsize=6.5)
