"""Which FEBio is run."""

import os
import shutil
from pathlib import Path

from febio_io.errors import FebioError

NAME = "febio4"
VARIABLE = "FEBIO"
INSTALL = (
    "Install FEBio 4 (https://febio.org/downloads, or build https://github.com/febiosoftware/FEBio), then "
    f"put the folder of {NAME} on PATH, set the environment variable {VARIABLE} to the program, or state "
    "--febio PATH"
)


class FebioRunError(FebioError):
    """FEBio cannot be run, or did not end as it should."""


def find_febio(stated: str | None) -> Path:
    """Find FEBio's program.

    Parameters
    ----------
    stated : str or None
        What the user states: a path, or a name on PATH. Else the environment variable FEBIO says it, else it
        is febio4 on PATH.

    Returns
    -------
    Path
        The absolute path of the program.

    Raises
    ------
    FebioRunError
        If there is none; the message says what to install.
    """
    wanted, origin = stated, "--febio"
    if wanted is None and (configured := os.environ.get(VARIABLE)):
        wanted, origin = configured, f"the environment variable {VARIABLE}"
    found = shutil.which(wanted or NAME)
    if found is not None:
        return Path(found).absolute()
    if wanted is None:
        raise FebioRunError(f"FEBio is not installed: there is no {NAME} on PATH. {INSTALL}")
    what = "is a folder" if Path(wanted).is_dir() else "is no program that can be run"
    raise FebioRunError(f"{wanted}, stated by {origin}, {what}. {INSTALL}")
