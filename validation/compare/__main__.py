"""Run the comparison of a case: ``python -m validation.compare CASE.yaml``."""

import sys

from cases.shell.command import run

if __name__ == "__main__":
    sys.exit(run("validation.compare.command"))
