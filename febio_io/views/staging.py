"""Files of an export: how they are called, and that each appears whole or not at all."""

import re
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from cases.shell.whole import writing
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

    Raises
    ------
    FebioFileError
        If the files cannot be written.
    """
    made = not folder.exists()
    try:
        with writing(folder, FebioFileError, "cannot be written to"):
            folder.mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryDirectory(prefix=".febio_io-", dir=folder) as temporary:
                yield Path(temporary)
                paths = Path(temporary).iterdir()
                for path in sorted(paths, key=lambda path: (path.suffix == ".pvd", path.name)):
                    target = folder / path.name
                    path.replace(target)
                    written.append(target)
    finally:
        if made and not written and folder.is_dir():
            folder.rmdir()


def safe_name(name: str) -> str:
    """Replace what not every file system takes by underscores.

    Returns
    -------
    str
        Letters, digits, dots, dashes and underscores; not empty, and neither dot nor underscore at an end.
    """
    return re.sub(r"[^\w.-]+", "_", name).strip("._") or "unnamed"
