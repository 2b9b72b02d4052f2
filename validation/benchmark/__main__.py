"""How fast the solver is on this machine: ``python -m validation.benchmark``."""

import sys

from cases.shell.command import run

if __name__ == "__main__":
    sys.exit(run("validation.benchmark.command"))
