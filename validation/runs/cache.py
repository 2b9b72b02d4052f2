"""Results of long computations in the user's cache: labelled arrays, and what is to be said of them."""

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from solver.kept import DamagedEntryError, KeptArrays
from solver.kernel_cache import cache_folders
from validation.errors import ValidationError
from validation.runs.packed import ENCODING, Packed, kept_with, packed_of

FOLDER_VARIABLE = "ARTERIAL_ROM_CACHE"  # environment: the folder to use instead
LIMIT = 2 * 1024**3  # bytes
HEADER = "header"


@dataclass(frozen=True)
class Entry:
    """What is kept of one computation.

    Attributes
    ----------
    datasets : dict of str to xarray.Dataset
        Numeric arrays with coordinates and attributes that JSON can hold; those that are packed come back so.
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

    @property
    def _store(self) -> KeptArrays:
        return KeptArrays(self.folder, self.limit)

    def get(self, key: str) -> Entry | None:
        """Return the entry under a key, or None if there is none.

        Raises
        ------
        ValidationError
            If there is one, but damaged; it is removed.
        """
        try:
            arrays = None if self.fresh else self._store.get(key)
            return None if arrays is None else _entry(arrays)
        except DamagedEntryError as damage:
            raise ValidationError(str(damage)) from damage
        except (KeyError, ValueError) as error:  # an array is missing: the file's directory is damaged
            path = self.folder / f"{key}.npz"
            path.unlink(missing_ok=True)
            raise ValidationError(f"{path} was damaged ({error})") from error

    def put(self, key: str, entry: Entry) -> None:
        """Keep an entry, and make room for it.

        Raises
        ------
        ValidationError
            If it cannot be written.
        """
        try:
            self._store.put(key, _arrays(entry))
        except OSError as error:
            raise ValidationError(f"{self.folder}: cannot be written: {error.strerror or error}") from error


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


def _arrays(entry: Entry) -> dict[str, NDArray[Any]]:
    """Arrays of an entry by name, with a header that tells what they are."""
    arrays: dict[str, NDArray[Any]] = {}
    layout: dict[str, Any] = {}
    packed: dict[str, Any] = {}
    for name, dataset in entry.datasets.items():
        layout[name] = {
            "coords": {str(n): _described(v) for n, v in dataset.coords.items()},
            "data_vars": {str(n): _described(v) for n, v in dataset.data_vars.items()},
        }
        for n, v in dataset.variables.items():
            key = f"{name}/{n}"
            if not isinstance(v.data, Packed):
                arrays[key] = v.to_numpy()
            if isinstance(v.data, Packed) or ENCODING in v.encoding:
                own = packed_of(dataset[n])
                sizes = [len(block) for block in own.blocks]
                packed[key] = {"shape": own.shape, "dtype": own.dtype.str, "sizes": sizes}
                arrays[f"{key}/{ENCODING}"] = np.frombuffer(b"".join(own.blocks), np.uint8)
    header = json.dumps({"layout": layout, ENCODING: packed, "facts": entry.facts})
    return {HEADER: np.array(header)} | arrays


def _entry(arrays: Mapping[str, NDArray[Any]]) -> Entry:
    header = json.loads(str(arrays[HEADER]))
    packed = {key: _packed(about, arrays[f"{key}/{ENCODING}"]) for key, about in header[ENCODING].items()}
    datasets = {name: _dataset(name, parts, arrays, packed) for name, parts in header["layout"].items()}
    return Entry(datasets, header["facts"])


def _packed(about: Mapping[str, Any], octets: NDArray[Any]) -> Packed:
    ends = np.cumsum([0, *about["sizes"]])
    blocks = tuple(octets[first:last].tobytes() for first, last in pairwise(ends))
    return Packed(tuple(about["shape"]), np.dtype(about["dtype"]), blocks)


def _dataset(
    name: str,
    parts: Mapping[str, Any],
    stored: Mapping[str, NDArray[Any]],
    packed: Mapping[str, Packed],
) -> xr.Dataset:
    def variable(n: str, about: Mapping[str, Any]) -> xr.Variable:
        key = f"{name}/{n}"
        known = packed.get(key)
        found = stored[key] if known is None else stored.get(key, known)
        values = xr.Variable(about["dims"], found, about["attrs"])
        return values if known is None else kept_with(values, known)

    kinds = {kind: {n: variable(n, about) for n, about in parts[kind].items()} for kind in parts}
    return xr.Dataset(kinds["data_vars"], coords=kinds["coords"])
