"""Where the files that a case names are found."""

from pathlib import Path


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
    for start in (folder, *folder.parents):
        candidate = start / name
        try:
            if candidate.is_file():
                return candidate.resolve()
        except OSError:  # a name too long, a folder that may not be read: not found there
            continue
    return None
