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


def momentum_correction(exponent: ArrayLike) -> Floats:
    """Momentum-correction coefficient α(γ) = 2∫₀¹ y s² dy = (γ+2)/(γ+1)."""
    gamma = np.asarray(exponent, dtype=float)
    return 1.0 + 1.0 / (gamma + 1.0)


def axis_ratio(exponent: ArrayLike) -> Floats:
    """Axial velocity on the axis over the mean velocity, s(0) = (γ+2)/γ."""
    return 1.0 + 2.0 / np.asarray(exponent, dtype=float)


def axis_velocity(mean_velocity: Floats) -> Floats:
    """Velocity on the axis by the *average* closure, D = (γ_avg+2)/γ_avg · mean_φ(u).

    Parameters
    ----------
    mean_velocity : ndarray (..., n_phi)
        Mean velocity u of each row, m/s.

    Returns
    -------
    ndarray (..., 1)
        D, m/s.
    """
    average = np.mean(mean_velocity, axis=-1, keepdims=True)
    return np.asarray(axis_ratio(AVERAGE_EXPONENT) * average)


def continuity_exponent(mean_velocity: Floats, rest: float) -> Floats:
    """Exponent that makes the velocity continuous on the axis, γ = 2u/(D − u) (2.2.35).

    Parameters
    ----------
    mean_velocity : ndarray (..., n_phi)
        Mean velocity u of each row, m/s.
    rest : float
        A section whose rows are all slower than this, m/s, is at rest and has γ = 2.

    Returns
    -------
    ndarray (..., n_phi)
        γ; NaN where none is admissible.
    """
    u = np.asarray(mean_velocity, dtype=float)
    axis = np.broadcast_to(axis_velocity(u), u.shape)
    at_rest = np.max(np.abs(u), axis=-1, keepdims=True) < rest
    admissible = (u * axis > 0) & (np.abs(u) < np.abs(axis))
    exponent = np.full(u.shape, np.nan)
    np.divide(2 * u, axis - u, out=exponent, where=admissible)
    return np.where(at_rest, AVERAGE_EXPONENT, exponent)
