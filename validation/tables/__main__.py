"""The thesis's tables, computed again: ``python -m validation.tables``."""

from cases.shell.command import run

if __name__ == "__main__":
    raise SystemExit(run("validation.tables.command"))
