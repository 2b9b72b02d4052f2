"""Grid and step of the 2D side: ``python -m validation.converge CASE.yaml``."""

from cases.shell.command import run

if __name__ == "__main__":
    raise SystemExit(run("validation.converge.command"))
