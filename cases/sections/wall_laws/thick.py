"""The linear thick-walled tube: Lamé's."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar, Literal

from cases.sections.wall_laws.law import HomogeneousWall

if TYPE_CHECKING:
    from cases.arrays import Floats


def lame_stiffness(youngs_modulus: Floats, poisson_ratio: float, radius: float, thickness: float) -> Floats:
    """Thick wall in plane strain (Lamé): β = R₀ E (b² − R₀²)/((1+ν)[(1−2ν)R₀² + b²]), b = R₀ + h, Pa m."""
    import numpy as np

    inner, outer = radius**2, (radius + thickness) ** 2
    nu = poisson_ratio
    factor = radius * (outer - inner) / ((1 + nu) * ((1 - 2 * nu) * inner + outer))
    return np.asarray(factor * youngs_modulus)


class ThickWall(HomogeneousWall):
    """A linear thick-walled tube."""

    law: Literal["thick"]

    febio_material: ClassVar[str] = "isotropic elastic"

    def stiffness(self, moduli: Sequence[Floats], radius: float, thickness: float) -> Floats:
        """Return Lamé's β, Pa m."""
        return lame_stiffness(moduli[0], self.poisson_ratio, radius, thickness)
