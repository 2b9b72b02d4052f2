"""Observed order, Richardson extrapolate and grid convergence index of one number on three grids.

After Roache (1994), "Perspective: a method for uniform reporting of grid refinement studies", and Celik et
al. (2008), the ASME procedure; refinement is by a factor of two.
"""

from dataclasses import dataclass

import numpy as np

RATIO = 2.0
FORMAL_ORDER = 2.0  # of the semi-implicit scheme, and of trilinear elements: no higher order is relied on
LEAST_ORDER = 0.5  # and no lower one is believed
SAFETY = 1.25  # with three grids
ROUND_OFF = 1e-12  # relative change that is none


@dataclass(frozen=True)
class Convergence:
    """What three grids tell of a number.

    Attributes
    ----------
    order : float or None
        Observed order; None where the changes have opposite signs or none is left.
    extrapolate : float or None
        Richardson's estimate of the limit.
    index : float or None
        Grid convergence index of the middle grid: a bound on its error relative to the finest value.
    monotone : bool
        Whether each refinement moves the number the same way by less.
    """

    order: float | None
    extrapolate: float | None
    index: float | None
    monotone: bool


def convergence(coarse: float, middle: float, fine: float) -> Convergence:
    """Judge one number found on three grids, each twice as fine as the one before.

    Where the number does not converge monotonically the index is that of first order, without a limit.
    """
    first, second = middle - coarse, fine - middle
    size = max(abs(coarse), abs(middle), abs(fine))
    if max(abs(first), abs(second)) <= ROUND_OFF * size:
        return Convergence(None, fine, 0.0, monotone=True)
    monotone = first * second > 0.0 and abs(second) < abs(first)
    if not monotone:
        largest = max(abs(first), abs(second))
        return Convergence(None, None, _share(SAFETY * 2.0 * largest, fine), monotone=False)
    order = float(np.log(first / second) / np.log(RATIO))
    trusted = float(np.clip(order, LEAST_ORDER, FORMAL_ORDER))
    rest = second / (RATIO**trusted - 1.0)
    return Convergence(order, fine + rest, _share(SAFETY * abs(second + rest), fine), monotone=True)


def _share(error: float, value: float) -> float | None:
    return error / abs(value) if value else None
