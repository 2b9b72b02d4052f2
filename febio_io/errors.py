"""The errors that reading FEBio's files can raise: one family, one clear message each."""

from collections.abc import Iterable
from difflib import SequenceMatcher
from pathlib import Path

from cases.shell.errors import InputError


class FebioError(InputError):
    """Base of every error of this package."""


class FebioFileError(FebioError):
    """A file that is missing, cannot be opened, or is of another kind."""


class FebioFormatError(FebioError):
    """A file whose bytes contradict its format.

    Attributes
    ----------
    path : Path
        The file.
    offset : int or None
        Byte at which the contradiction was found: in the file, or in the inflated stream.
    tag : int or None
        Tag of the chunk that was being read.
    stream_offset : int or None
        Where the compressed stream starts that `offset` counts in; None for bytes of the file itself.
    """

    def __init__(
        self,
        message: str,
        *,
        path: Path,
        offset: int | None = None,
        tag: int | None = None,
        stream_offset: int | None = None,
    ) -> None:
        self.path = path
        self.offset = offset
        self.tag = tag
        self.stream_offset = stream_offset
        super().__init__(f"{path}: {message}{self._place()}")

    def _place(self) -> str:
        parts = []
        if self.tag is not None:
            parts.append(f"chunk {self.tag:#010x}")
        if self.offset is not None:
            parts.append(f"at byte {self.offset}")
        if self.stream_offset is not None:
            parts.append(f"of the compressed data that starts at byte {self.stream_offset}")
        return f" ({' '.join(parts)})" if parts else ""


class FebioKeyError(FebioError, LookupError):
    """A variable, state or region that the file does not have; the message lists what it has."""


def nearest_first(wanted: str, names: Iterable[str]) -> list[str]:
    """Sort names, each once, by their likeness to the wanted one."""
    matcher = SequenceMatcher(b=wanted.lower())

    def unlikeness(name: str) -> float:
        matcher.set_seq1(name.lower())
        return -matcher.ratio()

    return sorted(dict.fromkeys(names), key=unlikeness)
