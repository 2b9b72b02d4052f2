"""What files of a 3D result hold, and how a case states them: ``python -m validation.reference FILES``."""

from cases.shell.command import run

if __name__ == "__main__":
    raise SystemExit(run("validation.reference.command"))
