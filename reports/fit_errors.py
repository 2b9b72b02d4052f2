"""How well each exponent γ describes a 3D velocity profile."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def fit_errors(velocity: Array, y: Array, exponents: Array) -> Array:
    """Relative error of the closest profile u s(y; γ) for each γ, with s = (γ + 2)/γ (1 − y^γ).

    The mean velocity u is that of least squares, ⟨v, s⟩/⟨s, s⟩.

    Parameters
    ----------
    velocity : ndarray, shape (..., n)
        Axial velocity along rays (m/s).
    y : ndarray, shape (n,)
        r/R.
    exponents : ndarray, shape (m,)
        γ.

    Returns
    -------
    ndarray, shape (..., m)
        ‖v − u s‖₂ / ‖v‖₂; NaN where nothing flows.
    """
    g = exponents[:, None]
    shape = (g + 2) / g * (1 - y**g)
    along = velocity @ shape.T
    size = np.sum(velocity**2, axis=-1, keepdims=True)
    with np.errstate(invalid="ignore", divide="ignore"):
        rest = 1 - along**2 / (np.sum(shape**2, axis=-1) * size)
        return np.asarray(np.sqrt(np.clip(rest, 0.0, None)))
