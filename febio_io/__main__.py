"""Tells what an FEBio result file holds, and writes it in other formats: ``python -m febio_io FILE``."""

import os
import sys

from febio_io.interrupts import run_command


def run() -> int:
    """Run the command; a Ctrl-C ends it quietly, and so does a pipe that its reader has closed."""
    try:
        return run_command("febio_io.command")
    except BrokenPipeError:
        # The reader of a pipe has seen enough; nothing may be flushed into it at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1


if __name__ == "__main__":
    sys.exit(run())
