"""The linear thin-walled tube."""

from collections.abc import Sequence
from typing import ClassVar, Literal

import numpy as np

from cases.arrays import Floats
from cases.sections.wall_laws.law import HomogeneousWall


class ThinWall(HomogeneousWall):
    """A linear thin-walled tube; Poisson's ratio is not used: 1/2 is built in."""

    law: Literal["thin"]

    febio_material: ClassVar[str] = "isotropic elastic"

    def stiffness(self, moduli: Sequence[Floats], radius: float, thickness: float) -> Floats:
        """Return β = (4/3) E h (2.2.1), Pa m."""
        del radius
        return np.asarray(4.0 / 3.0 * moduli[0] * thickness)
