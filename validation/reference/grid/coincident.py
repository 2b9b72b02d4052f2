"""Nodes that stand at one place: copies at an interface of two meshes, or where files of one mesh meet."""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from cases.arrays import Floats, Integers

COINCIDENT = 1e-6  # share of the mesh's extent within which two nodes are one


def representatives(points: Floats, used: Integers, first: Integers) -> Integers:
    """Node that stands for each of the used ones, (n_used,): of coincident nodes one of ``first``, if any is.

    Parameters
    ----------
    points : ndarray (n_points, 3)
        Of the unloaded mesh.
    used, first : ndarray of int
        Nodes of the mesh, and those to prefer; sorted.
    """
    places = points[used]
    tolerance = COINCIDENT * float(np.ptp(places, axis=0).max())
    pairs = cKDTree(places).query_pairs(tolerance, output_type="ndarray")
    if not len(pairs):
        return used
    links = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(used.size, used.size))
    _, group = connected_components(links, directed=False)
    order = np.lexsort((used, ~np.isin(used, first)))
    groups, chosen = np.unique(group[order], return_index=True)
    best = np.empty(groups.size, dtype=np.int64)
    best[groups] = used[order[chosen]]
    return np.asarray(best[group])
