"""One report, in HTML and PDF, from a finished comparison."""

from reports.build import write_gallery, write_reports
from reports.errors import ReportError

__all__ = ["ReportError", "write_gallery", "write_reports"]
