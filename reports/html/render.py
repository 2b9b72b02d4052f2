"""The report as one self-contained HTML file: nothing is loaded from elsewhere."""

import base64
import gzip
import hashlib
import re
from collections.abc import Mapping
from functools import cache
from importlib.resources import files

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup, escape

from reports.blocks import Figure, Interactive, Report
from reports.html.picture import image_address

_LARGE = 8_000  # bytes
_SUBSCRIPTED = re.compile(r"\b([vq])_([rxφ])\b")
_RAISED = re.compile(r"\^γ")


def render_html(report: Report, drawings: Mapping[str, str]) -> str:
    """Return the HTML text of `report`; texts are escaped, figures (SVG by key) and their data embedded."""
    pictures = tuple(dict.fromkeys(block.picture for block in report.interactives()))
    script = _scripts(pictures, "fields" in report.data)
    return (
        environment()
        .get_template("report.html")
        .render(
            report=report,
            drawings=drawings,
            script=Markup(script),  # noqa: S704 (the package's own)
            checksum=_checksum(script),
            data=Markup(report.page_data().replace("<", "\\u003c")),  # noqa: S704 (JSON that ends no script)
        )
    )


@cache
def environment() -> Environment:
    """Templates of this package; every text that is filled in is escaped."""
    made = Environment(
        loader=PackageLoader("reports.html", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.filters["image_address"] = image_address
    made.filters["data_link"] = _data_link
    made.filters["kind"] = lambda block: type(block).__name__
    made.filters["svg_size"] = _svg_size
    made.filters["symbols"] = _symbols
    made.tests["scripted"] = lambda section: all(isinstance(block, Interactive) for block in section.blocks)
    return made


def _symbols(text: str) -> Markup:
    """Escape a text and set its symbols as mathematics: v_x, (r/R)^γ."""
    escaped = str(escape(text))
    lowered = _SUBSCRIPTED.sub(r"<i>\1</i><sub>\2</sub>", escaped)
    return Markup(_RAISED.sub("<sup>γ</sup>", lowered))  # noqa: S704 (escaped above)


@cache
def _scripts(pictures: tuple[str, ...], on_cells: bool) -> str:
    """Join what a page needs that has these interactive pictures, some of the lumen's cells."""
    folder = files("reports.html").joinpath("scripts")
    cells = ("chosen", "raster") if on_cells else ()
    names = ("data", "controls", "tables", "views", "scales", "chart", *cells, *pictures)
    texts = [folder.joinpath(f"{name}.js").read_text(encoding="utf-8") for name in (*names, "start")]
    drawn = f"const PICTURES = {{ {', '.join(pictures)} }};"
    bar = f"const fillBar = {'choosing' if on_cells else 'null'};"
    return "\n".join(['"use strict";', "{", *texts[:-1], drawn, bar, texts[-1], "}"])


def _checksum(script: str) -> str:
    """Return what the page's security policy allows the script by."""
    return f"'sha256-{base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()}'"


def _data_link(figure: Figure) -> Markup:
    """Link to the numbers behind a figure; many are compressed, or they would be most of the page."""
    content, name, mime, words = figure.csv.encode(), f"{figure.key}.csv", "text/csv;charset=utf-8", "CSV"
    if len(content) > _LARGE:
        content = gzip.compress(content, compresslevel=6, mtime=0)
        name, mime, words = f"{name}.gz", "application/gzip", "CSV, gzip"
    return Markup('<a download="{}" href="data:{};base64,{}">Data ({})</a>').format(
        name, mime, base64.b64encode(content).decode(), words
    )


def _svg_size(svg: str) -> tuple[float, float]:
    """Width and height (pt) of a drawing, so that the page does not jump while it loads."""
    found = re.search(r'width="([\d.]+)pt" height="([\d.]+)pt"', svg)
    if found is None:
        raise ValueError("a figure without width and height in points")
    return float(found[1]), float(found[2])
