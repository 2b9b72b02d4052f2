"""Fit numbers of a case: ``python -m validation.calibrate CALIBRATION.yaml``."""

import sys

from cases.shell.command import run

if __name__ == "__main__":
    sys.exit(run("validation.calibrate.command"))
