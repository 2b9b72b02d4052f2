"""Opening files that are to be read: files on a disk, not what never ends."""

import stat
from pathlib import Path
from typing import BinaryIO

from febio_io.errors import FebioFileError


def open_file(path: Path) -> BinaryIO:
    """Open a file for reading bytes.

    Raises
    ------
    FebioFileError
        If it cannot be opened, or is a folder, a device or a pipe: the latter may never end, or never begin.
    """
    try:
        mode = path.stat().st_mode
        if not stat.S_ISREG(mode):
            what = "Is a directory" if stat.S_ISDIR(mode) else "it is a device or a pipe, not a file"
            raise FebioFileError(f"{path}: cannot be opened: {what}")
        return path.open("rb")
    except OSError as error:
        raise FebioFileError(f"{path}: cannot be opened: {error.strerror}") from error
    except ValueError as error:  # a NUL in the name
        raise FebioFileError(f"{str(path)!r}: cannot be opened: {error}") from error


def text_of(content: bytes) -> str:
    """Give a file's text; what is not UTF-8, or UTF-16 where the first bytes say so, is replaced."""
    encoding = "utf-16" if content.startswith((b"\xff\xfe", b"\xfe\xff")) else "utf-8-sig"
    return content.decode(encoding, errors="replace")


def read_text(path: Path) -> str:
    """Read a file of text, as :func:`text_of`.

    Raises
    ------
    FebioFileError
        If it cannot be opened or read.
    """
    try:
        with open_file(path) as file:
            return text_of(file.read())
    except OSError as error:
        raise FebioFileError(f"{path}: cannot be read: {error.strerror}") from error
