"""Tells what an FEBio result file holds, and writes it in other formats: ``python -m febio_io FILE``."""

import os
import sys

from febio_io.interrupts import interrupts_deferred


def run() -> int:
    """Run the command; a Ctrl-C ends it quietly, even one that comes while it is still being imported."""
    try:
        with interrupts_deferred():
            from febio_io.command import main
        return main()
    except BrokenPipeError:
        # The reader of a pipe has seen enough; nothing may be flushed into it at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(run())
