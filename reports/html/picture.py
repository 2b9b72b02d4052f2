"""A figure's SVG as an image's address: short, and in the colours of the page around it."""

import re

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
    "#f4ead8": "#4a3f2a",
    "#0072b2": "#56b4e9",
    "#009e73": "#3fcf9f",
    "#7b3294": "#c794dd",
    "#b8480b": "#f0935a",
}
_DIGITS = re.compile(
    r"(?<=[1-9]\.\d\d)\d+|(?<=\d0\.\d\d)\d+"
)  # a hundredth of a point is not seen; a scale below 1 stays whole
_UNSEEN = re.compile(r'<\?.*?\?>|<!DOCTYPE[^>]*>|<!--.*?-->| id="(?!C\d)[\w.]+_\d+"', re.DOTALL)
_FIRST_TAG = re.compile(r"(<svg\b[^>]*>)")


def image_address(svg: str) -> Markup:
    """Return a drawing's SVG as the address of an image, to stand in an attribute in double quotes."""
    short = _DIGITS.sub("", _UNSEEN.sub("", svg))
    short = re.sub(r"\s+", " ", short).replace("> <", "><").replace("xlink:href", "href")
    themed = _FIRST_TAG.sub(rf"\1<style>{_dark_style()}</style>", short, count=1)
    for letter, code in (("%", "%25"), ("#", "%23"), ("&", "%26"), ("'", "%26apos;"), ('"', "'")):
        themed = themed.replace(letter, code)
    return Markup(f"data:image/svg+xml;charset=utf-8,{themed}")  # noqa: S704 (without quotes and entities)


def _dark_style() -> str:
    """Rules that a browser applies where the page around the image is dark; inline styles yield to them."""
    rules = [
        f'[style*="{what}: {light}"]{{{what}:{dark}!important}}'
        for light, dark in _ON_DARK.items()
        for what in ("fill", "stroke")
    ]
    return "@media (prefers-color-scheme:dark){svg{fill:#e8e8e8}" + "".join(rules) + "}"
