"""Results of long computations, kept on disk under a digest of what determines them.

An entry is one file, written whole or not at all, so that several processes may share the folder. Its
checksums (those of the zip format) tell a damaged one. Entries used longest ago go when the folder exceeds
its limit.
"""

import json
import os
import time
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from solver.kernel_cache import cache_folders
from validation.errors import ValidationError

FOLDER_VARIABLE = "ARTERIAL_ROM_CACHE"  # environment: the folder to use instead
LIMIT = 2 * 1024**3  # bytes
ABANDONED = 24 * 3600.0  # s after which an unfinished file belongs to a process that has died
HEADER = "header"

DAMAGED = (OSError, EOFError, ValueError, KeyError, TypeError, zipfile.BadZipFile, zlib.error)


@dataclass(frozen=True)
class Entry:
    """What is kept of one computation.

    Attributes
    ----------
    datasets : dict of str to xarray.Dataset
        Numeric arrays with coordinates and attributes that JSON can hold.
    facts : dict
        What JSON can hold.
    """

    datasets: dict[str, xr.Dataset]
    facts: dict[str, Any]


@dataclass(frozen=True)
class Cache:
    """A folder of entries.

    Attributes
    ----------
    folder : pathlib.Path
        Exists and can be written to.
    limit : int
        Bytes that entries may take together.
    fresh : bool
        Whether entries are only written.
    """

    folder: Path
    limit: int = LIMIT
    fresh: bool = False

    def _path(self, key: str) -> Path:
        return self.folder / f"{key}.npz"

    def get(self, key: str) -> Entry | None:
        """Return the entry under a key, or None if there is none.

        Raises
        ------
        ValidationError
            If there is one, but damaged; it is removed.
        """
        path = self._path(key)
        if self.fresh or not path.exists():
            return None
        try:
            entry = _read(path)
            os.utime(path)
        except FileNotFoundError:  # another process made room
            return None
        except DAMAGED as error:
            path.unlink(missing_ok=True)
            raise ValidationError(f"{path} was damaged ({error})") from error
        return entry

    def put(self, key: str, entry: Entry) -> None:
        """Keep an entry, and make room for it.

        Raises
        ------
        ValidationError
            If it cannot be written.
        """
        path = self._path(key)
        partial = path.with_name(f".{key}.{os.getpid()}.{time.monotonic_ns()}.part")
        try:
            _write(partial, entry)
            partial.replace(path)
            self._make_room()
        except OSError as error:
            raise ValidationError(f"{self.folder}: cannot be written: {error.strerror or error}") from error
        finally:
            partial.unlink(missing_ok=True)

    def _make_room(self) -> None:
        """Remove what processes left unfinished, then the entries used longest ago."""
        for path in self.folder.glob(".*.part"):
            if _last_use(path) < time.time() - ABANDONED:
                path.unlink(missing_ok=True)
        entries = sorted(self.folder.glob("*.npz"), key=_last_use, reverse=True)
        total = 0
        for path in entries:
            total += _size(path)
            if total > self.limit:
                path.unlink(missing_ok=True)


def _last_use(path: Path) -> float:
    """Time of last use; now for a file that another process just removed."""
    try:
        return path.stat().st_mtime
    except FileNotFoundError:
        return time.time()


def _size(path: Path) -> int:
    try:
        return path.stat().st_size
    except FileNotFoundError:
        return 0


def open_cache(fresh: bool = False) -> Cache | None:
    """Return the user's cache, or None where no folder can be written to.

    It is the folder that ARTERIAL_ROM_CACHE names (none if that is empty), else
    ``arterial-rom-validation/results`` in XDG_CACHE_HOME, in ~/.cache or in the folder for temporary files.
    """
    stated = os.environ.get(FOLDER_VARIABLE)
    if stated == "":
        return None
    candidates = [Path(stated)] if stated else [folder / "results" for folder in cache_folders()]
    for folder in candidates:
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError:
            continue
        if os.access(folder, os.R_OK | os.W_OK | os.X_OK):
            return Cache(folder, fresh=fresh)
    return None


def _described(variable: xr.DataArray) -> dict[str, Any]:
    return {"dims": list(map(str, variable.dims)), "attrs": variable.attrs}


def _write(path: Path, entry: Entry) -> None:
    arrays: dict[str, np.ndarray] = {}
    layout: dict[str, Any] = {}
    for name, dataset in entry.datasets.items():
        layout[name] = {
            "coords": {str(n): _described(v) for n, v in dataset.coords.items()},
            "data_vars": {str(n): _described(v) for n, v in dataset.data_vars.items()},
        }
        arrays |= {f"{name}/{n}": v.to_numpy() for n, v in dataset.variables.items()}
    header = json.dumps({"layout": layout, "facts": entry.facts})
    with path.open("wb") as stream:
        np.savez(stream, allow_pickle=False, **{HEADER: np.array(header)}, **arrays)


def _read(path: Path) -> Entry:
    with path.open("rb") as stream, np.load(stream, allow_pickle=False) as stored:
        header = json.loads(str(stored[HEADER]))
        datasets = {name: _dataset(name, parts, stored) for name, parts in header["layout"].items()}
    return Entry(datasets, header["facts"])


def _dataset(name: str, parts: Mapping[str, Any], stored: Mapping[str, np.ndarray]) -> xr.Dataset:
    variables = {
        kind: {
            n: (tuple(about["dims"]), stored[f"{name}/{n}"], about["attrs"])
            for n, about in parts[kind].items()
        }
        for kind in ("coords", "data_vars")
    }
    return xr.Dataset(variables["data_vars"], coords=variables["coords"])
