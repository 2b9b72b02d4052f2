"""Check case files, or print their JSON schema: ``python -m cases FILE…``, ``python -m cases --schema``."""

import sys

from cases.shell.command import run

if __name__ == "__main__":
    sys.exit(run("cases.command"))
