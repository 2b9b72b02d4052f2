"""The (x, φ, y) points on which both models are compared, and quadrature along a ray."""

from dataclasses import dataclass

import numpy as np

from cases.arrays import Floats

POINTS_PER_RAY = 25  # y = 0, 1/24, …, 1; odd, for Simpson's rule
RIM_RAYS = 192  # rays around a section on which the lumen's edge is taken, at least


@dataclass(frozen=True)
class Rays:
    """One ray per cell, at its centre.

    Attributes
    ----------
    x : ndarray (n_x,)
        Cell centres along the artery, m.
    phi : ndarray (n_phi,)
        Cell centres around it, rad.
    y : ndarray (n_y,)
        Normalised radius r/R, uniform from 0 to 1, n_y odd.
    """

    x: Floats
    phi: Floats
    y: Floats

    @property
    def shape(self) -> tuple[int, int, int]:
        """(n_x, n_phi, n_y)."""
        return self.x.size, self.phi.size, self.y.size

    @property
    def dphi(self) -> float:
        """Angle of a sector Δφ, rad."""
        return 2 * np.pi / self.phi.size

    @property
    def rim(self) -> Floats:
        """Angles on which the edge of the lumen is taken: equally many in each sector, rad."""
        each = -(-RIM_RAYS // self.phi.size)
        inside = (np.arange(each) + 0.5) / each - 0.5
        return np.asarray((self.phi[:, None] + inside * self.dphi).ravel())

    def points(self, radius: Floats) -> Floats:
        """Points of rays out to ``radius`` (n_x, n_phi), (n_x, n_phi, n_y, 3) in the artery's frame, m."""
        r = radius[:, :, None] * self.y
        along = np.broadcast_to(self.x[:, None, None], r.shape)
        return np.stack(
            [along, r * np.cos(self.phi)[None, :, None], r * np.sin(self.phi)[None, :, None]], axis=-1
        )

    def cylindrical(self, vectors: Floats) -> Floats:
        """Components along x, r and φ of vectors (n_x, n_phi, n_y, 3) in the artery's frame."""
        cosine, sine = np.cos(self.phi)[None, :, None], np.sin(self.phi)[None, :, None]
        first, second = vectors[..., 1], vectors[..., 2]
        return np.stack(
            [vectors[..., 0], first * cosine + second * sine, second * cosine - first * sine], axis=-1
        )

    def mean(self, values: Floats) -> Floats:
        """Mean over each ray with weight y dy, (..., n_y) → (...): 2∫₀¹ f y dy by Simpson's rule."""
        from scipy.integrate import simpson

        weights = 2.0 * self.y * simpson(np.eye(self.y.size), x=self.y, axis=-1)
        return np.asarray(np.einsum("...k,k->...", values, weights))


def rays(x: Floats, phi: Floats, points: int = POINTS_PER_RAY) -> Rays:
    """Rays at cell centres with ``points`` uniform points from axis to wall."""
    return Rays(x, phi, np.linspace(0.0, 1.0, points))
