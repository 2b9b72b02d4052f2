"""The thesis's tables, computed again: ``python -m validation.tables``."""

import sys

from validation.tables.command import main

if __name__ == "__main__":
    sys.exit(main())
