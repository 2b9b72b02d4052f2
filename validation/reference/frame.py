"""The artery's frame: x along its axis, φ around it, in the reference's coordinates."""

from dataclasses import dataclass

import numpy as np

from cases.arrays import Floats
from cases.sections.reference import Vector, components


@dataclass(frozen=True)
class Frame:
    """Where the artery lies, and what the reference's numbers mean.

    Attributes
    ----------
    origin : ndarray (3,)
        Centre of the inlet, m.
    rotation : ndarray (3, 3)
        Rows: unit vectors along the artery, towards φ = 0 and towards φ = π/2.
    length, velocity : float
        The reference's units of length and velocity, m and m/s.
    """

    origin: Floats
    rotation: Floats
    length: float = 1.0
    velocity: float = 1.0

    def points(self, coordinates: Floats) -> Floats:
        """Points (..., 3) of the reference in the artery's frame, m."""
        return np.asarray((self.length * coordinates - self.origin) @ self.rotation.T)

    def displacements(self, parts: Floats) -> Floats:
        """Displacements (..., 3) of the reference in the artery's frame, m."""
        return self.length * self.directions(parts)

    def velocities(self, parts: Floats) -> Floats:
        """Velocities (..., 3) of the reference in the artery's frame, m/s."""
        return self.velocity * self.directions(parts)

    def directions(self, parts: Floats) -> Floats:
        """Components (..., 3) in the artery's frame."""
        return np.asarray(parts @ self.rotation.T)


def frame(
    axis: str | Vector,
    phi_zero: str | Vector,
    origin: Vector,
    length: float = 1.0,
    velocity: float = 1.0,
) -> Frame:
    """Frame from the artery's axis and where φ = 0 points; its part along the axis does not count.

    Parameters
    ----------
    axis, phi_zero : str or tuple of float
        By name ("x", "-y") or components.
    origin : tuple of float
        m.
    length, velocity : float
        Units of the reference, m and m/s.
    """
    along, towards = np.array(components(axis)), np.array(components(phi_zero))
    across = towards - (towards @ along) * along
    first = across / np.linalg.norm(across)
    return Frame(np.array(origin), np.array([along, first, np.cross(along, first)]), length, velocity)
