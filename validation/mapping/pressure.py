"""Nodal pressure from element averages, by superconvergent patch recovery.

A linear function is fitted to the averages around each node and taken there (Zienkiewicz & Zhu 1992,
"The superconvergent patch recovery and a posteriori error estimates"): exact where pressure is linear,
also at inlet, outlet and wall.
"""

import numpy as np
from scipy.sparse import csr_array

from cases.arrays import Flags, Floats, Integers
from validation.mapping.interpolation import Topology

SHALLOW = 0.05  # least over largest singular value below which a patch cannot hold a slope


def element_centres(mesh: Topology, coordinates: Floats) -> Floats:
    """Mean of each element's nodes, (n_e, 3), m."""
    present = mesh.nodes >= 0
    points = np.where(present[..., None], coordinates[mesh.nodes], 0.0)
    return np.asarray(points.sum(axis=1) / present.sum(axis=1)[:, None])


def element_means(mesh: Topology, n_nodes: int) -> csr_array:
    """Matrix (n_e, n_nodes) that turns nodal values into the mean of each element's nodes."""
    elements, columns = np.nonzero(mesh.nodes >= 0)
    counts = np.bincount(elements)
    shape = (len(counts), n_nodes)
    return csr_array((1.0 / counts[elements], (elements, mesh.nodes[elements, columns])), shape=shape)


def recovery_operator(mesh: Topology, coordinates: Floats) -> csr_array:
    """Matrix (n_nodes, n_e) that turns element averages into nodal values; zero rows off the mesh.

    Parameters
    ----------
    mesh : Topology
        Elements that carry averages.
    coordinates : ndarray (n_nodes, 3)
        Where patches are fitted, m: the reference configuration.
    """
    elements, columns = np.nonzero(mesh.nodes >= 0)
    nodes = mesh.nodes[elements, columns]
    shape = (len(coordinates), len(mesh.nodes))
    touches = csr_array((np.ones(nodes.size), (nodes, elements)), shape=shape)
    adjacency = csr_array(
        (np.ones(mesh.neighbours.size), mesh.neighbours, mesh.starts), shape=(shape[1], shape[1])
    )
    centres = element_centres(mesh, coordinates)
    operator = csr_array(shape)
    pending, patches = np.unique(nodes), touches
    for _ in range(3):
        weights, shallow = _fit(patches, pending, coordinates, centres)
        operator = operator + weights
        pending = pending[shallow]
        if not pending.size:
            return csr_array(operator)
        patches = csr_array(patches + patches @ adjacency)
    return csr_array(operator + _mean_of(touches, pending))


def _mean_of(touches: csr_array, nodes: Integers) -> csr_array:
    """Plain mean of the elements at ``nodes``: meshes one element thick have no slope to recover."""
    chosen = np.zeros(touches.shape[0])
    counts = np.diff(touches.indptr)
    chosen[nodes] = 1.0 / counts[nodes]
    return csr_array(touches.multiply(chosen[:, None]))


def _fit(
    patches: csr_array,
    nodes: Integers,
    coordinates: Floats,
    centres: Floats,
) -> tuple[csr_array, Flags]:
    """Least-squares weights of each node's patch, and which nodes have too shallow a patch."""
    counts = np.diff(patches.indptr)[nodes]
    shallow = np.zeros(nodes.size, dtype=bool)
    rows, columns, values = [], [], []
    for count in np.unique(counts):
        which = np.flatnonzero(counts == count)
        group = nodes[which]
        patch = patches.indices[patches.indptr[group][:, None] + np.arange(count)]
        offset = centres[patch] - coordinates[group][:, None, :]
        scale = np.abs(offset).max(axis=1, keepdims=True)
        design = np.concatenate([np.ones((*patch.shape, 1)), offset / scale], axis=2)
        singular = np.linalg.svd(design, compute_uv=False)
        deep = (count >= 4) & (singular[:, -1] > SHALLOW * singular[:, 0])
        shallow[which] = ~deep
        weights = np.linalg.pinv(design[deep])[:, 0, :]
        rows.append(np.repeat(group[deep], count))
        columns.append(patch[deep].ravel())
        values.append(weights.ravel())
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    return csr_array(entries, shape=patches.shape), shallow
