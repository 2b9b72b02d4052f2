"""Draw the reports of finished comparisons again: python -m reports DIR [DIR …]."""

import argparse
import sys
from pathlib import Path

from reports.build import write_gallery, write_reports
from reports.errors import ReportError


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
        help="what `python -m validation.compare` left",
    )
    directories: list[Path] = list(dict.fromkeys(parser.parse_args().directories))
    try:
        written = (write_gallery(directories),) if len(directories) > 1 else write_reports(directories[0])
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
