"""Kinds of input files, and what to say of one that is given where another is wanted."""

from pathlib import Path
from typing import Literal

from cases.errors import CaseFileError
from cases.reading.yaml_nodes import Node

Kind = Literal["case", "study", "calibration"]

# the key that only files of this kind have, what they are called, and the command that takes them
_KINDS: dict[Kind, tuple[str, str, str]] = {
    "case": ("geometry", "a case file", "python -m validation.compare"),
    "study": ("base", "the study of a sweep", "python -m validation.sweep"),
    "calibration": ("case", "a calibration file", "python -m validation.calibrate"),
}


def require_kind(root: Node, path: Path, wanted: Kind) -> None:
    """Refuse a file of another kind as a whole, instead of each of its keys.

    Parameters
    ----------
    root : Node
        The parsed file.
    path : pathlib.Path
        For the message.
    wanted : str
        ``case``, ``study`` or ``calibration``.

    Raises
    ------
    CaseFileError
        The file lacks the mark of the wanted kind and has that of another.
    """
    mark, allowed, _ = _KINDS[wanted]
    if mark in root.section:
        return
    for key, called, command in _KINDS.values():
        if key in root.section:
            found = f"{path}: is {called} (it states {key!r})"
            raise CaseFileError(path, f"{found}; allowed: {allowed}; to run it: {command} {path}")
