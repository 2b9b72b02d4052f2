"""Arrays that take long to compute, kept in the user's cache under what determines them."""

import hashlib
import os
import tempfile
import zipfile
from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np

from cases.arrays import Floats
from solver.kernel_cache import usable_folder

MOST_ENTRIES = 256  # half a megabyte each on a grid of 120 x 48


def digest_of(parts: Iterable[str | Floats]) -> str:
    """Digest of words and arrays, shapes included."""
    digest = hashlib.sha256()
    for part in parts:
        if isinstance(part, str):
            digest.update(part.encode() + b"\0")
        else:
            digest.update(str(part.shape).encode() + np.ascontiguousarray(part, dtype=float).tobytes())
    return digest.hexdigest()


def kept_array(
    name: str, parts: Iterable[str | Floats], compute: Callable[[], Floats], folder: Path | None = None
) -> Floats:
    """Array from the cache, or computed and put there.

    Parameters
    ----------
    name : str
        What it is: the first part of its file's name.
    parts : iterable of str and ndarray
        All that determines it.
    compute : callable
        Computes it.
    folder : Path, optional
        Default: the folder ``walls`` of the user's cache. Without a writable one nothing is kept.

    Notes
    -----
    An entry that is damaged, checked by its own digest, is computed again. The folder holds 256 entries at
    most: those written first go.
    """
    place = usable_folder("walls") if folder is None else folder
    if place is None:
        return compute()
    path = place / f"{name}-{digest_of(parts)[:32]}.npz"
    found = _read(path)
    if found is None:
        found = np.ascontiguousarray(compute(), dtype=float)
        _write(path, found)
    return found


def _read(path: Path) -> Floats | None:
    try:
        with path.open("rb") as stream, np.load(stream, allow_pickle=False) as stored:
            values, stated = np.asarray(stored["values"], dtype=float), str(stored["digest"])
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None
    return values if digest_of([values]) == stated else None


def _write(path: Path, values: Floats) -> None:
    """Write whole or not at all; a cache that cannot be written costs time only."""
    try:
        handle, name = tempfile.mkstemp(prefix=f".{path.stem}.", suffix=".part", dir=path.parent)
    except OSError:
        return
    partial = Path(name)
    try:
        with os.fdopen(handle, "wb") as stream:
            np.savez(stream, values=values, digest=np.array(digest_of([values])))
        partial.replace(path)
        _make_room(path.parent)
    except OSError:
        partial.unlink(missing_ok=True)
    except BaseException:
        partial.unlink(missing_ok=True)
        raise


def _make_room(folder: Path) -> None:
    """Remove the entries written first where there are too many; other processes may do the same."""
    entries = list(folder.glob("*.npz"))
    if len(entries) > MOST_ENTRIES:
        for path in sorted(entries, key=_written)[:-MOST_ENTRIES]:
            path.unlink(missing_ok=True)


def _written(path: Path) -> float:
    """Time of writing; the past for an entry that another process just removed."""
    try:
        return path.stat().st_mtime
    except FileNotFoundError:
        return 0.0
