"""The report as one self-contained HTML file."""

from reports.html.render import render_html

__all__ = ["render_html"]
