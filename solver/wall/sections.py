"""The wall as one pressure a section sees it: A(P) and dA/dP of every cell, tabulated.

Between knots A is a cubic Hermite polynomial, which is exact for a wall with R linear in P.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cases.arrays import Floats, Integers
from solver.errors import ModelError
from solver.wall.table import WallTable

LOWEST_SHARE, HIGHEST_SHARE = (
    -0.9,
    4.0,
)  # growth R/R₀ − 1 of the softest cell that a linear wall's table covers
BISECTIONS = 80


@dataclass(frozen=True)
class SectionWall:
    """A and dA/dP of every cell at equidistant pressures.

    Attributes
    ----------
    start, step : float
        First pressure and spacing, Pa.
    values : ndarray (n_x, knots, 2, n_phi)
        A, m², and dA/dP, m²/Pa; the sections' sums of dA/dP are positive.
    """

    start: float
    step: float
    values: Floats

    def __post_init__(self) -> None:
        if not (np.isfinite(self.start) and self.step > 0 and self.values.shape[1] >= 2):
            raise ModelError("a wall's table needs two or more increasing pressures")
        area, slope = self.values[:, :, 0], self.values[:, :, 1]
        if not (np.all(np.isfinite(self.values)) and np.all(area > 0) and np.all(slope.sum(axis=-1) > 0)):
            raise ModelError("a wall's table needs positive areas, and sections that grow with pressure")

    @property
    def shape(self) -> tuple[int, int]:
        """(n_x, n_phi)."""
        return self.values.shape[0], self.values.shape[3]

    @property
    def end(self) -> float:
        """Last pressure, Pa."""
        return float(self.start + (self.values.shape[1] - 1) * self.step)

    def locality_error(self, radii: Floats, pressure: Floats) -> float:
        """Largest relative error of R because a section's shape is taken from its own pressure alone.

        Parameters
        ----------
        radii : ndarray (n_x, n_phi)
            R of the whole wall under these pressures, m.
        pressure : ndarray (n_x,)
            Section pressures P at one instant, Pa; above P₀.
        """
        return float(np.max(np.abs(np.sqrt(self.area(pressure)) / radii - 1)))

    @cached_property
    def last(self) -> "SectionWall":
        """The wall of the last section alone."""
        return SectionWall(self.start, self.step, self.values[-1:])

    @cached_property
    def sums(self) -> Floats:
        """ΣA and ΣdA/dP of every section at the knots, (n_x, knots, 2)."""
        return np.ascontiguousarray(self.values.sum(axis=-1))

    @cached_property
    def _work(self) -> Floats:
        """∫ΣA dP of every section from the first knot to each, (n_x, knots)."""
        area, slope = self.sums[..., 0], self.sums[..., 1] * self.step
        pieces = 0.5 * (area[:, :-1] + area[:, 1:]) + (slope[:, :-1] - slope[:, 1:]) / 12
        return np.pad(self.step * np.cumsum(pieces, axis=1), ((0, 0), (1, 0)))

    def area_integral(self, pressure: Floats) -> Floats:
        """Return ∫ΣA dP of every section from the table's first pressure to section pressures (..., n_x), N.

        Raises
        ------
        ModelError
            Beyond the table.
        """
        knot, t = self._place(pressure)
        i = np.arange(knot.shape[-1])
        a0, d0, curve, twist = self._cubic(self.sums, knot)
        rise = t * (a0 + t * (d0 / 2 + t * (curve / 3 + t * twist / 4)))
        return np.asarray(self._work[i, knot] + self.step * rise)

    def area(self, pressure: Floats) -> Floats:
        """Return A of every cell at section pressures (..., n_x), (..., n_x, n_phi), m².

        Raises
        ------
        ModelError
            Beyond the table.
        """
        return self.area_and_slope(pressure)[0]

    def area_and_slope(self, pressure: Floats) -> tuple[Floats, Floats]:
        """Return A, m², and dA/dP, m²/Pa, of every cell at section pressures (..., n_x).

        Raises
        ------
        ModelError
            Beyond the table.
        """
        knot, t = self._place(pressure)
        a0, d0, curve, twist = self._cubic(self.values, knot)
        t = t[..., None]
        area = a0 + t * (d0 + t * (curve + t * twist))
        return area, (d0 + t * (2 * curve + 3 * t * twist)) / self.step

    def _place(self, pressure: Floats) -> tuple[Integers, Floats]:
        """Knot below each section's pressure, and the share of a step beyond it."""
        position = (np.asarray(pressure, dtype=float) - self.start) / self.step
        last = self.values.shape[1] - 2
        outside = np.flatnonzero(~((position >= 0) & (position <= last + 1)))
        if outside.size:
            section, needed = outside[0] % position.shape[-1], np.ravel(pressure)[outside[0]]
            raise ModelError(
                f"the wall law is known from {self.start:g} to {self.end:g} Pa; "
                f"section i = {section + 1} needs {needed:g} Pa"
            )
        knot = np.minimum(position.astype(np.int64), last)
        return knot, position - knot

    def _cubic(self, table: Floats, knot: Integers) -> tuple[Floats, Floats, Floats, Floats]:
        """Coefficients of A between knots, of a table (n_x, knots, 2, …), in powers of a step's share."""
        i = np.arange(knot.shape[-1])
        a0, d0 = table[i, knot, 0], table[i, knot, 1] * self.step
        a1, d1 = table[i, knot + 1, 0], table[i, knot + 1, 1] * self.step
        return a0, d0, 3 * (a1 - a0) - 2 * d0 - d1, d0 + d1 - 2 * (a1 - a0)

    def pressure(self, area: Floats) -> Floats:
        """Section pressures (n_x,) at which sections have the sums of areas (n_x, n_phi), Pa.

        Raises
        ------
        ModelError
            Beyond the table.
        """
        wanted = area.sum(axis=-1)
        low, high = np.full(wanted.shape, self.start), np.full(wanted.shape, self.end)
        if np.any(self.area(low).sum(axis=-1) > wanted) or np.any(self.area(high).sum(axis=-1) < wanted):
            raise ModelError(f"the wall law is known from {self.start:g} to {self.end:g} Pa only")
        for _ in range(BISECTIONS):
            middle = 0.5 * (low + high)
            small = self.area(middle).sum(axis=-1) < wanted
            low, high = np.where(small, middle, low), np.where(small, high, middle)
        return np.asarray(0.5 * (low + high))


def linear_section_wall(stiffness: Floats, radius: float, reference_pressure: float) -> SectionWall:
    """Table of the row law P = P₀ + β (R − R₀)/R₀².

    Parameters
    ----------
    stiffness : ndarray (n_x, n_phi)
        β, Pa m.
    radius, reference_pressure : float
        R₀, m, and P₀, Pa.
    """
    unit = float(np.min(stiffness)) / radius
    loads = np.array([LOWEST_SHARE * unit, HIGHEST_SHARE * unit])
    compliance = radius**2 / stiffness[:, None, :]
    return from_radii(reference_pressure + loads, radius + loads[:, None] * compliance, compliance)


def tabulated_section_wall(table: WallTable) -> SectionWall:
    """Table of a nonlinear row law."""
    pressures = table.start + table.step * np.arange(table.values.shape[2])
    values = np.moveaxis(table.values, 1, 2)
    return from_radii(np.asarray(pressures, dtype=float), values[..., 0], values[..., 1])


def from_radii(pressures: Floats, radii: Floats, slopes: Floats) -> SectionWall:
    """Table from R, m, and dR/dP, m/Pa, of every cell, (n_x, knots, n_phi), at equidistant pressures, Pa."""
    values = np.stack(np.broadcast_arrays(radii**2, 2 * radii * slopes), axis=2)
    return SectionWall(float(pressures[0]), float(pressures[1] - pressures[0]), np.ascontiguousarray(values))


def row_table(wall: SectionWall) -> WallTable:
    """Table R(P) for rows that have a pressure each.

    Raises
    ------
    ModelError
        Where a cell does not grow with pressure.
    """
    radii = np.sqrt(wall.values[:, :, 0])
    values = np.stack([radii, 0.5 * wall.values[:, :, 1] / radii], axis=-1)
    return WallTable(wall.start, wall.step, np.ascontiguousarray(np.moveaxis(values, 1, 2)))
