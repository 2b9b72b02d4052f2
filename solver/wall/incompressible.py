"""Inflation of a thick tube of incompressible material: the limit ν → ½ of R(P) at finite strain.

Plane strain along the axis keeps the area between every two radii: r² = ρ² + c, so that one number c is the
state, λ_θ = r/ρ = 1/λ_r, and the pressure inside is (Ogden 1997, Non-Linear Elastic Deformations, 5.3.3)

    P(c) = ∫ (λ_θ ∂W/∂λ_θ − λ_r ∂W/∂λ_r) dr/r.
"""

import numpy as np
from numpy.polynomial import legendre

from cases.arrays import Floats
from solver.wall.finite_strain import QUADRATURE, Constitutive
from solver.wall.table import MasterCurve

LEAST_STRETCH, LARGEST_STRETCH = 0.5, 3.0  # of the lumen's radius
POINTS = 401


def incompressible_curve(
    stresses: Constitutive,
    youngs_modulus: float,
    radius: float,
    thickness: float,
    lowest: float,
    highest: float,
) -> MasterCurve:
    """R(P) of a tube between two pressures, or as far as its radius is half or three times that at rest.

    Parameters
    ----------
    stresses : callable
        Lamé's constants λ and μ, Pa, and stretches λ_r and λ_θ → derivatives of W; λ is given as 0, for
        nothing changes volume.
    youngs_modulus : float
        E = 3μ of the linearised material, Pa.
    radius, thickness : float
        Inner radius and thickness of the unloaded wall, m.
    lowest, highest : float
        Pressures above the one of the unloaded wall, Pa; lowest ≤ 0 ≤ highest.
    """
    from scipy.optimize import brentq  # few cases have such a wall, and it takes long to load

    points, weights = legendre.leggauss(QUADRATURE)
    position = radius + 0.5 * thickness * (points + 1)
    weight = 0.5 * thickness * weights * position  # ρ dρ

    def load(stretch: float) -> tuple[float, float]:
        """P and dP/dc at r/ρ of the lumen."""
        square = position**2 + (stretch**2 - 1) * radius**2
        t = np.sqrt(square) / position
        r = 1 / t
        s_r, s_t, s_rr, s_rt, s_tt = stresses(0.0, youngs_modulus / 3, r, t)
        across = t * s_t - r * s_r
        rise = s_t + t * s_tt - 2 * r * s_rt + r**2 * s_r + r**3 * s_rr  # along t, with r = 1/t
        slope = rise / (2 * position**2 * t * square) - across / square**2
        return float(weight @ (across / square)), float(weight @ slope)

    def stretch_at(pressure: float, bound: float) -> float:
        if abs(load(bound)[0]) <= abs(pressure):
            return bound
        return float(brentq(lambda each: load(each)[0] - pressure, 1.0, bound, xtol=1e-14))

    ends = stretch_at(lowest, LEAST_STRETCH), stretch_at(highest, LARGEST_STRETCH)
    stretches: Floats = np.unique(np.append(np.linspace(*ends, POINTS), 1.0))
    loads, rises = np.array([load(each) for each in stretches.tolist()]).T
    radii = stretches * radius
    return MasterCurve(loads, radii, 1 / (2 * radii * rises))
