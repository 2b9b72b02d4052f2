"""Run the comparison of a case: ``python -m validation.compare CASE.yaml``."""

import sys

from validation.compare.command import main

if __name__ == "__main__":
    sys.exit(main())
