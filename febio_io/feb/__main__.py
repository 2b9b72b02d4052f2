"""Writes the FEBio model of a case: ``python -m febio_io.feb CASE.yaml --output MODEL.feb``."""

from cases.shell.command import run

if __name__ == "__main__":
    raise SystemExit(run("febio_io.feb.command"))
