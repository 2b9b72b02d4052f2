"""Grid and step of the 2D side: ``python -m validation.converge CASE.yaml``."""

import sys

from validation.converge.command import main

if __name__ == "__main__":
    sys.exit(main())
