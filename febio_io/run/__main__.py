"""Runs FEBio on a model, shows how far it is and says how it ended: ``python -m febio_io.run MODEL.feb``."""

import sys

from febio_io.interrupts import run_command

if __name__ == "__main__":
    sys.exit(run_command("febio_io.run.command"))
