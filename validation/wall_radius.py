"""Radius of the deformed lumen–wall interface on rays at (x_i, φ_j): numba kernels.

Two radii are needed. The *wall radius* R follows the nodes: inside a face, x, φ and r are interpolated,
so that a circle drawn with 24 sides keeps its radius. The *chord radius* is where the ray meets the flat
face: the edge of the finite-element lumen, up to which its velocity is defined.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

ROUND_OFF = 1e-12
INSIDE = 1e-7  # natural coordinates may exceed a face by this


@njit(cache=True, nogil=True, error_model="numpy")
def _bilinear(r: float, s: float, n: Array) -> None:
    n[0], n[1] = 0.25 * (1.0 - r) * (1.0 - s), 0.25 * (1.0 + r) * (1.0 - s)
    n[2], n[3] = 0.25 * (1.0 + r) * (1.0 + s), 0.25 * (1.0 - r) * (1.0 + s)


@njit(cache=True, nogil=True, error_model="numpy")
def _invert_face(a: Array, b: Array, n: Array) -> bool:
    """Shape functions n (4,) of the point of a face where Σ n a = Σ n b = 0; False if outside."""
    r, s = 0.0, 0.0
    for _ in range(25):
        _bilinear(r, s, n)
        fa = n[0] * a[0] + n[1] * a[1] + n[2] * a[2] + n[3] * a[3]
        fb = n[0] * b[0] + n[1] * b[1] + n[2] * b[2] + n[3] * b[3]
        low, high = 0.25 * (1.0 - s), 0.25 * (1.0 + s)
        ar = low * (a[1] - a[0]) + high * (a[2] - a[3])
        br = low * (b[1] - b[0]) + high * (b[2] - b[3])
        low, high = 0.25 * (1.0 - r), 0.25 * (1.0 + r)
        as_ = low * (a[3] - a[0]) + high * (a[2] - a[1])
        bs = low * (b[3] - b[0]) + high * (b[2] - b[1])
        determinant = ar * bs - as_ * br
        if not abs(determinant) > 0.0:  # the node that a triangle repeats
            return bool(abs(fa) <= ROUND_OFF * np.max(np.abs(a)) and abs(fb) <= ROUND_OFF * np.max(np.abs(b)))
        dr = (as_ * fb - bs * fa) / determinant
        ds = (br * fa - ar * fb) / determinant
        r, s = r + dr, s + ds
        if max(abs(dr), abs(ds)) < 1e-12:
            _bilinear(r, s, n)
            return bool(max(abs(r), abs(s)) <= 1.0 + INSIDE)
        if not max(abs(r), abs(s)) < 10.0:
            return False
    return False


@njit(cache=True, nogil=True, error_model="numpy")
def _wrap(angle: float) -> float:
    """Return an angle moved into [−π, π)."""
    return (angle + np.pi) % (2.0 * np.pi) - np.pi


@njit(cache=True, nogil=True, error_model="numpy")
def _on_ray(points: Array, face: Integers, x: float, phi: float, chord: bool) -> float:
    """Radius at which the ray at (x, φ) meets one face, or −1."""
    a, b, radius, n = np.empty(4), np.empty(4), np.empty(4), np.empty(4)
    cosine, sine = np.cos(phi), np.sin(phi)
    for k in range(4):
        px, py, pz = points[face[k], 0], points[face[k], 1], points[face[k], 2]
        a[k] = px - x
        if chord:
            radius[k] = py * cosine + pz * sine
            b[k] = pz * cosine - py * sine
        else:
            radius[k] = np.hypot(py, pz)
            b[k] = _wrap(np.arctan2(pz, py) - phi)
    if np.min(a) > 0.0 or np.max(a) < 0.0 or np.min(b) > 0.0 or np.max(b) < 0.0:
        return -1.0
    if np.max(b) - np.min(b) > np.pi or not _invert_face(a, b, n):
        return -1.0
    return float(n[0] * radius[0] + n[1] * radius[1] + n[2] * radius[2] + n[3] * radius[3])


@njit(cache=True, nogil=True, error_model="numpy")
def interface_radius(
    points: Array, faces: Integers, x: Array, phi: Array, chord: bool, guess: Integers, radius: Array
) -> None:
    """Radius of the interface on every ray.

    Parameters
    ----------
    points : ndarray (n_nodes, 3)
        Deformed, in the artery's frame, m.
    faces : ndarray (n_f, 4)
        Interface faces; triangles repeat their last node.
    x : ndarray (n_x,)
        m.
    phi : ndarray (n_phi,)
        rad.
    chord : bool
        Chord radius instead of wall radius.
    guess : ndarray (n_x, n_phi)
        Face tried first; receives the face found.
    radius : ndarray (n_x, n_phi)
        Receives R, m; −1 where the ray meets no face.
    """
    for i in range(x.size):
        for j in range(phi.size):
            found = _on_ray(points, faces[guess[i, j]], x[i], phi[j], chord)
            face = 0
            while found <= 0.0 and face < faces.shape[0]:
                found = _on_ray(points, faces[face], x[i], phi[j], chord)
                if found > 0.0:
                    guess[i, j] = face
                face += 1
            radius[i, j] = found
