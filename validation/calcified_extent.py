"""Where a reference is calcified, beside where the case says that it is."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from cases.calcification import FULL_TURN, LocalCalcification, NoCalcification
from cases.schema import Case
from validation.mesh import Block

Floats = NDArray[np.float64]

ALONG = 0.02  # share of the artery's length by which the ends of both may differ
AROUND = np.radians(5.0)  # angle by which the edges of both may differ


def extent(coordinates: Floats, blocks: Sequence[Block]) -> tuple[Floats, Floats]:
    """Find the ends along the artery (m) and the edges around it (rad, first and second) of elements.

    A ring has the edges 0 and 2π.
    """
    nodes = np.unique(np.concatenate([block.nodes.ravel() for block in blocks]))
    x, y, z = coordinates[nodes].T
    angles = np.unique(np.round(np.arctan2(z, y) % FULL_TURN, 9))
    gaps = np.diff(angles, append=angles[0] + FULL_TURN)
    widest = int(np.argmax(gaps))
    ends = np.array([x.min(), x.max()])
    others = np.delete(gaps, widest)
    if others.size == 0 or gaps[widest] <= 1.5 * others.max():  # no gap but those between nodes
        return ends, np.array([0.0, FULL_TURN])
    return ends, np.array([angles[(widest + 1) % angles.size], angles[widest]])


def described(ends: Floats, edges: Floats) -> str:
    """Write an extent in words."""
    around = (
        "all around"
        if edges[1] - edges[0] == FULL_TURN
        else "φ {:.4g}° to {:.4g}°".format(*np.degrees(edges))
    )
    return f"x {1e3 * ends[0]:.4g} to {1e3 * ends[1]:.4g} mm, {around}"


def doubts(case: Case, coordinates: Floats, blocks: Sequence[Block]) -> list[str]:
    """Say how the calcified elements of a reference do not match the case's calcification.

    Parameters
    ----------
    case : Case
    coordinates : ndarray (n_nodes, 3)
        Undeformed, in the artery's frame, m.
    blocks : sequence of Block
        Calcified elements of the reference.
    """
    stated = case.calcification
    if isinstance(stated, NoCalcification):
        if not blocks:
            return []
        return [f"the reference is calcified at {described(*extent(coordinates, blocks))}; the case is not"]
    here = np.array([0.0, FULL_TURN])
    if isinstance(stated, LocalCalcification):
        here = np.array(stated.phi)
    wanted = described(np.array(stated.x), here)
    if not blocks:
        return [f"the case is calcified at {wanted}; the reference has no calcified domain"]
    ends, edges = extent(coordinates, blocks)
    apart = np.abs(ends - np.array(stated.x)).max() > ALONG * case.geometry.length
    turned = np.abs((edges - here + np.pi) % FULL_TURN - np.pi).max() > AROUND
    whole = (edges[1] - edges[0] == FULL_TURN) != (here[1] - here[0] == FULL_TURN)
    if not (apart or turned or whole):
        return []
    return [f"the case is calcified at {wanted}; the reference at {described(ends, edges)}"]
