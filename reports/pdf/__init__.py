"""The report as a typeset PDF."""

from reports.pdf.render import render_pdf

__all__ = ["render_pdf"]
