"""Where the files that a case names are found, and how they are read."""

import stat
from collections.abc import Callable
from pathlib import Path

from cases.errors import UnreadableFileError


def find_file(name: str, folder: Path) -> Path | None:
    """Find a file by a path relative to a folder, or else to the nearest folder above that has it.

    Parameters
    ----------
    name : str
        Path of the file, relative or absolute.
    folder : pathlib.Path
        Absolute folder of the case file.

    Returns
    -------
    pathlib.Path or None
        The absolute path, or None where no folder has such a file.
    """
    found = _nearest(name, folder, Path.is_file)
    return None if found is None else found.resolve()


def place_for(name: str, folder: Path) -> Path:
    """Say where a file is to be that does not exist yet.

    Parameters
    ----------
    name : str
        Path of the file, relative or absolute.
    folder : pathlib.Path
        Absolute folder of the case file.

    Returns
    -------
    pathlib.Path
        An absolute path: in that folder, or else in the nearest folder above, where its own folder exists.
    """
    return _nearest(name, folder, lambda candidate: candidate.parent.is_dir()) or folder / name


def _nearest(name: str, folder: Path, fits: Callable[[Path], bool]) -> Path | None:
    """First path that fits, in a folder or those above it."""
    for start in (folder, *folder.parents):
        candidate = start / name
        try:
            if fits(candidate):
                return candidate
        except OSError:  # a name too long, a folder that may not be read: not found there
            continue
    return None


def read_file(path: Path, largest: int) -> bytes:
    """Read a regular file: no folder, device or pipe, which may never end.

    Raises
    ------
    UnreadableFileError
        It is missing, no regular file, not readable or too large; the message is the reason alone.
    """
    try:
        mode = path.stat().st_mode
        if stat.S_ISDIR(mode):
            raise UnreadableFileError("a folder")
        if not stat.S_ISREG(mode):
            raise UnreadableFileError("a device or a pipe")
        with path.open("rb") as stream:
            content = stream.read(largest + 1)
    except OSError as error:
        raise UnreadableFileError(str(error.strerror or error)) from error
    if len(content) > largest:
        raise UnreadableFileError(f"larger than {largest} bytes")
    return content
