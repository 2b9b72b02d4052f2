"""Wall laws: the stiffness β of P = P₀ + β (R − R₀)/R₀² from the wall's material (2.2.1)."""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from cases.arrays import Floats
from solver.errors import ModelError


def thin_wall_stiffness(
    youngs_modulus: ArrayLike, radius: float, thickness: float, poisson_ratio: float
) -> Floats:
    """Thin incompressible wall, β = (4/3) E h (2.2.1); Poisson's ratio is 1/2 by construction.

    Parameters
    ----------
    youngs_modulus : array_like
        E, Pa.
    radius, thickness : float
        Reference lumen radius R₀ and wall thickness h, m.
    poisson_ratio : float
        Not used: the law has 1/2 built in.

    Returns
    -------
    ndarray
        β, Pa m.
    """
    del radius, poisson_ratio
    return 4.0 / 3.0 * np.asarray(youngs_modulus, dtype=float) * thickness


def thick_wall_stiffness(
    youngs_modulus: ArrayLike, radius: float, thickness: float, poisson_ratio: float
) -> Floats:
    """Thick wall in plane strain (Lamé): β = R₀ E (b² − R₀²)/((1+ν)[(1−2ν)R₀² + b²]), b = R₀ + h.

    Parameters
    ----------
    youngs_modulus : array_like
        E, Pa.
    radius, thickness : float
        Reference lumen radius R₀ and wall thickness h, m.
    poisson_ratio : float
        ν.

    Returns
    -------
    ndarray
        β, Pa m.
    """
    inner, outer = radius**2, (radius + thickness) ** 2
    nu = poisson_ratio
    factor = radius * (outer - inner) / ((1 + nu) * ((1 - 2 * nu) * inner + outer))
    return factor * np.asarray(youngs_modulus, dtype=float)


WALL_LAWS: dict[str, Callable[[ArrayLike, float, float, float], Floats]] = {
    "thin": thin_wall_stiffness,
    "thick": thick_wall_stiffness,
}


def wall_stiffness(
    law: str, youngs_modulus: ArrayLike, radius: float, thickness: float, poisson_ratio: float
) -> Floats:
    """β of a named law, Pa m; shape of ``youngs_modulus``.

    Raises
    ------
    ModelError
        For an unknown law.
    """
    if law not in WALL_LAWS:
        raise ModelError(f"wall law {law!r} is unknown; allowed: {', '.join(WALL_LAWS)}")
    return WALL_LAWS[law](youngs_modulus, radius, thickness, poisson_ratio)


def pressure_from_area(area: Floats, stiffness: Floats, radius: float, reference_pressure: float) -> Floats:
    """P = P₀ + β (√A − R₀)/R₀², Pa, with A = R² in m²."""
    return np.asarray(reference_pressure + stiffness * (np.sqrt(area) - radius) / radius**2)


def area_from_pressure(
    pressure: ArrayLike, stiffness: Floats, radius: float, reference_pressure: float
) -> Floats:
    """Return A = R² = (R₀ + (P − P₀) R₀²/β)², m²: the inverse of :func:`pressure_from_area`.

    Raises
    ------
    ModelError
        Where R would not be positive.
    """
    wall_radius = radius + (np.asarray(pressure) - reference_pressure) * radius**2 / stiffness
    if not np.all(wall_radius > 0):
        raise ModelError(f"the lumen collapses at P = {np.min(pressure):g} Pa")
    return np.asarray(wall_radius**2)
