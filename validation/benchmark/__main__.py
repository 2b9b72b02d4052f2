"""How fast the solver is on this machine: ``python -m validation.benchmark``."""

from cases.shell.command import run

if __name__ == "__main__":
    raise SystemExit(run("validation.benchmark.command"))
