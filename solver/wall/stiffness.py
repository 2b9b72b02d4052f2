"""The linear wall: P = P₀ + β (R − R₀)/R₀² (2.2.1)."""

import numpy as np
from numpy.typing import ArrayLike

from cases.arrays import Floats
from solver.errors import ModelError


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
    if not np.min(wall_radius) > 0:
        raise ModelError(f"the lumen collapses at P = {np.min(pressure):g} Pa")
    return np.asarray(wall_radius**2)
