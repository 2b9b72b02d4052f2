"""Writes the FEBio model of a case: ``python -m febio_io.feb CASE.yaml --output MODEL.feb``."""

import sys

from febio_io.interrupts import run_command

if __name__ == "__main__":
    sys.exit(run_command("febio_io.feb.command"))
