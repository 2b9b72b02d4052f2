"""Integrals over faces of the deformed lumen: areas, flow rates, volume (2 × 2 Gauss points a face)."""

import numpy as np
from numba import njit

from cases.arrays import Floats, Integers

_GAUSS = 1.0 / np.sqrt(3.0)


@njit(cache=True, nogil=True, error_model="numpy")
def flux(points: Floats, faces: Integers, vectors: Floats) -> float:
    """∫ v · n dS over faces, n the face's own normal.

    Exact for bilinear faces and bilinear vectors. Triangles repeat their last node.

    Parameters
    ----------
    points : ndarray (n_nodes, 3)
        Deformed, m.
    faces : ndarray (n_f, 4)
        Node indices.
    vectors : ndarray (n_nodes, 3)
        Nodal vectors.
    """
    total = 0.0
    n, dr, ds = np.empty(4), np.empty(4), np.empty(4)
    for face in faces:
        for r in (-_GAUSS, _GAUSS):
            for s in (-_GAUSS, _GAUSS):
                for a in range(4):
                    ra = -1.0 if a in (0, 3) else 1.0
                    sa = -1.0 if a in (0, 1) else 1.0
                    n[a] = 0.25 * (1.0 + ra * r) * (1.0 + sa * s)
                    dr[a] = 0.25 * ra * (1.0 + sa * s)
                    ds[a] = 0.25 * (1.0 + ra * r) * sa
                first, second, vector = np.zeros(3), np.zeros(3), np.zeros(3)
                for a in range(4):
                    for k in range(3):
                        first[k] += dr[a] * points[face[a], k]
                        second[k] += ds[a] * points[face[a], k]
                        vector[k] += n[a] * vectors[face[a], k]
                total += vector[0] * (first[1] * second[2] - first[2] * second[1])
                total += vector[1] * (first[2] * second[0] - first[0] * second[2])
                total += vector[2] * (first[0] * second[1] - first[1] * second[0])
    return total


def flow_along_axis(points: Floats, faces: Integers, velocity: Floats) -> float:
    """Flow rate along +x through faces across the axis, whichever way they turn, m³/s."""
    return float(flux(points, faces, velocity) * np.sign(_axial_area(points, faces)))


def area_across_axis(points: Floats, faces: Integers) -> float:
    """Area of faces projected on the plane across the axis, m²."""
    return abs(_axial_area(points, faces))


def _axial_area(points: Floats, faces: Integers) -> float:
    along = np.zeros_like(points)
    along[:, 0] = 1.0
    return float(flux(points, faces, along))
