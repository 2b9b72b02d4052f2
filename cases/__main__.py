"""Check case files, or print their JSON schema: ``python -m cases FILE…``, ``python -m cases --schema``."""

from cases.shell.command import run

if __name__ == "__main__":
    raise SystemExit(run("cases.command"))
