"""Run the reduced model alone: ``python -m solver CASE.yaml [--variant NAME] --output FILE.nc``."""

import sys

from cases.shell.command import run

if __name__ == "__main__":
    sys.exit(run("solver.command"))
