"""Tells what an FEBio result file holds, and writes it in other formats: ``python -m febio_io FILE``."""

import sys

from cases.shell.command import run

if __name__ == "__main__":
    sys.exit(run("febio_io.command"))
