"""The report of a finished comparison, whose libraries load while the models are computed."""

from importlib import import_module
from pathlib import Path

from cases.shell.interrupts import imports


def load_reports() -> None:
    """Load the package that draws, with Matplotlib and all it needs: about a second."""
    with imports():
        import_module("reports.build")


def write_reports(directory: Path) -> None:
    """Write report.html and report.pdf of a finished comparison into its directory.

    Raises
    ------
    ReportError
        If the directory is not a finished comparison.
    """
    from reports.build import write_reports as write

    write(directory)
