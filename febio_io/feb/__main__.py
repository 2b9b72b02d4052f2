"""Writes the FEBio model of a case: ``python -m febio_io.feb CASE.yaml --output MODEL.feb``."""

import sys

from febio_io.interrupts import interrupts_deferred


def run() -> int:
    """Run the command; a Ctrl-C ends it quietly, even one that comes while it is still being imported."""
    try:
        with interrupts_deferred():
            from febio_io.feb.command import main
        return main()
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(run())
