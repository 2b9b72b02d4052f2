"""Fit numbers of a case: ``python -m validation.calibrate CALIBRATION.yaml``."""

import sys

from validation.calibrate.command import main

if __name__ == "__main__":
    sys.exit(main())
