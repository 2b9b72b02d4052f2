"""Runs FEBio on a model, shows how far it is and says how it ended: ``python -m febio_io.run MODEL.feb``."""

from cases.shell.command import run

if __name__ == "__main__":
    raise SystemExit(run("febio_io.run.command"))
