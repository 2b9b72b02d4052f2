"""Which elements of the wall are calcified, and the extent that they really have."""

from dataclasses import dataclass

import numpy as np

from cases.arrays import Flags, Floats
from febio_io.feb.model import FebioModelError, MeshSize, Patch, Vessel

ROUND_OFF = 1e-9  # of a length or a turn
FULL_TURN = 2.0 * np.pi


@dataclass(frozen=True)
class Calcified:
    """The calcified elements of the wall.

    Attributes
    ----------
    elements : (n_wall_elements,) bool array
        In the order of the mesh's wall elements.
    warning : str or None
        What the patch has become, where the mesh has no element edges at its own.
    """

    elements: Flags
    warning: str | None


def calcified_elements(vessel: Vessel, size: MeshSize, patch: Patch) -> Calcified:
    """Choose the elements whose centres lie in a patch.

    Parameters
    ----------
    vessel, size
        The tube and its numbers of elements.
    patch : Patch
        Where it is to be calcified.

    Returns
    -------
    Calcified
        The elements, and a warning unless the mesh follows the patch.

    Raises
    ------
    FebioModelError
        If no centre lies in it.
    """
    edges = vessel.length * np.arange(size.n_z + 1) / size.n_z
    along = _within(0.5 * (edges[:-1] + edges[1:]), *patch.x, ROUND_OFF * vessel.length)
    turn = FULL_TURN * np.arange(size.n_theta) / size.n_theta
    step = FULL_TURN / size.n_theta
    around = np.ones(size.n_theta, dtype=bool)
    if patch.phi is not None:
        first, width = patch.phi[0], _width(patch.phi)
        around = _within((turn + 0.5 * step - first) % FULL_TURN, 0.0, width, ROUND_OFF)
    if not along.any() or not around.any():
        way = "along" if not along.any() else "around"
        raise FebioModelError(
            f"calcification: it holds no centre of an element; the mesh needs more elements {way} the artery"
        )
    chosen = np.repeat((along[:, np.newaxis] & around).ravel(), size.n_wall)
    return Calcified(chosen, _warning(vessel, patch, edges, along, turn, around))


def _within(values: Floats, first: float, last: float, slack: float) -> Flags:
    return (values >= first - slack) & (values <= last + slack)


def _width(phi: tuple[float, float]) -> float:
    return (phi[1] - phi[0]) % FULL_TURN or FULL_TURN


def _warning(
    vessel: Vessel,
    patch: Patch,
    edges: Floats,
    along: Flags,
    turn: Floats,
    around: Flags,
) -> str | None:
    """Tell the extent between the outermost element edges, where it is not the patch's own."""
    said = []
    places = np.flatnonzero(along)
    x = (edges[places[0]], edges[places[-1] + 1])
    if max(abs(x[0] - patch.x[0]), abs(x[1] - patch.x[1])) > ROUND_OFF * vessel.length:
        said.append(
            f"x from {1e3 * x[0]:.6g} to {1e3 * x[1]:.6g} mm "
            f"instead of {1e3 * patch.x[0]:.6g} to {1e3 * patch.x[1]:.6g} mm"
        )
    if patch.phi is not None:
        step = FULL_TURN / len(turn)
        if around.all():
            first, last = patch.phi[0], patch.phi[0] + FULL_TURN
        else:
            begin = np.flatnonzero(around & ~np.roll(around, 1))[0]
            first, last = turn[begin], turn[begin] + step * around.sum()
        apart = abs((first - patch.phi[0] + np.pi) % FULL_TURN - np.pi)
        if max(apart, abs((last - first) - _width(patch.phi))) > ROUND_OFF:
            stated = [np.degrees(angle) for angle in patch.phi]
            said.append(
                f"φ from {np.degrees(first):.6g} to {np.degrees(last) % 360:.6g} deg "
                f"instead of {stated[0]:.6g} to {stated[1]:.6g} deg"
            )
    if not said:
        return None
    return f"calcification: the mesh has no element edges at its own; it becomes {' and '.join(said)}"
