"""Linear finite elements: shape functions, gradients and faces, as numba kernels.

Four kinds, node order as in VTK: hexahedron (8), wedge (6), tetrahedron (4), pyramid (5).
Natural coordinates: hexahedron and pyramid in [−1, 1]³, wedge in the unit triangle × [−1, 1],
tetrahedron in the unit simplex.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

HEXAHEDRON, WEDGE, TETRAHEDRON, PYRAMID = 0, 1, 2, 3

KIND_OF_VTK_TYPE = {12: HEXAHEDRON, 13: WEDGE, 10: TETRAHEDRON, 14: PYRAMID}
NODES = {HEXAHEDRON: 8, WEDGE: 6, TETRAHEDRON: 4, PYRAMID: 5}

# local nodes of each face, turning so that its normal points out of the element
FACES: dict[int, tuple[tuple[int, ...], ...]] = {
    HEXAHEDRON: ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
    WEDGE: ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
    TETRAHEDRON: ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)),
    PYRAMID: ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
}

Array = NDArray[np.float64]


@njit(cache=True, nogil=True, error_model="numpy")
def _quadrilateral(r: float, s: float, shape: Array, slope: Array) -> None:
    """Bilinear functions of (r, s) and their slopes, into entries 0–3."""
    for a in range(4):
        ra = -1.0 if a in (0, 3) else 1.0
        sa = -1.0 if a in (0, 1) else 1.0
        shape[a] = 0.25 * (1.0 + ra * r) * (1.0 + sa * s)
        slope[a, 0] = 0.25 * ra * (1.0 + sa * s)
        slope[a, 1] = 0.25 * (1.0 + ra * r) * sa


@njit(cache=True, nogil=True, error_model="numpy")
def _triangle(r: float, s: float, shape: Array, slope: Array) -> None:
    """Linear functions of (r, s) and their slopes, into entries 0–2."""
    shape[0], shape[1], shape[2] = 1.0 - r - s, r, s
    slope[0, 0], slope[0, 1] = -1.0, -1.0
    slope[1, 0], slope[1, 1] = 1.0, 0.0
    slope[2, 0], slope[2, 1] = 0.0, 1.0


@njit(cache=True, nogil=True, error_model="numpy")
def _extrude(n: int, t: float, shape: Array, slope: Array) -> None:
    """Turn n functions of (r, s) into 2n of (r, s, t), linear in t over [−1, 1]."""
    low, high = 0.5 * (1.0 - t), 0.5 * (1.0 + t)
    for a in range(n):
        base, dr, ds = shape[a], slope[a, 0], slope[a, 1]
        shape[a], shape[a + n] = base * low, base * high
        slope[a, 0], slope[a + n, 0] = dr * low, dr * high
        slope[a, 1], slope[a + n, 1] = ds * low, ds * high
        slope[a, 2], slope[a + n, 2] = -0.5 * base, 0.5 * base


@njit(cache=True, nogil=True, error_model="numpy")
def shape_functions(kind: int, natural: Array, shape: Array, slope: Array) -> int:
    """Shape functions and their slopes at a point of an element.

    Parameters
    ----------
    kind : int
        HEXAHEDRON, WEDGE, TETRAHEDRON or PYRAMID.
    natural : ndarray (3,)
        Natural coordinates.
    shape : ndarray (8,)
        Receives N_a.
    slope : ndarray (8, 3)
        Receives ∂N_a/∂natural.

    Returns
    -------
    int
        Number of nodes.
    """
    r, s, t = natural[0], natural[1], natural[2]
    if kind == TETRAHEDRON:
        _triangle(r, s, shape, slope)
        shape[0] -= t
        shape[3] = t
        for a in range(4):
            slope[a, 2] = 0.0
        slope[0, 2], slope[3, 2] = -1.0, 1.0
        slope[3, 0], slope[3, 1] = 0.0, 0.0
        return 4
    if kind == WEDGE:
        _triangle(r, s, shape, slope)
        _extrude(3, t, shape, slope)
        return 6
    _quadrilateral(r, s, shape, slope)
    _extrude(4, t, shape, slope)
    if kind == PYRAMID:  # the top face of a hexahedron drawn together into the apex
        for a in range(5, 8):
            shape[4] += shape[a]
            for k in range(3):
                slope[4, k] += slope[a, k]
        return 5
    return 8


@njit(cache=True, nogil=True, error_model="numpy")
def centre(kind: int, natural: Array) -> None:
    """Set ``natural`` to the middle of an element."""
    middle = 1.0 / 3.0 if kind == WEDGE else 0.25 if kind == TETRAHEDRON else 0.0
    natural[0], natural[1] = middle, middle
    natural[2] = 0.25 if kind == TETRAHEDRON else 0.0


@njit(cache=True, nogil=True, error_model="numpy")
def outside_by(kind: int, natural: Array) -> float:
    """How far natural coordinates lie outside their element; 0 or less inside."""
    r, s, t = float(natural[0]), float(natural[1]), float(natural[2])
    if kind == TETRAHEDRON:
        return max(max(-r, -s), max(-t, r + s + t - 1.0))
    if kind == WEDGE:
        return max(max(-r, -s), max(r + s - 1.0, abs(t) - 1.0))
    return max(max(abs(r), abs(s)), abs(t)) - 1.0
