"""Tells what an FEBio result file holds, and writes it in other formats: ``python -m febio_io FILE``."""

from cases.shell.command import run

if __name__ == "__main__":
    raise SystemExit(run("febio_io.command"))
