"""Forces and stiffness of a solid wall's elements (numba kernels)."""

import numpy as np

from cases.arrays import Flags, Floats, Integers
from solver.schemes.vectorisation import allocating_kernel, inlined_kernel, kernel


@allocating_kernel
def add_elements(
    nodes: Integers,
    gradients: Floats,
    weights: Floats,
    lame: Floats,
    moved: Floats,
    force: Floats,
    band: Floats,
) -> None:
    """Add what Saint Venant–Kirchhoff elements resist: S = λ tr(E) I + 2μE, E = ½(FᵀF − I), no axial motion.

    Parameters
    ----------
    nodes : ndarray (n_e, 8)
    gradients : ndarray (n_e, q, 8, 3)
        Of the shape functions at quadrature points, 1/m.
    weights : ndarray (n_e, q)
        Volumes of quadrature points, m³.
    lame : ndarray (n_e, 2)
        λ and μ, Pa.
    moved : ndarray (n_nodes, 2)
        Displacements across the axis, m.
    force : ndarray (2 n_nodes,)
        Added to, N.
    band : ndarray (2 n_nodes, width)
        Its derivative with the displacements, K[j + k, j] at [j, k], added to, N/m.
    """
    deformation, left = np.empty((2, 3)), np.empty((2, 2))
    push, pull = np.empty((8, 2)), np.empty((8, 3))
    for e in range(nodes.shape[0]):
        for q in range(weights.shape[1]):
            slope = gradients[e, q]
            _deform(nodes[e], slope, moved, deformation, left)
            _stress(lame[e], slope, deformation, push, pull)
            for a in range(8):
                for i in range(2):
                    for k in range(3):
                        force[2 * nodes[e, a] + i] += weights[e, q] * deformation[i, k] * pull[a, k]
                for b in range(8):
                    if nodes[e, b] >= nodes[e, a]:
                        _add_pair(nodes[e], a, b, weights[e, q], lame[e], slope, left, push, pull, band)


@inlined_kernel
def _deform(nodes: Integers, slope: Floats, moved: Floats, deformation: Floats, left: Floats) -> None:
    """Set F, its rows across the axis, and those of FFᵀ."""
    for i in range(2):
        for k in range(3):
            deformation[i, k] = 1.0 if i == k else 0.0
            for a in range(8):
                deformation[i, k] += moved[nodes[a], i] * slope[a, k]
    for i in range(2):
        for n in range(2):
            left[i, n] = 0.0
            for k in range(3):
                left[i, n] += deformation[i, k] * deformation[n, k]


@inlined_kernel
def _stress(lame: Floats, slope: Floats, deformation: Floats, push: Floats, pull: Floats) -> None:
    """Set F and S = λ tr(E) I + 2μE times the gradients of the shape functions."""
    trace = -1.0
    for i in range(2):
        for k in range(3):
            trace += 0.5 * deformation[i, k] * deformation[i, k]
    for a in range(8):
        for i in range(2):
            push[a, i] = 0.0
            for k in range(3):
                push[a, i] += deformation[i, k] * slope[a, k]
        for k in range(3):
            twice = push[a, 0] * deformation[0, k] + push[a, 1] * deformation[1, k]
            if k < 2:
                twice -= slope[a, k]
            pull[a, k] = lame[0] * trace * slope[a, k] + lame[1] * twice


@inlined_kernel
def _add_pair(
    nodes: Integers,
    a: int,
    b: int,
    weight: float,
    lame: Floats,
    slope: Floats,
    left: Floats,
    push: Floats,
    pull: Floats,
    band: Floats,
) -> None:
    """Add the stiffness between two nodes of an element, the second not before the first."""
    geometric, both = 0.0, 0.0
    for k in range(3):
        geometric += slope[b, k] * pull[a, k]
        both += slope[a, k] * slope[b, k]
    for i in range(2):
        for n in range(2):
            column, row = 2 * nodes[a] + i, 2 * nodes[b] + n
            if row >= column:
                value = lame[0] * push[a, i] * push[b, n]
                value += lame[1] * (push[b, i] * push[a, n] + left[i, n] * both)
                if i == n:
                    value += geometric
                band[column, row - column] += weight * value


@kernel
def add_pressure(
    rings: Integers, load: Floats, position: Floats, share: Floats, force: Floats, band: Floats
) -> None:
    """Take off what pressure does: the derivatives of Σ p ∫ A dx over the stacks, A the lumen's polygon.

    Parameters
    ----------
    rings : ndarray (n + 1, m)
        Nodes of the lumen by planes.
    load : ndarray (n,)
        p times the length of each stack, N/m.
    position : ndarray (n_nodes, 2)
        Deformed, m.
    share : ndarray (2, 2)
        Of the products of the planes before and after a stack in its mean.
    force, band : ndarray
        As :func:`add_elements`.
    """
    for s in range(load.size):
        for j in range(rings.shape[1]):
            following = (j + 1) % rings.shape[1]
            for before in range(2):
                for after in range(2):
                    a, b = rings[s + before, j], rings[s + after, following]
                    half = 0.5 * load[s] * share[before, after]
                    force[2 * a] -= half * position[b, 1]
                    force[2 * a + 1] += half * position[b, 0]
                    force[2 * b + 1] -= half * position[a, 0]
                    force[2 * b] += half * position[a, 1]
                    _add(band, 2 * a, 2 * b + 1, -half)
                    _add(band, 2 * a + 1, 2 * b, half)


@kernel
def _add(band: Floats, one: int, other: int, value: float) -> None:
    first = min(one, other)
    band[first, max(one, other) - first] += value


@kernel
def hold(held: Flags, force: Floats, band: Floats) -> None:
    """Make the equations of what is held u = 0."""
    for column in range(band.shape[0]):
        for k in range(band.shape[1]):
            row = column + k
            if row < held.size and (held[column] or held[row]):
                band[column, k] = 1.0 if k == 0 else 0.0
        if held[column]:
            force[column] = 0.0
