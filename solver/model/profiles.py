"""The families of velocity profiles over y = r/R.

*Power*: v_x = u s(y; γ) (thesis 2.2.2, 2.2.19), with D = u s(0). It has no member where u and D differ in
sign, or u ≥ D.

*Two modes*: v_x = D f(y) + B g(y), f = 1 − yⁿ, g = y²(1 − y⁴), whose u = aD + B/4 with a = n/(n+2) may have
either sign beside any D. The second mode is the shape in which v_x depends on φ in 3D.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from cases.arrays import Floats

AVERAGE_EXPONENT = 2.0  # γ of the section's average profile: Poiseuille


def shape(y: ArrayLike, exponent: ArrayLike) -> Floats:
    """Profile shape s(y; γ) = (γ+2)/γ · (1 − y^γ), (2.2.19).

    Parameters
    ----------
    y : array_like
        Normalised radius r/R in [0, 1].
    exponent : array_like
        Profile exponent γ > 0; infinity is plug flow (1 inside, 0 on the wall).

    Returns
    -------
    ndarray
        Axial over mean velocity, dimensionless, of the broadcast shape.
    """
    y = np.asarray(y, dtype=float)
    gamma = np.asarray(exponent, dtype=float)
    return np.asarray((1.0 + 2.0 / gamma) * (1.0 - y**gamma))


def axis_ratio(exponent: ArrayLike) -> Floats:
    """Axial velocity on the axis over the mean velocity, s(0) = (γ+2)/γ."""
    return 1.0 + 2.0 / np.asarray(exponent, dtype=float)


@dataclass(frozen=True)
class TwoModes:
    """Profiles of two modes, and what D, one number a section, follows from.

    Attributes
    ----------
    closure : str
        ``mean``: D = ū/a of the section's mean velocity; ``axis_momentum``: the momentum on the axis.
    base_exponent : float
        n, 2 with ``axis_momentum``.
    """

    closure: Literal["mean", "axis_momentum"]
    base_exponent: float = AVERAGE_EXPONENT

    @property
    def share(self) -> float:
        """A = n/(n+2), the mean of f."""
        return self.base_exponent / (self.base_exponent + 2.0)

    @property
    def momentum(self) -> tuple[float, float, float]:
        """Factors of u², uD and D² in 2∫v²y dy."""
        n, a = self.base_exponent, self.share
        squared = 1.0 - 4.0 / (n + 2.0) + 1.0 / (n + 1.0)  # 2∫f²y dy
        mixed = 0.25 - 2.0 / (n + 4.0) + 2.0 / (n + 8.0)  # 2∫fgy dy
        second = 8.0 / 105.0  # 2∫g²y dy
        return (
            16.0 * second,
            8.0 * mixed - 32.0 * a * second,
            squared - 8.0 * a * mixed + 16.0 * a**2 * second,
        )

    @property
    def wall_slope(self) -> tuple[float, float]:
        """Factors of u and D in −∂_y v(1)."""
        return 16.0, self.base_exponent - 16.0 * self.share

    def bend(self, velocity: Floats, axis_velocity: Floats) -> Floats:
        """B of mean and axis velocities, m/s."""
        return np.asarray(4.0 * (velocity - self.share * axis_velocity))

    def velocity(self, y: Floats, axis_velocity: Floats, bend: Floats) -> Floats:
        """v_x at y (n_y,) for D and B (...), m/s, (..., n_y)."""
        first, second = self.shapes(y)
        return np.asarray(axis_velocity[..., None] * first + bend[..., None] * second)

    def shapes(self, y: Floats) -> tuple[Floats, Floats]:
        """F and g at y."""
        return np.asarray(1.0 - y**self.base_exponent), np.asarray(y**2 * (1.0 - y**4))
