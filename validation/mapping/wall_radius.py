"""Radius of the deformed lumen–wall interface on rays at (x_i, φ_j).

Two radii are needed. The *wall radius* R follows the nodes: inside a face, x, φ and r are interpolated,
so that a circle drawn with 24 sides keeps its radius. The *chord radius* is where the ray meets the flat
face: the edge of the finite-element lumen, up to which its velocity is defined.

Inside a face the interpolation is a polynomial in 1, r, s, rs: of natural coordinates in [−1, 1]² for a
quadrilateral, in the unit triangle for a triangle.
"""

import numpy as np
from numba import njit

from cases.arrays import Flags, Floats, Integers

INSIDE = 1e-7  # natural coordinates may exceed a face by this
CONVERGED = 1e-8  # a Newton step this small leaves an error of about its square

_QUADRILATERAL = 0.25 * np.array([[1, 1, 1, 1], [-1, 1, 1, -1], [-1, -1, 1, 1], [1, -1, 1, -1]])
_TRIANGLE = np.array([[1, 0, 0, 0], [-1, 1, 0, 0], [-1, 0, 1, 0], [0, 0, 0, 0]], dtype=float)


def interface_radius(
    points: Floats, faces: Integers, x: Floats, phi: Floats, chord: bool, guess: Integers
) -> Floats:
    """Radius of the interface on every ray, (n_x, n_phi), m; −1 where the ray meets no face.

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
    """
    radius = np.empty(guess.shape)
    _on_rays(*_maps(points, faces, chord), x, phi, chord, guess, radius)
    return radius


def radius_at(points: Floats, faces: Integers, x: Floats, phi: Floats, guess: Integers) -> Floats:
    """Wall radius at pairs (x, φ), (n,), m; −1 where no face is met. Parameters as above, each (n,)."""
    radius = np.empty(guess.shape)
    _at_pairs(*_maps(points, faces, False), x, phi, guess, radius)
    return radius


def _maps(points: Floats, faces: Integers, chord: bool) -> tuple[Floats, Flags]:
    """Polynomials of all faces, (n_f, 4, 3), in x, y, z or x, φ, r; and which are triangles."""
    corners = points[faces]
    if not chord:
        angle = np.arctan2(corners[..., 2], corners[..., 1])
        angle = angle[:, :1] + _wrapped(angle - angle[:, :1])
        corners = np.stack([corners[..., 0], angle, np.hypot(corners[..., 1], corners[..., 2])], axis=-1)
    triangle = faces[:, 2] == faces[:, 3]
    matrices = np.where(triangle[:, None, None], _TRIANGLE, _QUADRILATERAL)
    return np.asarray(matrices @ corners), triangle


def _wrapped(angle: Floats) -> Floats:
    """Return angles moved into [−π, π)."""
    return (angle + np.pi) % (2.0 * np.pi) - np.pi


@njit(cache=True, nogil=True, error_model="numpy")
def _inside(triangle: bool, r: float, s: float) -> bool:
    if triangle:
        return bool(min(r, s) >= -INSIDE and r + s <= 1.0 + INSIDE)
    return bool(max(abs(r), abs(s)) <= 1.0 + INSIDE)


@njit(cache=True, nogil=True, error_model="numpy")
def _root(
    a: tuple[float, float, float, float], b: tuple[float, float, float, float], triangle: bool
) -> tuple[bool, float, float]:
    """Natural coordinates in a face where two polynomials vanish; False if there are none."""
    share = 1.0 + INSIDE
    if abs(a[0]) > share * (abs(a[1]) + abs(a[2]) + abs(a[3])):
        return False, 0.0, 0.0
    if abs(b[0]) > share * (abs(b[1]) + abs(b[2]) + abs(b[3])):
        return False, 0.0, 0.0
    r, s = 0.0, 0.0
    for _ in range(25):
        fa = a[0] + a[1] * r + (a[2] + a[3] * r) * s
        fb = b[0] + b[1] * r + (b[2] + b[3] * r) * s
        ar, as_ = a[1] + a[3] * s, a[2] + a[3] * r
        br, bs = b[1] + b[3] * s, b[2] + b[3] * r
        determinant = ar * bs - as_ * br
        if not abs(determinant) > 0.0:
            return False, r, s
        dr = (as_ * fb - bs * fa) / determinant
        ds = (br * fa - ar * fb) / determinant
        r, s = r + dr, s + ds
        if max(abs(dr), abs(ds)) < CONVERGED:
            return _inside(triangle, r, s), r, s
        if not max(abs(r), abs(s)) < 10.0:
            return False, r, s
    return False, r, s


@njit(cache=True, nogil=True, error_model="numpy")
def _on_face(
    c: Floats, triangle: bool, x: float, phi: float, cosine: float, sine: float, chord: bool
) -> float:
    """Radius at which the ray at (x, φ) meets one face, or −1; c (4, 3): x, y, z or x, φ, r."""
    a = (c[0, 0] - x, c[1, 0], c[2, 0], c[3, 0])
    if chord:
        b = (
            c[0, 2] * cosine - c[0, 1] * sine,
            c[1, 2] * cosine - c[1, 1] * sine,
            c[2, 2] * cosine - c[2, 1] * sine,
            c[3, 2] * cosine - c[3, 1] * sine,
        )
    else:
        b = ((c[0, 1] - phi + np.pi) % (2.0 * np.pi) - np.pi, c[1, 1], c[2, 1], c[3, 1])
    found, r, s = _root(a, b, triangle)
    if not found:
        return -1.0
    last = c[0, 2] + c[1, 2] * r + (c[2, 2] + c[3, 2] * r) * s
    if not chord:
        return float(last)
    first = c[0, 1] + c[1, 1] * r + (c[2, 1] + c[3, 1] * r) * s
    return float(first * cosine + last * sine)


@njit(cache=True, nogil=True, error_model="numpy")
def _search(
    maps: Floats,
    triangle: Flags,
    x: float,
    phi: float,
    cosine: float,
    sine: float,
    chord: bool,
    first: int,
    second: int,
) -> tuple[float, int]:
    """Radius on one ray and its face: the first guess, then the second, then all faces; −1 if none."""
    for n in range(-2, maps.shape[0]):
        face = n if n >= 0 else (first if n == -2 else second)
        found = _on_face(maps[face], triangle[face], x, phi, cosine, sine, chord)
        if found > 0.0:
            return found, face
    return -1.0, first


@njit(cache=True, nogil=True, error_model="numpy")
def _on_rays(
    maps: Floats, triangle: Flags, x: Floats, phi: Floats, chord: bool, guess: Integers, radius: Floats
) -> None:
    """Fill ``radius``: each ray tries its guess, then its neighbour's face, then all faces."""
    cosine, sine = np.cos(phi), np.sin(phi)
    for i in range(x.size):
        previous = guess[max(i - 1, 0), 0]
        for j in range(phi.size):
            radius[i, j], guess[i, j] = _search(
                maps, triangle, x[i], phi[j], cosine[j], sine[j], chord, guess[i, j], previous
            )
            previous = guess[i, j]


@njit(cache=True, nogil=True, error_model="numpy")
def _at_pairs(maps: Floats, triangle: Flags, x: Floats, phi: Floats, guess: Integers, radius: Floats) -> None:
    """Fill ``radius`` at pairs (x, φ)."""
    previous = guess[0]
    for n in range(x.size):
        radius[n], guess[n] = _search(maps, triangle, x[n], phi[n], 1.0, 0.0, False, guess[n], previous)
        previous = guess[n]
