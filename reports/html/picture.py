"""A figure's SVG as an image's address: short, and in the colours of the page around it."""

import re
from collections.abc import Callable

from markupsafe import Markup

# Colours of figures on white, and what stands for them on dark paper: the page's own, or of the same hue.
_ON_DARK = {
    "#ffffff": "#15181c",
    "#000000": "#e8e8e8",
    "#1a1a1a": "#f2f2f2",
    "#555555": "#b0b4ba",
    "#6a6a6a": "#a4a9b0",
    "#9a9a9a": "#8a9099",
    "#d8d8d8": "#3c424a",
    "#e3e8ee": "#2a3038",
    "#f2f2f2": "#23282e",
    "#f4ead8": "#4a3f2a",
    "#0072b2": "#56b4e9",
    "#009e73": "#3fcf9f",
    "#7b3294": "#c794dd",
    "#b8480b": "#f0935a",
}
_DIGITS = re.compile(r"(?<=[1-9]\.\d\d)\d+|(?<=\d0\.\d\d)\d+")  # finer than seen; a scale below 1 stays whole
_UNSEEN = re.compile(r"<\?.*?\?>|<!DOCTYPE[^>]*>|<!--.*?-->", re.DOTALL)
_UNREFERRED = re.compile(r' id="(?!C\d)[\w.]+_\d+"')  # matplotlib's names of groups
_NAMES = re.compile(r'(?<=id=")[\w.-]+(?=")|(?<=href="#)[\w.-]+(?=")|(?<=url\(#)[\w.-]+(?=\))')
_STYLES = re.compile(r'(?<= )style="([^"]*)"')
_COLOURS = re.compile("|".join(_ON_DARK))
_SVG = re.compile(r"<svg\b[^>]*>")


def image_address(svg: str) -> Markup:
    """Return a drawing's SVG as the address of an image, to stand in an attribute in double quotes."""
    plain = _UNREFERRED.sub("", _DIGITS.sub("", _UNSEEN.sub("", svg)))
    short = re.sub(r"\s+", " ", plain).replace("> <", "><").replace("xlink:href", "href")
    named = _numbered("n")
    short = _NAMES.sub(lambda found: named(found[0]), short)
    classes: dict[str, str] = {}
    classed = _numbered("s", classes)
    short = _STYLES.sub(lambda found: f'class="{classed(found[1])}"', short)
    short = _SVG.sub(lambda found: f"{found[0]}<style>{_rules(classes)}</style>", short, count=1)
    for letter, code in (("%", "%25"), ("#", "%23"), ("&", "%26"), ("'", "%26apos;"), ('"', "'")):
        short = short.replace(letter, code)
    return Markup(f"data:image/svg+xml;charset=utf-8,{short}")  # noqa: S704 (without quotes and entities)


def _numbered(letter: str, numbers: dict[str, str] | None = None) -> Callable[[str], str]:
    """Return what gives each text a short name, the same for the same text."""
    known = {} if numbers is None else numbers
    return lambda text: known.setdefault(text, f"{letter}{len(known)}")


def _rules(classes: dict[str, str]) -> str:
    """Styles by class, and what a browser applies instead where the page around the image is dark."""
    light = "".join(f".{name}{{{style}}}" for style, name in classes.items())
    dark = "".join(
        f".{name}{{{_COLOURS.sub(lambda found: _ON_DARK[found[0]], style)}}}"
        for style, name in classes.items()
        if _COLOURS.search(style)
    )
    return f"{light}@media (prefers-color-scheme:dark){{svg{{fill:#e8e8e8}}{dark}}}"
