"""Numbers as people read them."""

import math
from collections.abc import Iterable

ABSENT = "—"
SPACE = "\u00a0"  # a number keeps its unit on the same line

_LEAST_SHARE = 5e-5  # what two decimals of a percentage can tell from zero

#: SI unit → unit and factor in which differences are shown: one step finer than the quantity itself.
DIFFERENCE_UNITS = {
    "Pa": ("Pa", 1.0),
    "m": ("μm", 1e6),
    "m s-1": ("mm/s", 1e3),
    "m3 s-1": ("mm³/s", 1e9),
    "s": ("ms", 1e3),
    "Pa m": ("N/m", 1.0),
    "1": ("", 1.0),
}


def fixed(value: float | None, decimals: int) -> str:
    """`value` with so many decimals, a true minus sign, "—" for an absent one."""
    if value is None or math.isnan(value):
        return ABSENT
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    text = f"{value:.{decimals}f}"
    if float(text) == 0:
        text = text.lstrip("-")
    return text.replace("-", "−")


def decimals_for(values: Iterable[float | None], significant: int, most: int = 6) -> int:
    """Return the decimals, `most` at most, that give the largest of `values` so many significant digits."""
    sizes = [abs(v) for v in values if v is not None and math.isfinite(v) and v != 0]
    if not sizes:
        return 0
    return min(most, max(0, significant - 1 - math.floor(math.log10(max(sizes)))))


def rounded(value: float | None, significant: int = 4) -> str:
    """`value` to so many significant digits, without exponent."""
    text = fixed(value, decimals_for([value], significant))
    return "0" if _is_zero(text) else text


def span(low: float, high: float, decimals: int) -> str:
    """E.g. "1.71 … 2.61", or one number where both are the same to so many decimals."""
    ends = dict.fromkeys((fixed(low, decimals), fixed(high, decimals)))
    return " … ".join(ends)


def signed(value: float | None, significant: int = 3) -> str:
    """As `rounded`, with a plus sign where there is no minus."""
    return plus(rounded(value, significant))


def plus(text: str) -> str:
    """Put a plus sign before a number that is neither negative, nor zero, nor absent."""
    return text if text.startswith(("−", ABSENT)) or _is_zero(text) else f"+{text}"


def percent(ratio: float | None, decimals: int = 2) -> str:
    """Write a relative figure as a signed percentage, e.g. −4.71 %."""
    text = fixed(None if ratio is None else 100 * ratio, decimals)
    return text if text == ABSENT else f"{plus(text)}{SPACE}%"


def unsigned(text: str) -> str:
    """Take the plus sign from a figure that is never negative."""
    return text.removeprefix("+")


def share(value: float | None) -> str:
    """Write the size of a relative figure; one too small for two decimals is not shown as zero."""
    if value == 0:
        return f"0{SPACE}%"
    if value is not None and abs(value) < _LEAST_SHARE:
        return f"<{SPACE}0.01{SPACE}%"
    return unsigned(percent(None if value is None else abs(value)))


def _is_zero(text: str) -> bool:
    return not text.strip("0.")


def with_unit(text: str, unit: str) -> str:
    """Join number and unit so that they stay on one line."""
    return text if unit in ("", "1") or text == ABSENT else f"{text}{SPACE}{unit}"


def counted(count: int, noun: str) -> str:
    """E.g. "1 band", "3 bands"."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def listed(items: Iterable[object]) -> str:
    """E.g. "1, 39 and 61"; what has commas itself stands between semicolons."""
    words = [str(item) for item in items]
    if any("," in word for word in words):
        return "; ".join(words)
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}" if words else ""
