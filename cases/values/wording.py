"""How messages show what was found and suggest what was meant."""

import difflib
from collections.abc import Iterable

LONGEST_SHOWN = 60
LONGEST_FILE_NAME = 255  # that file systems take


def shown(value: object) -> str:
    """Show a value of a case file in a message, cut where it is long."""
    match value:
        case None:
            return "nothing"
        case str() if not value.strip():
            return "nothing"
        case bool():
            return str(value).lower()
        case dict():
            return "a section"
        case list() | tuple():
            return "a list"
        case _:
            text = " ".join(str(value).split())
            return text if len(text) <= LONGEST_SHOWN else text[: LONGEST_SHOWN - 1] + "…"


def shown_path(path: str) -> str:
    """Show the path of a file: its name in full, its folder cut in the middle where it is long."""
    text = " ".join(path.split())
    folder, separator, name = text.rpartition("/")
    if len(text) <= LONGEST_SHOWN or len(name) > LONGEST_FILE_NAME:
        return shown(path)
    kept = max(LONGEST_SHOWN - len(name), LONGEST_SHOWN // 3) // 2
    if len(folder) > 2 * kept:
        folder = f"{folder[:kept]}…{folder[-kept:]}"
    return f"{folder}{separator}{name}"


def nearest(word: str, known: Iterable[str]) -> str:
    """Return "; did you mean …?" for the known word closest to one, or nothing if none is close."""
    folded = {candidate.casefold(): candidate for candidate in reversed(list(known))}
    close = difflib.get_close_matches(word.casefold(), folded, n=1, cutoff=0.6)
    return f"; did you mean {folded[close[0]]}?" if close else ""


def choices(words: Iterable[str]) -> str:
    """Join the allowed words for a message."""
    return ", ".join(words)


def but_allowed(found: str, allowed: str) -> str:
    """Return "found; allowed: …", or "found; did you mean …? allowed: …"."""
    return f"{found}{' ' if found.endswith('?') else '; '}allowed: {allowed}"


def unknown_key(key: str, known: Iterable[str]) -> str:
    """Return the message for a key that a section does not have."""
    keys = list(known)
    return but_allowed(f"unknown key {shown(key)}{nearest(key, keys)}", choices(keys))


def not_one_of(word: object, known: Iterable[str]) -> str:
    """Return the message for a value that is none of the known words."""
    words = list(known)
    suggestion = nearest(word, words) if isinstance(word, str) else ""
    return but_allowed(f"{shown(word)}{suggestion}", choices(words))
