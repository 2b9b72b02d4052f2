"""Writing files so that each appears whole or not at all."""

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from febio_io.errors import FebioFileError


@contextmanager
def staged(folder: Path, written: list[Path]) -> Iterator[Path]:
    """Give a temporary folder whose files are moved into another one at the end.

    If anything goes wrong, or the user interrupts, nothing is moved and nothing is left behind.

    Parameters
    ----------
    folder : Path
        Where the files are to be; it is made if it is not there.
    written : list of Path
        Takes in the files' paths. Those that tell of others (.pvd) are moved last.

    Yields
    ------
    Path
        The temporary folder.

    Raises
    ------
    FebioFileError
        If the files cannot be written.
    """
    made = not folder.exists()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        temporary = Path(tempfile.mkdtemp(prefix=".febio_io-", dir=folder))
    except OSError as error:
        raise FebioFileError(f"{folder}: cannot be written to: {error.strerror}") from error
    try:
        yield temporary
        for path in sorted(temporary.iterdir(), key=lambda path: (path.suffix == ".pvd", path.name)):
            target = folder / path.name
            os.replace(path, target)  # noqa: PTH105 - the name says what matters
            written.append(target)
    except OSError as error:
        raise FebioFileError(f"{folder}: cannot be written to: {error.strerror or error}") from error
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
        if made and not written:
            folder.rmdir()
