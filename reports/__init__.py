"""One report, in HTML and PDF, from a finished comparison; a page from a sweep."""

from reports.build import write_gallery, write_reports
from reports.errors import ReportError
from reports.sweep import write_sweep_page

__all__ = ["ReportError", "write_gallery", "write_reports", "write_sweep_page"]
