"""FEBio's log files (.log)."""

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
SIGNS = ("F O R   B I O M E C H A N I C S", " FILES USED", "===== beginning time step")


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
    """Whether a text begins like a log: with FEBio's banner, its list of files or a time step."""
    return any(sign in start for sign in SIGNS)
