"""``python -m validation.reference FILES``: what they hold, and a ``reference:`` section ready to paste."""

import argparse
from collections.abc import Sequence

from cases.shell.command import COMPLETE, concluded
from cases.shell.interrupts import imports


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Return what the command line states."""
    parser = argparse.ArgumentParser(
        description="Tell what files of a 3D result hold (FEBio's .xplt, XDMF, or what VTK reads), and write "
        "the section of a case file that reads them, by guesses.",
    )
    parser.add_argument(
        "files", nargs="+", metavar="FILE", help="files of one result, or a pattern such as result_{:03d}.vtu"
    )
    return parser.parse_args(argv)


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status: 0, or 2 where the files cannot be read."""
    chosen = arguments(argv)
    return concluded(lambda: _run(chosen.files))


def _run(files: list[str]) -> int:
    with imports():
        from validation.reference.inspection.page import page
    print("\n".join(page(files)))
    return COMPLETE
