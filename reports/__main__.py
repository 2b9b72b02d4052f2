"""Draw the reports of a finished comparison again: python -m reports DIR."""

import argparse
import sys
from pathlib import Path

from reports.build import write_reports
from reports.errors import ReportError


def main() -> int:
    """Write both reports; return 0, or 2 for a directory that holds no finished comparison."""
    parser = argparse.ArgumentParser(prog="python -m reports", description=__doc__)
    parser.add_argument(
        "directory", metavar="DIR", type=Path, help="what `python -m validation.compare` left"
    )
    directory: Path = parser.parse_args().directory
    try:
        written = write_reports(directory)
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
