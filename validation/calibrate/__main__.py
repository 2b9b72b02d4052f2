"""Fit numbers of a case: ``python -m validation.calibrate CALIBRATION.yaml``."""

from cases.shell.command import run

if __name__ == "__main__":
    raise SystemExit(run("validation.calibrate.command"))
