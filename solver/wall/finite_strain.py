"""Inflation of a thick tube at finite strain: R(P) of a hyperelastic wall.

Plane strain along the axis, compressible material, pressure inside only. The deformed radius r(ρ) is a
polynomial over the wall; it makes the potential energy stationary,

    Π = ∫ W(r', r/ρ) ρ dρ − ½ P r(ρ_i)²,

the integral by Gauss–Legendre quadrature over the wall.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre

from cases.arrays import Floats
from solver.wall.table import MasterCurve

DEGREE, QUADRATURE = 8, 24  # of the polynomial r(ρ), and points of the integral
CONVERGED = 1e-12

# ∂W/∂λ_r, ∂W/∂λ_θ and the second derivatives rr, rθ, θθ, Pa
Stresses = tuple[Floats, Floats, Floats, Floats, Floats]
Constitutive = Callable[[float, float, Floats, Floats], Stresses]


def _lame(youngs_modulus: float, poisson_ratio: float) -> tuple[float, float]:
    shear = youngs_modulus / (2 * (1 + poisson_ratio))
    return 2 * shear * poisson_ratio / (1 - 2 * poisson_ratio), shear


class _Tube(NamedTuple):
    """Shape functions at quadrature points, and at the inner radius."""

    stress: Callable[[Floats, Floats], Stresses]
    position: Floats  # ρ, (q,)
    weight: Floats  # ρ dρ, (q,)
    value: Floats  # (q, n)
    slope: Floats  # (q, n)
    inner: Floats  # (n,)


def _tube(
    stresses: Constitutive, youngs_modulus: float, poisson_ratio: float, radius: float, thickness: float
) -> _Tube:
    lam, mu = _lame(youngs_modulus, poisson_ratio)
    points, weights = legendre.leggauss(QUADRATURE)
    position = radius + 0.5 * thickness * (points + 1)
    identity = np.eye(DEGREE + 1)
    return _Tube(
        stress=lambda r, t: stresses(lam, mu, r, t),
        position=position,
        weight=0.5 * thickness * weights * position,
        value=np.asarray(legendre.legvander(points, DEGREE), dtype=float),
        slope=np.asarray(legendre.legval(points, legendre.legder(identity)).T * 2 / thickness, dtype=float),
        inner=legendre.legvander(np.array([-1.0]), DEGREE)[0],
    )


def _equilibrium(tube: _Tube, pressure: float, start: Floats) -> tuple[Floats, Floats] | None:
    """Coefficients of r(ρ) and their derivative with pressure; None where Newton's method fails."""
    c = start.copy()
    hoop = tube.value / tube.position[:, None]
    for _ in range(30):
        s_r, s_t, s_rr, s_rt, s_tt = tube.stress(tube.slope @ c, hoop @ c)
        inner = tube.inner @ c
        gradient = tube.slope.T @ (tube.weight * s_r) + hoop.T @ (tube.weight * s_t)
        gradient -= pressure * inner * tube.inner
        mixed = tube.slope.T * (tube.weight * s_rt) @ hoop
        hessian = tube.slope.T * (tube.weight * s_rr) @ tube.slope + hoop.T * (tube.weight * s_tt) @ hoop
        hessian += mixed + mixed.T - pressure * np.outer(tube.inner, tube.inner)
        change = np.linalg.solve(hessian, gradient)
        c = c - change
        if not np.all(np.isfinite(c)) or np.any(tube.slope @ c <= 0) or tube.inner @ c <= 0:
            return None
        if np.max(np.abs(change)) < CONVERGED * np.max(np.abs(c)):
            return c, np.asarray(np.linalg.solve(hessian, inner * tube.inner), dtype=float)
    return None


def inflation_curve(
    stresses: Constitutive,
    youngs_modulus: float,
    poisson_ratio: float,
    radius: float,
    thickness: float,
    lowest: float,
    highest: float,
) -> MasterCurve:
    """R(P) of a tube between two pressures, or as far as it is stable.

    Parameters
    ----------
    stresses : callable
        Lamé's constants λ and μ, Pa, and stretches λ_r and λ_θ → derivatives of W.
    youngs_modulus, poisson_ratio : float
        E, Pa, and ν of the linearised material.
    radius, thickness : float
        Inner radius and thickness of the unloaded wall, m.
    lowest, highest : float
        Pressures above the one of the unloaded wall, Pa; lowest ≤ 0 ≤ highest.
    """
    tube = _tube(stresses, youngs_modulus, poisson_ratio, radius, thickness)
    unloaded = np.zeros(DEGREE + 1)
    unloaded[0], unloaded[1] = radius + 0.5 * thickness, 0.5 * thickness
    step = (highest - lowest) / 400
    up = _follow(tube, unloaded, np.arange(0.0, highest + 0.5 * step, step))
    down = _follow(tube, unloaded, np.arange(0.0, lowest - 0.5 * step, -step))
    points = down[:0:-1] + up
    loads, radii, slopes = (np.array(column) for column in zip(*points, strict=True))
    return MasterCurve(loads, radii, slopes)


def _follow(tube: _Tube, start: Floats, pressures: Floats) -> list[tuple[float, float, float]]:
    """(P, R, dR/dP) along pressures, each from the last solution, while R grows with P."""
    points: list[tuple[float, float, float]] = []
    c = start
    for pressure in pressures:
        found = _equilibrium(tube, float(pressure), c)
        if found is None:
            break
        c, rate = found
        slope = float(tube.inner @ rate)
        if slope <= 0:
            break
        points.append((float(pressure), float(tube.inner @ c), slope))
    return points
