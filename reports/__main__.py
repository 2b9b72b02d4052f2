"""Reports of finished comparisons, or the page of a sweep, again: ``python -m reports DIR [DIR …]``."""

import sys

from cases.shell.command import run

if __name__ == "__main__":
    sys.exit(run("reports.command"))
