"""The linear thin-walled tube."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar, Literal

from cases.sections.wall_laws.law import HomogeneousWall, PoissonRatio

if TYPE_CHECKING:
    from cases.arrays import Floats


class ThinWall(HomogeneousWall):
    """A linear thin-walled tube, incompressible where no Poisson's ratio is stated, as the thesis's."""

    law: Literal["thin"]
    poisson_ratio: PoissonRatio = 0.5

    febio_material: ClassVar[str] = "isotropic elastic"

    def stiffness(self, moduli: Sequence[Floats], radius: float, thickness: float) -> Floats:
        """Return β = E h/(1 − ν²), Pa m; (4/3) E h for ν = ½ (2.2.1)."""
        import numpy as np

        del radius
        return np.asarray(1.0 / (1.0 - self.poisson_ratio**2) * moduli[0] * thickness)
