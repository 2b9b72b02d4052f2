"""Which states, or blocks of a data record, a command is to use."""

import re

from febio_io.errors import FebioKeyError

RANGE = re.compile(r"(-?\d{1,9})(?::(-?\d{1,9})(?::(\d{1,9}))?)?")


def parse_states(text: str, count: int) -> list[int]:
    """Read a list of numbers and ranges.

    Parameters
    ----------
    text : str
        E.g. "0,5,10:20,-1" or "0:-1:10": numbers from 0, or from the end if negative; FIRST:LAST and
        FIRST:LAST:STEP are ranges that include the last. Each number counts once, in increasing order.
    count : int
        How many there are.

    Returns
    -------
    list of int
        The numbers.

    Raises
    ------
    FebioKeyError
        If the text is no such list, or a number is not there.
    """
    chosen: set[int] = set()
    for part in text.split(","):
        match = RANGE.fullmatch(part.strip())
        if not match or match[3] == "0":
            raise FebioKeyError(
                f"states {part.strip()!r}: a number, FIRST:LAST or FIRST:LAST:STEP is expected"
            )
        first = _number(match[1], count)
        last = _number(match[2], count) if match[2] else first
        chosen.update(range(first, last + 1, int(match[3] or 1)))
    return sorted(chosen)


def _number(text: str, count: int) -> int:
    number = int(text)
    if not -count <= number < count:
        have = f"0 to {count - 1}" if count else "none"
        raise FebioKeyError(f"state {number} is not there; there are {have}")
    return number % count
