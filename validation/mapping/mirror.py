"""A half model and its image in a plane through the artery's axis, as one whole mesh."""

from dataclasses import dataclass

import numpy as np

from cases.arrays import Floats, Integers
from validation.errors import UnusableReferenceError
from validation.mapping.elements import HEXAHEDRON, PYRAMID, TETRAHEDRON, WEDGE
from validation.mapping.mesh import Block

ON_PLANE = 1e-6  # share of the mesh's extent within which a node lies on the plane
_TURNED = {  # node order of the image, so that its faces turn outwards again
    HEXAHEDRON: (4, 5, 6, 7, 0, 1, 2, 3),
    WEDGE: (3, 4, 5, 0, 1, 2),
    TETRAHEDRON: (1, 0, 2, 3),
    PYRAMID: (0, 3, 2, 1, 4),
}


@dataclass(frozen=True)
class Mirror:
    """How nodes of a half model become those of the whole one.

    Attributes
    ----------
    normal : ndarray (3,)
        Of the plane, in the artery's frame, length 1.
    copied : ndarray (m,)
        Nodes off the plane, whose images follow after all nodes.
    image : ndarray (n_nodes,)
        Number of each node's image; its own on the plane.
    """

    normal: Floats
    copied: Integers
    image: Integers

    def vectors(self, values: Floats) -> Floats:
        """Vectors, or points, of the whole model's nodes, (n + m, 3)."""
        half = values[self.copied]
        return np.concatenate([values, half - 2.0 * (half @ self.normal)[:, None] * self.normal])

    def scalars(self, values: Floats) -> Floats:
        """Values of the whole model's nodes, (n + m,)."""
        return np.concatenate([values, values[self.copied]])

    def blocks(self, blocks: list[Block]) -> list[Block]:
        """Elements of both halves, the file's own first."""
        images = [Block(b.kind, self.image[b.nodes[:, list(_TURNED[b.kind])]]) for b in blocks]
        return [*blocks, *images]


def mirror(coordinates: Floats, used: Integers, normal: Floats) -> Mirror:
    """Mirror of a half model.

    Parameters
    ----------
    coordinates : ndarray (n_nodes, 3)
        In the artery's frame, m.
    used : ndarray of int
        Nodes of lumen and wall.
    normal : ndarray (3,)
        Normal of the plane, which holds the artery's axis.

    Raises
    ------
    UnusableReferenceError
        If the mesh lies on both sides of the plane, or has no node on it.
    """
    distance = coordinates @ normal
    tolerance = ON_PLANE * float(np.ptp(coordinates[used], axis=0).max())
    there = distance[used]
    if there.min() < -tolerance and there.max() > tolerance:
        raise UnusableReferenceError("reference.symmetry: the mesh lies on both sides of the plane")
    if not np.any(np.abs(there) <= tolerance):
        raise UnusableReferenceError("reference.symmetry: no node of the mesh lies on the plane")
    copied = np.flatnonzero(np.abs(distance) > tolerance)
    image = np.arange(len(coordinates))
    image[copied] = len(coordinates) + np.arange(copied.size)
    return Mirror(normal, copied, image)
