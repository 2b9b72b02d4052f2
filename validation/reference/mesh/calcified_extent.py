"""Where a reference is calcified, beside where the case says that it is."""

from collections.abc import Sequence

import numpy as np

from cases.arrays import Floats
from cases.sections.calcification import FULL_TURN, LocalCalcification, Part
from cases.sections.case import Case
from solver.geometry.calcification import distance_around, distance_to_interval
from validation.mapping.mesh import Block

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
    parts = case.calcification.parts
    if not parts:
        if not blocks:
            return []
        return [f"the reference is calcified at {described(*extent(coordinates, blocks))}; the case is not"]
    if not blocks:
        wanted = " and ".join(described(*_stated(part)) for part in parts)
        return [f"the case is calcified at {wanted}; the reference has no calcified domain"]
    if len(parts) > 1:
        return _doubts_of_several(case, coordinates, blocks)
    (x, here), (ends, edges) = _stated(parts[0]), extent(coordinates, blocks)
    apart = np.abs(ends - x).max() > ALONG * case.geometry.length
    turned = np.abs((edges - here + np.pi) % FULL_TURN - np.pi).max() > AROUND
    whole = (edges[1] - edges[0] == FULL_TURN) != (here[1] - here[0] == FULL_TURN)
    if not (apart or turned or whole):
        return []
    return [f"the case is calcified at {described(x, here)}; the reference at {described(ends, edges)}"]


def _stated(part: Part) -> tuple[Floats, Floats]:
    """Return the ends (m) and edges (rad) of a calcified part of a case, as :func:`extent` does."""
    edges = part.phi if isinstance(part, LocalCalcification) else (0.0, FULL_TURN)
    return np.array(part.x), np.array(edges)


def _doubts_of_several(case: Case, coordinates: Floats, blocks: Sequence[Block]) -> list[str]:
    """Say which of several patches hold no calcified element, and how many elements lie in none."""
    centres = np.concatenate([coordinates[block.nodes].mean(axis=1) for block in blocks])
    x, angles = centres[:, 0], np.arctan2(centres[:, 2], centres[:, 1]) % FULL_TURN
    found, anywhere = [], np.zeros(x.size, dtype=bool)
    for part in case.calcification.parts:
        ends, edges = _stated(part)
        inside = distance_to_interval(x, ends[0], ends[1], None) <= ALONG * case.geometry.length
        if isinstance(part, LocalCalcification):
            inside &= distance_around(angles, edges[0], edges[1]) <= AROUND
        anywhere |= inside
        if not inside.any():
            found.append(f"the case is calcified at {described(ends, edges)}; the reference is not")
    outside = int(np.count_nonzero(~anywhere))
    if outside:
        found.append(f"{outside} of {x.size} calcified elements of the reference lie in no patch of the case")
    return found
