"""Where the nodes around a point stand between axis and wall: what linear elements make of a profile there.

A finite-element velocity follows a curved profile at its nodes only. To tell the profile's exponent from the
mesh, the fit compares like with like: the velocity at a point is Σ N_a v_a, so a candidate s(y; γ) is
taken as Σ N_a s(y_a; γ), with y_a = r/R of the node a and the same weights. That needs powers of y_a under
the weights N_a, a measure on [0, 1]; Gauss's rule of two points has its first four moments. It is exact
where the nodes stand on two rings, as in swept meshes, whatever the elements between them.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from cases.arrays import Floats, Integers
from validation.mapping.mesh import LumenMesh
from validation.mapping.rays import Rays
from validation.mapping.wall_radius import radius_at

RINGS = "node_rings"  # field of a reference: inner, outer and weight at the tabulated cells
COINCIDENT = 1e-12  # variance of r/R below which the nodes stand on one ring


class TwoRings(NamedTuple):
    """Nodes around points as two rings: Σ N_a f(y_a) = (1 − w) f(inner) + w f(outer); equal shapes.

    ``inner``, ``outer``: r/R of each ring; ``weight``: w of the outer one.
    """

    inner: Floats
    outer: Floats
    weight: Floats


def nodal_shares(points: Floats, mesh: LumenMesh, radius: Floats, rays: Rays, faces: Integers) -> Floats:
    """r/R of the lumen's nodes, (n_nodes,); NaN for others.

    R is the wall's at the node's own x and φ; of a node that no face of the interface is abreast of, as on
    the rim of an end that warps, that of the nearest ray.

    Parameters
    ----------
    points : ndarray (n_nodes, 3)
        Deformed nodes in the artery's frame, m.
    mesh : LumenMesh
    radius : ndarray (n_x, n_phi)
        Wall radius on the rays, m.
    rays : Rays
    faces : ndarray (n_lumen_nodes,)
        Face of the interface tried first for each node; receives the face found.
    """
    inside = points[mesh.lumen_nodes]
    phi = np.arctan2(inside[:, 2], inside[:, 1])
    wall = radius_at(points, mesh.interface, inside[:, 0], phi, faces)
    i = np.searchsorted(0.5 * (rays.x[1:] + rays.x[:-1]), inside[:, 0])
    j = np.rint((phi - rays.phi[0]) / rays.dphi).astype(np.int64) % rays.phi.size
    wall = np.where(wall > 0, wall, radius[i, j])
    shares = np.full(len(points), np.nan)
    shares[mesh.lumen_nodes] = np.minimum(np.hypot(inside[:, 1], inside[:, 2]) / wall, 1.0)
    shares[mesh.interface_nodes] = 1.0
    return shares


def two_rings(powers: Floats) -> TwoRings:
    """Gauss's rule of two points from moments.

    Parameters
    ----------
    powers : ndarray (..., 3)
        Interpolated y_a, y_a² and y_a³.
    """
    rings = TwoRings(*(np.empty(powers.shape[:-1]) for _ in range(3)))
    _gauss(powers.reshape(-1, 3), *(part.reshape(-1) for part in rings))
    return rings


@njit(cache=True, nogil=True, error_model="numpy")
def _gauss(powers: Floats, inner: Floats, outer: Floats, weight: Floats) -> None:
    for n in range(powers.shape[0]):
        mean, second, third = powers[n, 0], powers[n, 1], powers[n, 2]
        variance = second - mean**2
        lean, half, weight[n] = 0.0, 0.0, 0.0
        if variance > COINCIDENT:
            lean = 0.5 * (third - mean * (3.0 * second - 2.0 * mean**2)) / variance
            half = np.sqrt(lean**2 + variance)
            weight[n] = 0.5 * (half - lean) / half
        inner[n] = min(max(mean + lean - half, 0.0), 1.0)
        outer[n] = min(max(mean + lean + half, 0.0), 1.0)
