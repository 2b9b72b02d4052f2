"""The artery's frame: x along its axis, φ around it, in the reference's coordinates."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

_UNIT = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


@dataclass(frozen=True)
class Frame:
    """Where the artery lies.

    Attributes
    ----------
    origin : ndarray (3,)
        Centre of the inlet, m.
    rotation : ndarray (3, 3)
        Rows: unit vectors along the artery, towards φ = 0 and towards φ = π/2.
    """

    origin: NDArray[np.float64]
    rotation: NDArray[np.float64]

    def points(self, coordinates: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points (..., 3) in the artery's frame, m."""
        return np.asarray((coordinates - self.origin) @ self.rotation.T)

    def vectors(self, components: NDArray[np.float64]) -> NDArray[np.float64]:
        """Vectors (..., 3) in the artery's frame."""
        return np.asarray(components @ self.rotation.T)


def direction(name: str) -> NDArray[np.float64]:
    """Return the unit vector of a name such as "x" or "-y"."""
    sign = -1.0 if name.startswith("-") else 1.0
    return sign * np.array(_UNIT[name.removeprefix("-")])


def frame(axis: str, phi_zero: str, origin: tuple[float, float, float]) -> Frame:
    """Frame from names of coordinate directions: the artery's axis, and where φ = 0 points."""
    along, first = direction(axis), direction(phi_zero)
    return Frame(np.array(origin), np.array([along, first, np.cross(along, first)]))
