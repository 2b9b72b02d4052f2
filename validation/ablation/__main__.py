"""Parts of the coupled model: ``python -m validation.ablation CASE.yaml``."""

import sys

from validation.ablation.command import main

if __name__ == "__main__":
    sys.exit(main())
