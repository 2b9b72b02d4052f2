"""Run the comparison of a case: ``python -m validation.compare CASE.yaml``."""

from cases.shell.command import run

if __name__ == "__main__":
    raise SystemExit(run("validation.compare.command"))
