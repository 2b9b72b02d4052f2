"""The neo-Hookean tube: compressible as FEBio's, or with ν = ½ incompressible."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Literal

from cases.sections.wall_laws.hyperelastic import HyperelasticWall, Stresses
from cases.sections.wall_laws.law import PoissonRatio

if TYPE_CHECKING:
    from cases.arrays import Floats


class NeoHookeanWall(HyperelasticWall):
    """A thick-walled tube of neo-Hookean material under finite strain."""

    law: Literal["neo_hookean"]
    poisson_ratio: PoissonRatio

    incompressible: ClassVar[bool] = True
    febio_material: ClassVar[str] = "neo-Hookean"

    @staticmethod
    def stresses(lam: float, mu: float, r: Floats, t: Floats) -> Stresses:
        """W = ½μ(λ_r² + λ_θ² − 2) − μ ln J + ½λ (ln J)², J = λ_r λ_θ (FEBio's compressible neo-Hookean)."""
        import numpy as np

        volume = np.log(r * t)
        push = lam * volume - mu
        return Stresses(
            mu * r + push / r,
            mu * t + push / t,
            mu + (lam - push) / (r * r),
            lam / (r * t),
            mu + (lam - push) / (t * t),
        )
