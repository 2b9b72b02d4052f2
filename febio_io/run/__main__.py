"""Runs FEBio on a model, shows how far it is and says how it ended: ``python -m febio_io.run MODEL.feb``."""

import sys

from cases.shell.command import run

if __name__ == "__main__":
    sys.exit(run("febio_io.run.command"))
