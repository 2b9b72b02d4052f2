"""One report, in HTML and PDF, from a finished comparison; a page from a sweep."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from reports.build import write_gallery, write_reports
    from reports.errors import ReportError
    from reports.sweep.build import write_sweep_page

__all__ = ["ReportError", "write_gallery", "write_reports", "write_sweep_page"]

_MODULES = {
    "ReportError": "reports.errors",
    "write_gallery": "reports.build",
    "write_reports": "reports.build",
    "write_sweep_page": "reports.sweep.build",
}


def __getattr__(name: str) -> Any:
    """What is exported, from its module when it is first asked for: importing the package stays cheap."""
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_MODULES[name]), name)
