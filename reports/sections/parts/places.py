"""Places in millimetres and degrees, and the one that stands for the artery where one must."""

import numpy as np

from cases.results.metric_row import MetricRow
from reports.result.load import Comparison
from reports.wording.numbers import SPACE, fixed


def place_words(comparison: Comparison, i: int, j: int | None = None) -> str:
    """E.g. "x = 7.6 mm, φ = 184°"; cells are counted from 1."""
    along = f"x{SPACE}={SPACE}{fixed(1e3 * float(comparison.fields['x'].values[i - 1]), 1)}{SPACE}mm"
    if j is None:
        return along
    return f"{along}, {around_words(comparison, j)}"


def degrees_words(comparison: Comparison, j: int | None) -> str:
    """E.g. "184°"; "" for a whole section."""
    return "" if j is None else f"{fixed(np.degrees(float(comparison.fields['phi'].values[j - 1])), 0)}°"


def around_words(comparison: Comparison, j: int) -> str:
    """E.g. "φ = 184°"."""
    return f"φ{SPACE}={SPACE}{degrees_words(comparison, j)}"


def row_place(comparison: Comparison, row: MetricRow) -> str:
    """Say where and when a figure was taken, e.g. "x = 7.6 mm, φ = 184°, t = 0.090 s", or ""."""
    parts = [] if row.i is None else [place_words(comparison, row.i, row.j)]
    if row.t_s is not None:
        parts.append(f"t{SPACE}={SPACE}{row.t_s:.3f}{SPACE}s")
    return ", ".join(parts)


def probe_words(comparison: Comparison, i: int) -> str:
    """Heading of a shown section: its number in the drawing of the artery, and where it is."""
    return f"{comparison.i.index(i) + 1}: {place_words(comparison, i)}"


def shown_cell(comparison: Comparison) -> tuple[int, int]:
    """Shown cell that is nearest to the middle of the calcification, or of the artery; counted from 1."""
    i, j = _middle(comparison)
    turn = comparison.n_phi
    return (
        min(comparison.i, key=lambda shown: abs(shown - i)),
        min(comparison.j, key=lambda shown: min(abs(shown - j), turn - abs(shown - j))),
    )


def _middle(comparison: Comparison) -> tuple[int, int]:
    """Cell in the middle of what is calcified in most variants, or of the artery; counted from 1."""
    often = comparison.fields["calcified"].values.astype(int).sum(axis=0)
    inside = often == often.max()
    i, j = np.nonzero(inside)
    x, phi = comparison.fields["x"].values, comparison.fields["phi"].values
    turned = np.exp(1j * phi[j])
    middle = turned.mean() if abs(turned.mean()) > 1e-6 else complex(np.exp(1j * phi[0]))
    away = np.abs(x[i] - x[i].mean()) / np.ptp(x) + np.abs(np.angle(turned / middle)) / np.pi
    nearest = int(np.argmin(away))
    return int(i[nearest]) + 1, int(j[nearest]) + 1


def in_calcification(comparison: Comparison, i: int, j: int | None) -> str:
    """Say of which variants a place is calcified; "" where of none."""
    names = [name for name in comparison.variants if comparison.calcified(name, i, j)]
    return f", calcified in {' and '.join(names)}" if names else ""
