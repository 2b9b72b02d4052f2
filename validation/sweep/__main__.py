"""A case over ranges and distributions of its numbers: ``python -m validation.sweep STUDY.yaml``."""

import sys

from cases.shell.command import run

if __name__ == "__main__":
    sys.exit(run("validation.sweep.command"))
