"""Parts of the coupled model: ``python -m validation.ablation CASE.yaml``."""

import sys

from cases.shell.command import run

if __name__ == "__main__":
    sys.exit(run("validation.ablation.command"))
