"""The report as one self-contained HTML file: no script, no network."""

import base64
import re
from collections.abc import Mapping
from functools import cache

from jinja2 import Environment, PackageLoader, StrictUndefined

from reports.blocks import Report


def render_html(report: Report, drawings: Mapping[str, str]) -> str:
    """Return the HTML text of `report`; texts are escaped, figures (SVG by key) and their data embedded."""
    return _environment().get_template("report.html").render(report=report, drawings=drawings)


@cache
def _environment() -> Environment:
    environment = Environment(
        loader=PackageLoader("reports.html", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["data_uri"] = _data_uri
    environment.filters["kind"] = lambda block: type(block).__name__
    environment.filters["svg_size"] = _svg_size
    return environment


def _data_uri(text: str, mime: str) -> str:
    return f"data:{mime};base64,{base64.b64encode(text.encode()).decode()}"


def _svg_size(svg: str) -> tuple[float, float]:
    """Width and height (pt) of a drawing, so that the page does not jump while it loads."""
    found = re.search(r'width="([\d.]+)pt" height="([\d.]+)pt"', svg)
    if found is None:
        raise ValueError("a figure without width and height in points")
    return float(found[1]), float(found[2])
