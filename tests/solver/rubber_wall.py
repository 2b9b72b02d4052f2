"""A wall law from outside the package: registers itself, then runs the modules that its input names."""

import io
import json
import runpy
import sys
from collections.abc import Sequence
from contextlib import redirect_stderr, redirect_stdout
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


def run_module(arguments):
    """Status, output and errors of `python -m` with these arguments, the module's name first."""
    sys.argv, status = arguments, 0
    with redirect_stdout(io.StringIO()) as output, redirect_stderr(io.StringIO()) as errors:
        try:
            runpy.run_module(arguments[0], run_name="__main__", alter_sys=True)
        except SystemExit as end:
            status = end.code or 0
    return status, output.getvalue(), errors.getvalue()


if __name__ == "__main__":
    for line in sys.stdin:
        sys.stdout.write(json.dumps(run_module(json.loads(line))) + "\n")
        sys.stdout.flush()
