"""The thesis's tables, computed again: ``python -m validation.tables``."""

import sys

from cases.shell.command import run

if __name__ == "__main__":
    sys.exit(run("validation.tables.command"))
