"""Arrays that take long to compute, kept in the user's cache under what determines them."""

import hashlib
import warnings
from collections.abc import Callable, Iterable
from contextlib import suppress
from pathlib import Path

import numpy as np

from cases.arrays import Floats
from solver.kept import DamagedEntryError, KeptArrays
from solver.kernel_cache import usable_folder

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
