"""Reports of finished comparisons, or the page of a sweep, again: ``python -m reports DIR [DIR …]``."""

from cases.shell.command import run

if __name__ == "__main__":
    raise SystemExit(run("reports.command"))
