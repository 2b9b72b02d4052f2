"""Draw the reports of finished comparisons, or the page of a sweep, again: python -m reports DIR [DIR …]."""

import argparse
import sys
from pathlib import Path

from reports.build import write_gallery, write_reports
from reports.errors import ReportError
from reports.sweep import is_sweep, write_sweep_page


def _written(directories: list[Path]) -> tuple[Path, ...]:
    if len(directories) > 1:
        return (write_gallery(directories),)
    (directory,) = directories
    return write_sweep_page(directory) if is_sweep(directory) else write_reports(directory)


def main() -> int:
    """Write both reports of each directory; return 0, or 2 where one holds no finished comparison."""
    parser = argparse.ArgumentParser(
        prog="python -m reports",
        description=__doc__,
        epilog="With several directories, gallery.html in the folder that holds them leads to all reports.",
    )
    parser.add_argument(
        "directories",
        metavar="DIR",
        type=Path,
        nargs="+",
        help="what `python -m validation.compare` or `python -m validation.sweep` left",
    )
    directories: list[Path] = list(dict.fromkeys(parser.parse_args().directories))
    try:
        written = _written(directories)
    except (ReportError, OSError) as error:
        print(f"reports: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("reports: interrupted", file=sys.stderr)
        return 130
    for path in written:
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
