"""Observed order and uncertainty of discretisation from root-mean-square changes between levels.

One order for all cells and states ("global" in Celik et al. 2008), from the norm of the changes. The factor
of safety is that of Roache (1998) with the rule of Oberkampf & Roy (2010, section 8.6.4): 1.25 where the
observed order is that of the scheme, else 3 with an order that is clipped.
"""

from dataclasses import dataclass

import numpy as np

from validation.converge.convergence import FORMAL_ORDER, LEAST_ORDER, ROUND_OFF, SAFETY

FIRST_ORDER = 1.0  # of the reduced model where a wall jumps
SLACK = 0.1  # share of the formal order by which the observed one may differ from it
SURE, UNSURE = SAFETY, 3.0  # factors of safety
_SEARCHED = (1e-3, 20.0)  # orders


@dataclass(frozen=True)
class Estimate:
    """What levels tell of one number of the level that is used.

    Attributes
    ----------
    uncertainty : float
        Its error of discretisation times the factor of safety, relative.
    observed : float or None
        Observed order; None with two levels, or where changes do not shrink.
    order : float
        Order that counted.
    safety : float
        Factor of safety that counted.
    extrapolated : float or None
        Of an error that levels were compared by: its size in the limit (Richardson).
    """

    uncertainty: float
    observed: float | None
    order: float
    safety: float
    extrapolated: float | None = None


def observed_order(
    coarse_change: float, fine_change: float, coarse_ratio: float, fine_ratio: float
) -> float | None:
    """Order at which changes between three levels shrink; None where they do not.

    Solves ε₃₂/ε₂₁ = (r₃₂ᵖ − 1) r₂₁ᵖ/(r₂₁ᵖ − 1), equation 3 of Celik et al. (2008).

    Parameters
    ----------
    coarse_change, fine_change : float
        Change from the coarsest to the middle level, and from there to the finest; not negative.
    coarse_ratio, fine_ratio : float
        Size of cells over that of the next level, above 1.
    """
    if fine_change <= 0.0 or coarse_change <= 0.0:
        return None
    from scipy.optimize import brentq

    def missed(order: float) -> float:
        grown = (coarse_ratio**order - 1.0) * fine_ratio**order / (fine_ratio**order - 1.0)
        return float(np.log(grown) - np.log(coarse_change / fine_change))

    low, high = _SEARCHED
    if missed(low) >= 0.0:
        return None
    return float(brentq(missed, low, high)) if missed(high) > 0.0 else high


def trusted(observed: float | None, lowest: float) -> tuple[float, float]:
    """Order that counts and its factor of safety.

    Parameters
    ----------
    observed : float or None
    lowest : float
        Least formal order of what was refined; the largest is 2.
    """
    if observed is None:
        return LEAST_ORDER, UNSURE
    if lowest * (1.0 - SLACK) <= observed <= FORMAL_ORDER * (1.0 + SLACK):
        return min(observed, FORMAL_ORDER), SURE
    return float(np.clip(observed, LEAST_ORDER, FORMAL_ORDER)), UNSURE


def of_middle_level(coarse_change: float, fine_change: float, ratio: float = 2.0) -> Estimate:
    """Uncertainty of the middle of three levels, each ``ratio`` times as fine as the one before."""
    if max(coarse_change, fine_change) <= ROUND_OFF:
        return Estimate(0.0, None, FORMAL_ORDER, SURE)
    observed = observed_order(coarse_change, fine_change, ratio, ratio)
    order, safety = trusted(observed, FIRST_ORDER)
    error = fine_change * ratio**order / (ratio**order - 1.0)
    return Estimate(safety * error, observed, order, safety)


def of_finest_level(changes: list[float], ratios: list[float]) -> Estimate:
    """Uncertainty of the finest of two levels or more, by the formal order where there are two.

    Parameters
    ----------
    changes : list of float
        From level to level, coarse to fine; the last two count.
    ratios : list of float
        Size of cells over that of the next level.
    """
    if max(changes[-2:]) <= ROUND_OFF:
        return Estimate(0.0, None, FORMAL_ORDER, SURE)
    if len(changes) == 1:
        observed, (order, safety) = None, (FORMAL_ORDER, UNSURE)
    else:
        observed = observed_order(*changes[-2:], *ratios[-2:])
        order, safety = trusted(observed, FORMAL_ORDER)
    return Estimate(safety * changes[-1] / (ratios[-1] ** order - 1.0), observed, order, safety)
