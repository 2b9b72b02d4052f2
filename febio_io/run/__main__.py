"""Runs FEBio on a model, shows how far it is and says how it ended: ``python -m febio_io.run MODEL.feb``."""

import sys

from febio_io.interrupts import interrupts_deferred


def run() -> int:
    """Run the command; a Ctrl-C ends it quietly, even one that comes while it is still being imported."""
    try:
        with interrupts_deferred():
            from febio_io.run.command import main
        return main()
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(run())
