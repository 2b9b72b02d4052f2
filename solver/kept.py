"""Arrays that take long to compute, kept on disk under a digest of what determines them.

An entry is one file, written whole or not at all, so that several processes may share the folder and one
that is killed leaves no half of it. Its checksums (those of the zip format) tell a damaged one. Entries used
longest ago go when the folder exceeds its limit.
"""

import hashlib
import os
import time
import tokenize
import warnings
import zipfile
import zlib
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cases.arrays import Floats
from solver.kernel_cache import usable_folder

ABANDONED = 24 * 3600.0  # s after which an unfinished file belongs to a process that has died

# What zipfile and NumPy raise on octets that are none of theirs: RuntimeError (NotImplementedError) of a
# member that seems encrypted (of another method), TokenError and SyntaxError of an array's header.
DAMAGE = (
    *(OSError, EOFError, ValueError, KeyError, TypeError, zipfile.BadZipFile, zlib.error),
    *(RuntimeError, OverflowError, MemoryError, SyntaxError, tokenize.TokenError),
)

Arrays = Mapping[str, NDArray[Any]]


class DamagedEntryError(Exception):
    """An entry that does not hold what was written; it has been removed."""


@dataclass(frozen=True)
class KeptArrays:
    """A folder of entries.

    Attributes
    ----------
    folder : pathlib.Path
        Exists and can be written to.
    limit : int
        Bytes that entries may take together.
    """

    folder: Path
    limit: int

    def get(self, key: str) -> dict[str, NDArray[Any]] | None:
        """Arrays under a key by name, or None if there are none.

        Raises
        ------
        DamagedEntryError
            If they are damaged.
        """
        path = self.folder / f"{key}.npz"
        try:
            with path.open("rb") as stream, np.load(stream, allow_pickle=False) as stored:
                found = dict(stored)
            os.utime(path)
        except FileNotFoundError:  # also where another process just made room
            return None
        except DAMAGE as error:
            path.unlink(missing_ok=True)
            raise DamagedEntryError(f"{path} was damaged ({error})") from error
        return found

    def put(self, key: str, arrays: Arrays) -> None:
        """Keep arrays, and make room for them.

        Raises
        ------
        OSError
            If they cannot be written.
        """
        partial = self.folder / f".{key}.{os.getpid()}.{time.monotonic_ns()}.part"
        try:
            with partial.open("wb") as stream:
                np.savez(stream, allow_pickle=False, **arrays)
            partial.replace(self.folder / f"{key}.npz")
            self._make_room()
        finally:
            partial.unlink(missing_ok=True)

    def _make_room(self) -> None:
        """Remove what processes left unfinished, then the entries used longest ago."""
        for path in self.folder.glob(".*.part"):
            if _use(path)[0] < time.time() - ABANDONED:
                path.unlink(missing_ok=True)
        total = 0
        for (_, size), path in sorted(
            ((_use(path), path) for path in self.folder.glob("*.npz")), reverse=True
        ):
            total += size
            if total > self.limit:
                path.unlink(missing_ok=True)


def _use(path: Path) -> tuple[float, int]:
    """Time of last use and size; now and none for a file that another process just removed."""
    try:
        found = path.stat()
    except FileNotFoundError:
        return time.time(), 0
    return found.st_mtime, found.st_size


LIMIT = 128 * 1024**2  # bytes: half a megabyte each on a grid of 120 x 48


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
    An entry that is damaged is computed again, with a warning.
    """
    place = usable_folder("walls") if folder is None else folder
    if place is None:
        return compute()
    store, key = KeptArrays(place, LIMIT), f"{name}-{digest_of(parts)[:32]}"
    try:
        found = store.get(key)
        if found is not None:
            return found["values"]
    except DamagedEntryError as damage:
        warnings.warn(f"{damage}; computed anew", stacklevel=2)
    values = np.ascontiguousarray(compute(), dtype=float)
    with suppress(OSError):  # a cache that cannot be written costs time only
        store.put(key, {"values": values})
    return values
