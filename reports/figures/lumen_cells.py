"""Cells of the unrolled lumen: their edges, and the borders of those that are inside something."""

import numpy as np

from cases.arrays import Flags, Floats


def cell_borders(x: Floats, phi: Floats, inside: Flags) -> Floats:
    """Borders between cells that are inside and cells that are not, as straight segments.

    Parameters
    ----------
    x, phi : ndarray, shapes (n_x + 1,), (n_phi + 1,)
        Edges of the cells.
    inside : ndarray of bool, shape (n_x, n_phi)
        Which cells are inside.

    Returns
    -------
    ndarray, shape (n, 2, 2)
        Ends of the segments, (x, φ) each. φ is not continued around the artery: where the inside reaches
        the first or last row, no border is drawn there.
    """
    across = np.argwhere(inside[1:] != inside[:-1])  # between i and i + 1
    along = np.argwhere(inside[:, 1:] != inside[:, :-1])
    return np.concatenate(
        [
            np.array([[(x[i + 1], phi[j]), (x[i + 1], phi[j + 1])] for i, j in across]).reshape(-1, 2, 2),
            np.array([[(x[i], phi[j + 1]), (x[i + 1], phi[j + 1])] for i, j in along]).reshape(-1, 2, 2),
        ]
    )


def edges_of(centres: Floats) -> Floats:
    """Edges of cells with these centres."""
    if centres.size == 1:
        return np.array([centres[0] - 0.5, centres[0] + 0.5])
    middle = (centres[1:] + centres[:-1]) / 2
    first, last = centres[0] - (middle[0] - centres[0]), centres[-1] + (centres[-1] - middle[-1])
    return np.concatenate([[first], middle, [last]])


def runs(inside: Flags) -> list[tuple[int, int]]:
    """First number and number behind the last of each run of True, of a flag array of shape (n,)."""
    steps = np.flatnonzero(np.diff(np.concatenate([[False], inside, [False]])))
    return [(int(first), int(last)) for first, last in steps.reshape(-1, 2)]


def uniform(values: Floats, tolerance: float) -> float | None:
    """Mean of the finite values if they differ by less than this, None otherwise and where there are none."""
    finite = values[np.isfinite(values)]
    if finite.size == 0 or float(np.ptp(finite)) >= tolerance:
        return None
    return float(finite.mean())
