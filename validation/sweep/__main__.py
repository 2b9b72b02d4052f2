"""A case over ranges and distributions of its numbers: ``python -m validation.sweep STUDY.yaml``."""

from cases.shell.command import run

if __name__ == "__main__":
    raise SystemExit(run("validation.sweep.command"))
