"""The family of velocity profiles v_x = u s(y; γ), y = r/R (thesis 2.2.2, 2.2.19)."""

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
