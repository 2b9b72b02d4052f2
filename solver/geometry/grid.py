"""The structured grid on (x, φ)."""

from dataclasses import dataclass

import numpy as np

from cases.arrays import Floats
from solver.errors import ModelError


@dataclass(frozen=True)
class Grid:
    """n_x cells along an artery of ``length`` (m) and n_phi around it; centres at (i−½)Δx, (j−½)Δφ.

    Where it is ``mirrored``, the rows lie in 0 < φ < π and stand for their mirror images too.
    """

    length: float
    n_x: int
    n_phi: int
    mirrored: bool = False

    def __post_init__(self) -> None:
        if self.n_x < 3:
            raise ModelError(f"n_x = {self.n_x}; allowed: 3 or more cells along the artery")
        if self.n_phi != 1 and self.n_phi < 4:
            raise ModelError(f"n_phi = {self.n_phi}; allowed: 1 (the 1D model) or 4 and more")
        if not (np.isfinite(self.length) and self.length > 0):
            raise ModelError(f"length = {self.length} m; allowed: a positive, finite length")

    @property
    def dx(self) -> float:
        """Cell width Δx, m."""
        return self.length / self.n_x

    @property
    def dphi(self) -> float:
        """Cell height Δφ, rad."""
        return (np.pi if self.mirrored else 2 * np.pi) / self.n_phi

    @property
    def sector(self) -> float:
        """Flow rate of a section over the sum of its rows' Q: ½Δφ, or Δφ where each row stands for two."""
        return self.dphi if self.mirrored else 0.5 * self.dphi

    @property
    def x(self) -> Floats:
        """Cell centres along the artery, m, (n_x,)."""
        return np.asarray((np.arange(self.n_x) + 0.5) * self.dx)

    @property
    def phi(self) -> Floats:
        """Cell centres around the artery, rad, (n_phi,)."""
        return np.asarray((np.arange(self.n_phi) + 0.5) * self.dphi)
