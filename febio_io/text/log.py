"""FEBio's log files (.log)."""

import re
from os import PathLike
from pathlib import Path

from febio_io.errors import FebioFileError
from febio_io.files import read_text
from febio_io.text.log_model import Input, Iteration, Log, Message, Norm, RecordLines, TimeStep
from febio_io.text.log_reader import parse_log

__all__ = [
    "Input",
    "Iteration",
    "Log",
    "Message",
    "Norm",
    "RecordLines",
    "TimeStep",
    "looks_like_log",
    "read_log",
]

LOOKED_AT = 1 << 16
# The banner may stand in any text about FEBio: a log has a list of files, a time step, an ending or a box.
SIGNS = re.compile(
    r"^ FILES USED\s*$|^===== beginning time step \d|^ [NE] [OR] R [A-Z ]+ {3}T E R M I N A T I O N"
    r"|F O R   B I O M E C H A N I C S[^*]{0,9999}^ \*{60,}",
    re.MULTILINE,
)


def read_log(path: str | PathLike[str]) -> Log:
    """Read an FEBio log file.

    Parameters
    ----------
    path : path-like
        The file, of any version; what it does not tell is left empty.

    Returns
    -------
    Log
        What it tells.

    Raises
    ------
    FebioFileError
        If the file cannot be opened or is no FEBio log.
    """
    path = Path(path)
    text = read_text(path)
    if not looks_like_log(text[:LOOKED_AT]):
        raise FebioFileError(f"{path}: not an FEBio log: it starts with {text[:20]!r}")
    return parse_log(path, text)


def looks_like_log(start: str) -> bool:
    """Whether a text begins like a log, with what a run leaves there; FEBio's banner alone is none."""
    return SIGNS.search(start) is not None
