"""Run the reduced model alone: ``python -m solver CASE.yaml [--variant NAME] --output FILE.nc``."""

from cases.shell.command import run

if __name__ == "__main__":
    raise SystemExit(run("solver.command"))
