"""Nonlinear walls as a table of R(P) per cell, interpolated by cubic Hermite polynomials.

A wall's stress scales with its Young's modulus, so one *master curve* serves every cell: the radius over
the load p = (P − P₀)/(E/E_reference).
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from cases.arrays import Floats
from solver.errors import ModelError
from solver.schemes.layout import BEYOND_WALL_TABLE
from solver.schemes.walls import tabulated_area

POINTS = 129  # per cell


class MasterCurve(NamedTuple):
    """R(p), m, and dR/dp, m/Pa, at increasing loads p, Pa."""

    loads: Floats
    radii: Floats
    slopes: Floats


@dataclass(frozen=True)
class WallTable:
    """R and dR/dP of every cell at equidistant pressures.

    Attributes
    ----------
    start, step : float
        First pressure and spacing, Pa.
    values : ndarray (n_x, n_phi, m, 2)
        R, m, and dR/dP, m/Pa; both positive.
    """

    start: float
    step: float
    values: Floats

    def __post_init__(self) -> None:
        if not (np.isfinite(self.start) and self.step > 0 and self.values.shape[2] >= 2):
            raise ModelError("a wall's table needs two or more increasing pressures")
        if not (np.all(np.isfinite(self.values)) and np.all(self.values > 0)):
            raise ModelError("a wall's table needs positive radii that grow with pressure")

    @property
    def end(self) -> float:
        """Last pressure, Pa."""
        return float(self.start + (self.values.shape[2] - 1) * self.step)

    def area(self, pressure: Floats) -> Floats:
        """Return A = R² of every cell at pressures (n_x, n_phi), m².

        Raises
        ------
        ModelError
            Beyond the table.
        """
        area, slope = np.empty(pressure.shape), np.empty(pressure.shape)
        status, i, j = tabulated_area(
            np.ascontiguousarray(pressure), self.values, self.start, self.step, area, slope
        )
        if status == BEYOND_WALL_TABLE:
            raise ModelError(
                f"the wall law is known from {self.start:g} to {self.end:g} Pa; "
                f"cell i = {i + 1}, j = {j + 1} needs {pressure[i, j]:g} Pa"
            )
        return area

    def pressure(self, area: Floats) -> Floats:
        """P of every cell at areas (..., n_x, n_phi), Pa: by bisection on the table.

        Raises
        ------
        ModelError
            Beyond the table.
        """
        flat = area.reshape(-1, *area.shape[-2:])
        return np.stack([self._invert(one) for one in flat]).reshape(area.shape)

    def _invert(self, area: Floats) -> Floats:
        low = np.full(area.shape, self.start)
        high = np.full(area.shape, self.end)
        if np.any(self.area(low) > area) or np.any(self.area(high) < area):
            raise ModelError(f"the wall law is known from {self.start:g} to {self.end:g} Pa only")
        for _ in range(100):
            middle = 0.5 * (low + high)
            small = self.area(middle) < area
            low, high = np.where(small, middle, low), np.where(small, high, middle)
        return np.asarray(0.5 * (low + high))


def wall_table(
    curve: MasterCurve, relative_modulus: Floats, reference_pressure: float, lowest: float, highest: float
) -> WallTable:
    """Tabulate a master curve for every cell.

    Parameters
    ----------
    curve : MasterCurve
        Of the reference modulus.
    relative_modulus : ndarray (n_x, n_phi)
        E of each cell over the reference modulus.
    reference_pressure : float
        P₀, Pa.
    lowest, highest : float
        Pressures to cover, Pa; narrowed to what the curve covers in every cell.
    """
    low = max(lowest, reference_pressure + float(np.max(relative_modulus * curve.loads[0])))
    high = min(highest, reference_pressure + float(np.min(relative_modulus * curve.loads[-1])))
    if not low < high:
        raise ModelError(f"the wall law covers no pressure between {lowest:g} and {highest:g} Pa")
    pressures = np.linspace(low, high, POINTS)
    radius_of = hermite(curve)
    loads = (pressures - reference_pressure) / relative_modulus[..., None]
    radii, slopes = radius_of(loads)
    values = np.stack([radii, slopes / relative_modulus[..., None]], axis=-1)
    return WallTable(float(low), float(pressures[1] - pressures[0]), np.ascontiguousarray(values))


def hermite(curve: MasterCurve) -> Callable[[Floats], tuple[Floats, Floats]]:
    """Interpolant of a master curve: loads → (R, dR/dp)."""
    from scipy.interpolate import CubicHermiteSpline

    spline = CubicHermiteSpline(curve.loads, curve.radii, curve.slopes)
    slope = spline.derivative()
    return lambda loads: (np.asarray(spline(loads)), np.asarray(slope(loads)))
