"""Writes the FEBio model of a case: ``python -m febio_io.feb CASE.yaml --output MODEL.feb``."""

import sys

from cases.shell.command import run

if __name__ == "__main__":
    sys.exit(run("febio_io.feb.command"))
