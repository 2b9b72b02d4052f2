"""Lag of the outlet flow over the cycle, of one model behind the other."""

import numpy as np
import xarray as xr
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar

from validation.reference.alignment import WHOLE

LARGEST_LAG = 0.1  # share of a cycle searched for a lag


def phase_lag(rom: xr.Dataset, reference: xr.Dataset, period: float) -> float | None:
    """Lag of the reduced model's outlet flow behind the reference's, s.

    The shift of the reference's periodic spline that, scaled, fits the reduced model best; None where the
    states do not cover a cycle.
    """
    times = reference["time"].to_numpy()
    if times[-1] - times[0] < WHOLE * period:
        return None
    ours = rom["section_flow_rate"].isel(x=-1).to_numpy()
    theirs = reference["section_flow_rate"].isel(x=-1).to_numpy()
    knots = np.append(times[:-1], times[0] + period)
    spline = CubicSpline(knots, np.append(theirs[:-1], theirs[0]), bc_type="periodic")

    def misfit(lag: float) -> float:
        shifted = spline(times - lag)
        scale = (ours @ shifted) / (shifted @ shifted)
        return float(np.sum((ours - scale * shifted) ** 2))

    bound = LARGEST_LAG * period
    best = minimize_scalar(misfit, bounds=(-bound, bound), method="bounded", options={"xatol": 1e-7 * period})
    return float(best.x)
