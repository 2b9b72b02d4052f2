"""Thick-walled tubes of one hyperelastic material under finite strain."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar, NamedTuple

from cases.sections.wall_laws.law import CompressibleRatio, HomogeneousWall
from cases.sections.wall_laws.thick import lame_stiffness

if TYPE_CHECKING:
    from cases.arrays import Floats


class Stresses(NamedTuple):
    """∂W/∂λ_r, ∂W/∂λ_θ and the second derivatives rr, rθ, θθ, Pa."""

    r: Floats
    t: Floats
    rr: Floats
    rt: Floats
    tt: Floats


class HyperelasticWall(HomogeneousWall):
    """A thick-walled tube of a material with a strain energy W(λ_r, λ_θ), in plane strain along the axis."""

    linear: ClassVar[bool] = False
    incompressible: ClassVar[bool] = False
    poisson_ratio: CompressibleRatio

    @staticmethod
    @abstractmethod
    def stresses(lam: float, mu: float, r: Floats, t: Floats) -> Stresses:
        """Return the derivatives of W with the stretches λ_r and λ_θ; Lamé's constants λ and μ in Pa."""

    def stiffness(self, moduli: Sequence[Floats], radius: float, thickness: float) -> Floats:
        """Return Lamé's β, that of small strains, Pa m."""
        return lame_stiffness(moduli[0], self.poisson_ratio, radius, thickness)
