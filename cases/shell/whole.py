"""Files and folders that appear whole or not at all: made beside their place, moved there when complete."""

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from cases.shell.errors import InputError


@contextmanager
def writing(path: Path, failure: type[InputError], words: str = "cannot be written") -> Iterator[None]:
    """Name what cannot be written, in an error of a package's own family.

    Raises
    ------
    InputError
        Of the kind ``failure``, in place of an OSError.
    """
    try:
        yield
    except OSError as error:
        raise failure(f"{path}: {words}: {error.strerror or error}") from error


@contextmanager
def beside(path: Path) -> Iterator[Path]:
    """Hidden path beside a file, for this process alone; what is still there at the end is removed."""
    partial = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        yield partial
    finally:
        partial.unlink(missing_ok=True)


@contextmanager
def write_whole(path: Path) -> Iterator[Path]:
    """Path to write to; the file takes the place of ``path`` when the block has ended without an error.

    Raises
    ------
    OSError
        If it cannot take that place; an earlier file stays.
    """
    with beside(path) as partial:
        yield partial
        partial.replace(path)


def write_text(path: Path, text: str) -> None:
    """Write a file whole or not at all, UTF-8."""
    with write_whole(path) as partial:
        partial.write_text(text, encoding="utf-8", newline="\n")


@contextmanager
def write_whole_folder(place: Path) -> Iterator[Path]:
    """Folder to fill; it takes the place of ``place``, with all that is there, when the block has ended.

    Folders above that are missing are made, and removed again if nothing comes into them.

    Raises
    ------
    OSError
        If it cannot be made, or cannot take that place; an earlier folder stays.
    """
    made = [folder for folder in place.parents if not folder.exists()]
    place.parent.mkdir(parents=True, exist_ok=True)
    partial = Path(tempfile.mkdtemp(prefix=f".{place.name}.", suffix=".part", dir=place.parent))
    try:
        partial.chmod(0o755)
        yield partial
        _take_place(partial, place)
    finally:
        shutil.rmtree(partial, ignore_errors=True)
        for folder in made:
            if folder.is_dir() and not any(folder.iterdir()):
                folder.rmdir()


def _take_place(partial: Path, place: Path) -> None:
    """Rename the complete folder into place; an older one goes only then."""
    if not place.exists():
        partial.rename(place)
        return
    old = partial.with_suffix(".old")
    place.rename(old)
    try:
        partial.rename(place)
    except BaseException:
        old.rename(place)
        raise
    shutil.rmtree(old)
