"""Find the element that holds a point, and interpolate there: numba kernels on a deformed mesh."""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.sparse import csr_array

from validation.elements import centre, outside_by, shape_functions

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

INSIDE = 1e-6  # natural coordinates may exceed their element by this: shared faces belong to both
NEAR_WALL = 5e-3  # and by this where no element holds the point: on a curved boundary


class Topology(NamedTuple):
    """Elements without their coordinates.

    ``kinds`` (n_e,); ``nodes`` (n_e, 8), padded with −1; neighbours of element e (those that share a
    node) are ``neighbours[starts[e]:starts[e + 1]]``.
    """

    kinds: Integers
    nodes: Integers
    starts: Integers
    neighbours: Integers


class Located(NamedTuple):
    """Where points lie: ``element`` (n,), −1 if nowhere, and ``natural`` (n, 3) coordinates in it."""

    element: Integers
    natural: Array


@njit(cache=True, nogil=True, error_model="numpy")
def _solve(m: Array, b: Array) -> bool:
    """Solve the 3 × 3 system m x = b by Cramer's rule, into b; False where m is singular."""
    c0 = m[1, 1] * m[2, 2] - m[1, 2] * m[2, 1]
    c1 = m[1, 2] * m[2, 0] - m[1, 0] * m[2, 2]
    c2 = m[1, 0] * m[2, 1] - m[1, 1] * m[2, 0]
    determinant = m[0, 0] * c0 + m[0, 1] * c1 + m[0, 2] * c2
    if not abs(determinant) > 0.0:
        return False
    d0 = m[0, 2] * m[2, 1] - m[0, 1] * m[2, 2]
    d1 = m[0, 0] * m[2, 2] - m[0, 2] * m[2, 0]
    d2 = m[0, 1] * m[2, 0] - m[0, 0] * m[2, 1]
    e0 = m[0, 1] * m[1, 2] - m[0, 2] * m[1, 1]
    e1 = m[0, 2] * m[1, 0] - m[0, 0] * m[1, 2]
    e2 = m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0]
    x0 = (c0 * b[0] + d0 * b[1] + e0 * b[2]) / determinant
    x1 = (c1 * b[0] + d1 * b[1] + e1 * b[2]) / determinant
    x2 = (c2 * b[0] + d2 * b[1] + e2 * b[2]) / determinant
    b[0], b[1], b[2] = x0, x1, x2
    return True


@njit(cache=True, nogil=True, error_model="numpy")
def _linearise(
    count: int, nodes: Integers, coordinates: Array, point: Array, scratch: Array, change: Array
) -> None:
    """Distance from the mapped point to ``point``, into ``change``; the mapping's Jacobian, into scratch."""
    shape, slope, jacobian = scratch[:, 0], scratch[:, 1:4], scratch[0:3, 4:7]
    for k in range(3):
        change[k] = point[k]
        for m in range(3):
            jacobian[k, m] = 0.0
    for a in range(count):
        node = nodes[a]
        for k in range(3):
            change[k] -= shape[a] * coordinates[node, k]
            for m in range(3):
                jacobian[k, m] += coordinates[node, k] * slope[a, m]


@njit(cache=True, nogil=True, error_model="numpy")
def _invert(
    kind: int, nodes: Integers, coordinates: Array, point: Array, natural: Array, scratch: Array
) -> bool:
    """Newton's method for the natural coordinates of ``point``, starting from ``natural``."""
    change = scratch[3:6, 4]
    for _ in range(15):
        count = shape_functions(kind, natural, scratch[:, 0], scratch[:, 1:4])
        _linearise(count, nodes, coordinates, point, scratch, change)
        if not _solve(scratch[0:3, 4:7], change):
            return False
        step = 0.0
        for k in range(3):
            natural[k] += change[k]
            step = max(step, abs(change[k]))
        if step < 1e-9:
            return True
        if not step < 50.0:
            return False
    return False


@njit(cache=True, nogil=True, error_model="numpy")
def _try(
    element: int, mesh: Topology, coordinates: Array, point: Array, natural: Array, scratch: Array
) -> float:
    """How far ``point`` lies outside ``element`` in natural coordinates; infinite where unknown."""
    kind = mesh.kinds[element]
    if not _invert(kind, mesh.nodes[element], coordinates, point, natural, scratch):
        return np.inf
    return outside_by(kind, natural)


@njit(cache=True, nogil=True, error_model="numpy")
def _in_box(nodes: Integers, coordinates: Array, point: Array) -> bool:
    """Whether ``point`` lies in the bounding box of an element, widened by a tenth."""
    for k in range(3):
        low, high = np.inf, -np.inf
        for node in nodes:
            if node >= 0:
                low = min(low, coordinates[node, k])
                high = max(high, coordinates[node, k])
        margin = 0.1 * (high - low)
        if point[k] < low - margin or point[k] > high + margin:
            return False
    return True


@njit(cache=True, nogil=True, error_model="numpy")
def _search_neighbours(
    guess: int, mesh: Topology, coordinates: Array, point: Array, natural: Array, scratch: Array
) -> int:
    """Element that holds ``point`` among those that share a node with the guess; −1 if none."""
    for n in range(mesh.starts[guess], mesh.starts[guess + 1]):
        element = mesh.neighbours[n]
        centre(mesh.kinds[element], natural)
        if _try(element, mesh, coordinates, point, natural, scratch) <= INSIDE:
            return int(element)
    return -1


@njit(cache=True, nogil=True, error_model="numpy")
def _search_everywhere(
    mesh: Topology, coordinates: Array, point: Array, natural: Array, scratch: Array
) -> int:
    """Element that holds ``point``, or the nearest one if it lies just outside all; −1 if none."""
    nearest, best = -1, NEAR_WALL
    kept = np.zeros(3)
    for element in range(mesh.kinds.size):
        if _in_box(mesh.nodes[element], coordinates, point):
            centre(mesh.kinds[element], natural)
            distance = _try(element, mesh, coordinates, point, natural, scratch)
            if distance < best:
                nearest, best = element, distance
                kept[:] = natural
            if distance <= INSIDE:
                break
    natural[:] = kept
    return nearest


@njit(cache=True, nogil=True, error_model="numpy")
def _search(
    guess: int, mesh: Topology, coordinates: Array, point: Array, natural: Array, scratch: Array
) -> int:
    """Element that holds ``point``: the guess, else a neighbour of it, else any; −1 if none does."""
    if guess >= 0:
        if _try(guess, mesh, coordinates, point, natural, scratch) <= INSIDE:
            return guess
        element = _search_neighbours(guess, mesh, coordinates, point, natural, scratch)
        if element >= 0:
            return element
    return _search_everywhere(mesh, coordinates, point, natural, scratch)


@njit(cache=True, nogil=True, error_model="numpy")
def locate(mesh: Topology, coordinates: Array, points: Array, located: Located) -> int:
    """Find each point's element, starting from where ``located`` says it was.

    Parameters
    ----------
    mesh : Topology
    coordinates : ndarray (n_nodes, 3)
        Deformed, m.
    points : ndarray (n, 3)
        m; neighbours in the list should be neighbours in space.
    located : Located
        Guess on entry (element −1: none), answer on return.

    Returns
    -------
    int
        Index of the first point that lies in no element, or −1.
    """
    scratch = np.zeros((8, 8))
    natural = np.empty(3)
    missing = -1
    previous = -1
    for n in range(points.shape[0]):
        guess = located.element[n]
        if guess >= 0:
            natural[:] = located.natural[n]
        else:
            guess = previous
            if guess >= 0:
                centre(mesh.kinds[guess], natural)
        element = _search(guess, mesh, coordinates, points[n], natural, scratch)
        located.element[n] = element
        located.natural[n] = natural
        if element < 0 and missing < 0:
            missing = n
        if element >= 0:
            previous = element
    return missing


@njit(cache=True, nogil=True, error_model="numpy")
def interpolate(mesh: Topology, nodal: Array, located: Located, values: Array) -> None:
    """Finite-element interpolation of nodal values (n_nodes, m) at located points, into (n, m)."""
    shape, slope = np.zeros(8), np.zeros((8, 3))
    for n in range(located.element.size):
        element = located.element[n]
        count = shape_functions(mesh.kinds[element], located.natural[n], shape, slope)
        for k in range(nodal.shape[1]):
            total = 0.0
            for a in range(count):
                total += shape[a] * nodal[mesh.nodes[element, a], k]
            values[n, k] = total


def topology(kinds: NDArray[np.int64], nodes: NDArray[np.int64], n_nodes: int) -> Topology:
    """Elements with their neighbours.

    Parameters
    ----------
    kinds : ndarray (n_e,)
        Kinds of :mod:`validation.elements`.
    nodes : ndarray (n_e, 8)
        Node indices, padded with −1.
    n_nodes : int
        Number of nodes of the mesh.
    """
    starts, neighbours = _neighbours(nodes, n_nodes)
    return Topology(kinds, nodes, starts, neighbours)


def _neighbours(nodes: NDArray[np.int64], n_nodes: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    elements, columns = np.nonzero(nodes >= 0)
    ones = np.ones(elements.size, dtype=np.int32)
    incidence = csr_array((ones, (elements, nodes[elements, columns])), shape=(len(nodes), n_nodes))
    adjacency = csr_array(incidence @ incidence.T)
    adjacency.setdiag(0)
    adjacency.eliminate_zeros()
    return adjacency.indptr.astype(np.int64), adjacency.indices.astype(np.int64)
