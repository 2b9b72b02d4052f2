"""The artery's frame: x along its axis, φ around it, in the reference's coordinates."""

from dataclasses import dataclass

import numpy as np

from cases.arrays import Floats
from cases.sections.references.directions import Vector, components


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

    origin: Floats
    rotation: Floats

    def points(self, coordinates: Floats) -> Floats:
        """Points (..., 3) of the reference in the artery's frame, m."""
        return np.asarray((coordinates - self.origin) @ self.rotation.T)

    def directions(self, parts: Floats) -> Floats:
        """Components (..., 3) in the artery's frame."""
        return np.asarray(parts @ self.rotation.T)


def frame(axis: str | Vector, phi_zero: str | Vector, origin: Vector) -> Frame:
    """Frame from the artery's axis and where φ = 0 points; its part along the axis does not count.

    Parameters
    ----------
    axis, phi_zero : str or tuple of float
        By name ("x", "-y") or components.
    origin : tuple of float
        m.
    """
    along, towards = np.array(components(axis)), np.array(components(phi_zero))
    across = towards - (towards @ along) * along
    first = across / np.linalg.norm(across)
    return Frame(np.array(origin), np.array([along, first, np.cross(along, first)]))
