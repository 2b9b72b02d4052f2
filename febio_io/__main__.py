"""Prints what an FEBio plot file holds: ``python -m febio_io FILE.xplt``."""

import argparse
import json
import os
import sys
from collections.abc import Sequence
from pathlib import Path

from febio_io.errors import FebioError
from febio_io.xplt import open_plot
from febio_io.xplt.summary import summarize, summary_lines


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    arguments : sequence of str, optional
        Arguments of the command line; those of the process by default.

    Returns
    -------
    int
        Exit status: 0, or 2 if the file cannot be read.
    """
    parser = argparse.ArgumentParser(
        prog="python -m febio_io", description="Print what an FEBio plot file holds."
    )
    parser.add_argument("file", type=Path, metavar="FILE.xplt", help="the plot file")
    parser.add_argument("--json", action="store_true", help="print JSON, for programs")
    options = parser.parse_args(arguments)
    try:
        with open_plot(options.file) as plot:
            summary = summarize(plot)
    except FebioError as error:
        print(f"febio_io: {error}", file=sys.stderr)
        return 2
    print(json.dumps(summary, indent=2) if options.json else "\n".join(summary_lines(summary)))
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except BrokenPipeError:
        # The reader of a pipe has seen enough; nothing may be flushed into it at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(1)
    except KeyboardInterrupt:
        sys.exit(130)
