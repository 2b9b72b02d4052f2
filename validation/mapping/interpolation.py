"""Find the element that holds a point, and interpolate there: numba kernels on a deformed mesh."""

from typing import NamedTuple

import numpy as np
from numba import njit
from scipy.sparse import csr_array

from cases.arrays import Floats, Integers
from validation.mapping.elements import TO_POLYNOMIAL, centre, expand, outside_by

INSIDE = 1e-6  # natural coordinates may exceed their element by this: shared faces belong to both
NEAR_WALL = 5e-3  # and by this where no element holds the point: on a curved boundary
CONVERGED = 1e-7  # a Newton step this small leaves an error of about its square


class Topology(NamedTuple):
    """Elements without their coordinates.

    ``kinds`` (n_e,); ``nodes`` (n_e, 8), padded with −1; neighbours of element e (those that share a
    node) are ``neighbours[starts[e]:starts[e + 1]]``.
    """

    kinds: Integers
    nodes: Integers
    starts: Integers
    neighbours: Integers


class Shapes(NamedTuple):
    """Where elements lie in one state.

    ``maps`` (n_e, 8, 3): coefficients of the map from natural coordinates; ``low``, ``high`` (n_e, 3):
    bounding boxes widened by a tenth, m.
    """

    maps: Floats
    low: Floats
    high: Floats


class Located(NamedTuple):
    """Where points lie: ``element`` (n,), −1 if nowhere, and ``natural`` (n, 3) coordinates in it."""

    element: Integers
    natural: Floats


@njit(cache=True, nogil=True, error_model="numpy")
def _value(c: Floats, k: int, r: float, s: float, t: float) -> float:
    """Component k of a polynomial with coefficients c (8, m)."""
    plane = c[0, k] + c[2, k] * s + (c[3, k] + c[5, k] * s) * t
    return float(plane + r * (c[1, k] + c[4, k] * s + (c[6, k] + c[7, k] * s) * t))


@njit(cache=True, nogil=True, error_model="numpy")
def _slopes(c: Floats, k: int, r: float, s: float, t: float) -> tuple[float, float, float]:
    """Return the derivatives of component k by r, s and t."""
    return (
        float(c[1, k] + c[4, k] * s + (c[6, k] + c[7, k] * s) * t),
        float(c[2, k] + c[4, k] * r + (c[5, k] + c[7, k] * r) * t),
        float(c[3, k] + c[6, k] * r + (c[5, k] + c[7, k] * r) * s),
    )


@njit(cache=True, nogil=True, error_model="numpy")
def _invert(c: Floats, point: Floats, r: float, s: float, t: float) -> tuple[bool, float, float, float]:
    """Newton's method for the natural coordinates of ``point``, starting from (r, s, t).

    ``c`` (8, 3): coefficients of the element's map. Each step solves 3 × 3 equations by Cramer's rule.
    """
    for _ in range(15):
        f0, f1, f2 = (
            point[0] - _value(c, 0, r, s, t),
            point[1] - _value(c, 1, r, s, t),
            point[2] - _value(c, 2, r, s, t),
        )
        a0, b0, d0 = _slopes(c, 0, r, s, t)
        a1, b1, d1 = _slopes(c, 1, r, s, t)
        a2, b2, d2 = _slopes(c, 2, r, s, t)
        m0, m1, m2 = b1 * d2 - d1 * b2, d0 * b2 - b0 * d2, b0 * d1 - d0 * b1
        determinant = a0 * m0 + a1 * m1 + a2 * m2
        if not abs(determinant) > 0.0:
            return False, r, s, t
        scale = 1.0 / determinant
        g0, g1, g2 = f1 * d2 - d1 * f2, d0 * f2 - f0 * d2, f0 * d1 - d0 * f1
        h0, h1, h2 = b1 * f2 - f1 * b2, f0 * b2 - b0 * f2, b0 * f1 - f0 * b1
        dr = scale * (f0 * m0 + f1 * m1 + f2 * m2)
        ds = scale * (a0 * g0 + a1 * g1 + a2 * g2)
        dt = scale * (a0 * h0 + a1 * h1 + a2 * h2)
        r, s, t = r + dr, s + ds, t + dt
        step = max(max(abs(dr), abs(ds)), abs(dt))
        if step < CONVERGED:
            return True, r, s, t
        if not step < 50.0:
            return False, r, s, t
    return False, r, s, t


@njit(cache=True, nogil=True, error_model="numpy")
def _try(
    element: int, kinds: Integers, maps: Floats, point: Floats, r: float, s: float, t: float, natural: Floats
) -> float:
    """How far ``point`` lies outside ``element``, infinite where unknown; sets its natural coordinates."""
    found, r, s, t = _invert(maps[element], point, r, s, t)
    natural[0], natural[1], natural[2] = r, s, t
    return outside_by(kinds[element], r, s, t) if found else np.inf


@njit(cache=True, nogil=True, error_model="numpy")
def _in_box(element: int, shapes: Shapes, point: Floats) -> bool:
    for k in range(3):
        if point[k] < shapes.low[element, k] or point[k] > shapes.high[element, k]:
            return False
    return True


@njit(cache=True, nogil=True, error_model="numpy")
def _search_neighbours(guess: int, mesh: Topology, shapes: Shapes, point: Floats, natural: Floats) -> int:
    """Element that holds ``point`` among those that share a node with the guess; −1 if none."""
    for n in range(mesh.starts[guess], mesh.starts[guess + 1]):
        element = mesh.neighbours[n]
        if _in_box(element, shapes, point):
            r, s, t = centre(mesh.kinds[element])
            if _try(element, mesh.kinds, shapes.maps, point, r, s, t, natural) <= INSIDE:
                return int(element)
    return -1


@njit(cache=True, nogil=True, error_model="numpy")
def _search_everywhere(mesh: Topology, shapes: Shapes, point: Floats, natural: Floats) -> int:
    """Element that holds ``point``, or the nearest one if it lies just outside all; −1 if none."""
    nearest, best = -1, NEAR_WALL
    kept = np.zeros(3)
    for element in range(mesh.kinds.size):
        if _in_box(element, shapes, point):
            r, s, t = centre(mesh.kinds[element])
            distance = _try(element, mesh.kinds, shapes.maps, point, r, s, t, natural)
            if distance < best:
                nearest, best = element, distance
                kept[:] = natural
            if distance <= INSIDE:
                break
    natural[:] = kept
    return nearest


@njit(cache=True, nogil=True, error_model="numpy")
def _search(guess: int, mesh: Topology, shapes: Shapes, point: Floats, natural: Floats) -> int:
    """Element that holds ``point``, which the guess does not: a neighbour, else any; −1 if none does."""
    if guess >= 0:
        element = _search_neighbours(guess, mesh, shapes, point, natural)
        if element >= 0:
            return element
    return _search_everywhere(mesh, shapes, point, natural)


@njit(cache=True, nogil=True, error_model="numpy")
def locate(mesh: Topology, shapes: Shapes, points: Floats, located: Located) -> int:
    """Find each point's element, starting from where ``located`` says it was.

    Parameters
    ----------
    mesh : Topology
    shapes : Shapes
        Of :func:`deformed`.
    points : ndarray (n, 3)
        m; neighbours in the list should be neighbours in space.
    located : Located
        Guess on entry (element −1: none), answer on return.

    Returns
    -------
    int
        Index of the first point that lies in no element, or −1.
    """
    kinds, maps, elements, naturals = mesh.kinds, shapes.maps, located.element, located.natural
    natural = np.zeros(3)
    missing = -1
    previous = -1
    for n in range(points.shape[0]):
        guess = elements[n]
        r, s, t = naturals[n, 0], naturals[n, 1], naturals[n, 2]
        if guess < 0 and previous >= 0:
            guess = previous
            r, s, t = centre(kinds[guess])
        if guess >= 0:  # nearly always right, hence not by way of the functions above
            found, r, s, t = _invert(maps[guess], points[n], r, s, t)
            if found and outside_by(kinds[guess], r, s, t) <= INSIDE:
                elements[n], previous = guess, guess
                naturals[n, 0], naturals[n, 1], naturals[n, 2] = r, s, t
                continue
        element = _search(guess, mesh, shapes, points[n], natural)
        elements[n] = element
        naturals[n] = natural
        if element < 0 and missing < 0:
            missing = n
        if element >= 0:
            previous = element
    return missing


@njit(cache=True, nogil=True, error_model="numpy")
def _evaluate(coefficients: Floats, located: Located, values: Floats) -> None:
    for n in range(located.element.size):
        c = coefficients[located.element[n]]
        r, s, t = located.natural[n, 0], located.natural[n, 1], located.natural[n, 2]
        for k in range(values.shape[1]):
            values[n, k] = _value(c, k, r, s, t)


def deformed(mesh: Topology, coordinates: Floats) -> Shapes:
    """Elements in the state with these nodal coordinates (n_nodes, 3), m."""
    padding = mesh.nodes < 0
    corners = coordinates[np.where(padding, mesh.nodes[:, :1], mesh.nodes)]  # repeats a node there
    low, high = corners.min(axis=1), corners.max(axis=1)
    margin = 0.1 * (high - low)
    return Shapes(_polynomials(mesh, coordinates), low - margin, high + margin)


def interpolate(mesh: Topology, nodal: Floats, located: Located) -> Floats:
    """Finite-element interpolation of nodal values (n_nodes, m) at located points, (n, m)."""
    values = np.empty((located.element.size, nodal.shape[1]))
    _evaluate(_polynomials(mesh, nodal), located, values)
    return values


def _polynomials(mesh: Topology, nodal: Floats) -> Floats:
    coefficients = np.empty((mesh.kinds.size, 8, nodal.shape[1]))
    expand(mesh.kinds, mesh.nodes, np.ascontiguousarray(nodal), TO_POLYNOMIAL, coefficients)
    return coefficients


def topology(kinds: Integers, nodes: Integers, n_nodes: int) -> Topology:
    """Elements with their neighbours.

    Parameters
    ----------
    kinds : ndarray (n_e,)
        Kinds of :mod:`validation.mapping.elements`.
    nodes : ndarray (n_e, 8)
        Node indices, padded with −1.
    n_nodes : int
        Number of nodes of the mesh.
    """
    starts, neighbours = _neighbours(nodes, n_nodes)
    return Topology(kinds, nodes, starts, neighbours)


def _neighbours(nodes: Integers, n_nodes: int) -> tuple[Integers, Integers]:
    elements, columns = np.nonzero(nodes >= 0)
    ones = np.ones(elements.size, dtype=np.int32)
    incidence = csr_array((ones, (elements, nodes[elements, columns])), shape=(len(nodes), n_nodes))
    adjacency = csr_array(incidence @ incidence.T)
    adjacency.setdiag(0)
    adjacency.eliminate_zeros()
    return adjacency.indptr.astype(np.int64), adjacency.indices.astype(np.int64)
