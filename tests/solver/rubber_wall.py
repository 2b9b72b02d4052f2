"""A wall law from outside the package: registers itself, then runs the module that the command line names."""

import runpy
import sys
from collections.abc import Sequence
from typing import Annotated, ClassVar, Literal

from cases.arrays import Floats
from cases.sections.wall_laws import LAWS
from cases.sections.wall_laws.law import HomogeneousWall
from cases.values.kinds import number


class RubberWall(HomogeneousWall):
    """A linear wall of which a share bears the load.

    Attributes
    ----------
    share : float
        In [0.1, 1].
    """

    law: Literal["rubber"]
    share: Annotated[float, number("a number from 0.1 to 1", lambda value: 0.1 <= value <= 1)]

    not_in_febio: ClassVar[str] = "it is made up"

    def stiffness(self, moduli: Sequence[Floats], radius: float, thickness: float) -> Floats:
        """Return β = s E h, Pa m."""
        return self.share * moduli[0] * thickness


LAWS["rubber"] = RubberWall

if __name__ == "__main__":
    del sys.argv[0]
    runpy.run_module(sys.argv[0], run_name="__main__", alter_sys=True)
