"""Linear finite elements: their interpolation as one polynomial, and their faces.

Four kinds, node order as in VTK: hexahedron (8), wedge (6), tetrahedron (4), pyramid (5).
Natural coordinates (r, s, t): hexahedron and pyramid in [−1, 1]³, wedge in the unit triangle × [−1, 1],
tetrahedron in the unit simplex. In all of them interpolation is a polynomial in the eight monomials
1, r, s, t, rs, st, rt, rst; only its coefficients tell the kinds apart.
"""

import numpy as np
from numba import njit

from cases.arrays import Floats, Integers

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


_POWERS = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (0, 1, 1), (1, 0, 1), (1, 1, 1))
_CUBE = ((-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1))
_PRISM = ((0, 0, -1), (1, 0, -1), (0, 1, -1), (0, 0, 1), (1, 0, 1), (0, 1, 1))
_SIMPLEX = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))


def _coefficients(corners: tuple[tuple[int, ...], ...], monomials: list[int]) -> Floats:
    """Matrix (8, 8) from values at corners (natural coordinates) to coefficients of some monomials."""
    powers = np.array([_POWERS[m] for m in monomials])
    values = np.prod(np.array(corners, dtype=float)[:, None, :] ** powers, axis=2)
    matrix = np.zeros((8, 8))
    matrix[monomials, : len(corners)] = np.linalg.inv(values)
    return matrix


def _collapsed(matrix: Floats) -> Floats:
    """Matrix of a pyramid: the top face of a hexahedron drawn together into the apex."""
    found = np.zeros_like(matrix)
    found[:, :4] = matrix[:, :4]
    found[:, 4] = matrix[:, 4:].sum(axis=1)
    return found


_HEXAHEDRON = _coefficients(_CUBE, list(range(8)))
TO_POLYNOMIAL = np.stack(  # by kind: coefficients (8,) = matrix @ nodal values (8,)
    [
        _HEXAHEDRON,
        _coefficients(_PRISM, [0, 1, 2, 3, 5, 6]),
        _coefficients(_SIMPLEX, [0, 1, 2, 3]),
        _collapsed(_HEXAHEDRON),
    ]
)


@njit(cache=True, nogil=True, error_model="numpy")
def expand(kinds: Integers, nodes: Integers, nodal: Floats, matrices: Floats, coefficients: Floats) -> None:
    """Coefficients of the interpolation in every element.

    Parameters
    ----------
    kinds : ndarray (n_e,)
        HEXAHEDRON, WEDGE, TETRAHEDRON or PYRAMID.
    nodes : ndarray (n_e, 8)
        Node indices, padded with −1.
    nodal : ndarray (n_nodes, m)
        Nodal values.
    matrices : ndarray (4, 8, 8)
        TO_POLYNOMIAL.
    coefficients : ndarray (n_e, 8, m)
        Receives the coefficients of 1, r, s, t, rs, st, rt, rst.
    """
    coefficients[:] = 0.0
    for e in range(kinds.size):
        for a in range(8):
            node = nodes[e, a]
            if node < 0:
                break
            for m in range(8):
                weight = matrices[kinds[e], m, a]
                if weight != 0.0:
                    for k in range(nodal.shape[1]):
                        coefficients[e, m, k] += weight * nodal[node, k]


@njit(cache=True, nogil=True, error_model="numpy")
def centre(kind: int) -> tuple[float, float, float]:
    """Natural coordinates of the middle of an element."""
    if kind == TETRAHEDRON:
        return 0.25, 0.25, 0.25
    if kind == WEDGE:
        return 1.0 / 3.0, 1.0 / 3.0, 0.0
    return 0.0, 0.0, 0.0


@njit(cache=True, nogil=True, error_model="numpy")
def outside_by(kind: int, r: float, s: float, t: float) -> float:
    """How far natural coordinates lie outside their element; 0 or less inside."""
    if kind == TETRAHEDRON:
        return max(max(-r, -s), max(-t, r + s + t - 1.0))
    if kind == WEDGE:
        return max(max(-r, -s), max(r + s - 1.0, abs(t) - 1.0))
    return max(max(abs(r), abs(s)), abs(t)) - 1.0
