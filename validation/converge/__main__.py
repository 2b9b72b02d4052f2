"""Grid and step of the 2D side: ``python -m validation.converge CASE.yaml``."""

import sys

from cases.shell.command import run

if __name__ == "__main__":
    sys.exit(run("validation.converge.command"))
