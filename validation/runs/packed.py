"""Arrays in blocks that are packed as HDF5 packs chunks: what is packed once is kept, and written, as it is.

A block is what the filters shuffle and deflate make of a chunk (HDF5 file format, IV.A.2.l): bytes of one
significance side by side, then a zlib stream.
"""

import zlib
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

BLOCK = 2**20  # bytes of a block before it is packed, about
LEVEL = 1  # of zlib: more takes three times as long for a tenth
CELLS = ("time", "x", "phi")  # first dimensions of what is packed
X = 1  # axis along which blocks follow each other: profiles at a place need few of them
ENCODING = "packed"  # of a variable in memory: its own values, packed


@dataclass(frozen=True, eq=False)
class Packed(np.lib.mixins.NDArrayOperatorsMixin):
    """An array (time, x, phi, …) in blocks along x, unpacked where it is indexed; NumPy takes it as an array.

    Attributes
    ----------
    shape : tuple of int
    dtype : numpy.dtype
    blocks : tuple of bytes
        The last is filled up to the size of the others.
    """

    shape: tuple[int, ...]
    dtype: np.dtype[Any]
    blocks: tuple[bytes, ...]

    @property
    def ndim(self) -> int:
        """Number of dimensions."""
        return len(self.shape)

    @property
    def size(self) -> int:
        """Number of entries."""
        return int(np.prod(self.shape))

    @cached_property
    def chunk(self) -> tuple[int, ...]:
        """Shape of a block."""
        return _chunk(self.shape, self.dtype)

    def __getitem__(self, key: Any) -> Any:
        keys = key if isinstance(key, tuple) else (key,)
        columns: Any = slice(None)
        if len(keys) > X and not any(each is Ellipsis or each is None for each in keys):
            columns = keys[X]
        return self._unpacked(np.unique(np.arange(self.shape[X])[columns] // self.chunk[X]))[key]

    def _unpacked(self, numbers: Any) -> NDArray[Any]:
        """All entries; those of other blocks than these are not set."""
        found = np.empty(self.shape, self.dtype)
        width, count = self.chunk[X], int(np.prod(self.chunk))
        for number in numbers:
            octets = np.frombuffer(zlib.decompress(self.blocks[number]), np.uint8)
            entries = np.ascontiguousarray(octets.reshape(self.dtype.itemsize, count).T).view(self.dtype)
            part = found[:, number * width : (number + 1) * width]
            part[:] = entries.reshape(self.chunk)[:, : part.shape[X]]
        return found

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        return self._unpacked(range(len(self.blocks))).astype(dtype or self.dtype, copy=False)

    def astype(self, dtype: Any, **options: Any) -> NDArray[Any]:
        """Array of another type."""
        return np.asarray(self).astype(dtype, **options)

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        return getattr(ufunc, method)(*_plain(inputs), **options)

    def __array_function__(self, function: Any, _types: Any, inputs: Any, options: Any) -> Any:
        return function(*_plain(inputs), **options)


def _plain(value: Any) -> Any:
    if isinstance(value, Packed):
        return np.asarray(value)
    return type(value)(map(_plain, value)) if isinstance(value, list | tuple) else value


def chunk_of(values: xr.DataArray) -> tuple[int, ...]:
    """Shape of the blocks that values of cells are packed in."""
    return _chunk(values.shape, values.dtype)


def _chunk(shape: tuple[int, ...], dtype: np.dtype[Any]) -> tuple[int, ...]:
    columns = max(1, BLOCK * shape[X] // (int(np.prod(shape)) * dtype.itemsize))
    parts = -(-shape[X] // columns)
    return (shape[0], -(-shape[X] // parts), *shape[2:])


def pack(values: NDArray[Any]) -> Packed:
    """Packed array (time, x, phi, …)."""
    chunk = _chunk(values.shape, values.dtype)
    blocks = []
    for first in range(0, values.shape[X], chunk[X]):
        part = np.zeros(chunk, values.dtype)
        stated = values[:, first : first + chunk[X]]
        part[:, : stated.shape[X]] = stated
        octets = part.reshape(-1).view(np.uint8).reshape(-1, values.dtype.itemsize)
        blocks.append(zlib.compress(octets.T.tobytes(), LEVEL))
    return Packed(values.shape, values.dtype, tuple(blocks))


def packable(values: xr.DataArray) -> bool:
    """Whether these are values of every cell and state."""
    return values.dims[: len(CELLS)] == CELLS and values.size > 0


def packed_of(values: xr.DataArray) -> Packed:
    """Values of cells, packed: as they are kept, unless they have been changed since."""
    if isinstance(values.data, Packed):
        return values.data
    known, whose = values.encoding.get(ENCODING, (None, None))
    return known if isinstance(known, Packed) and whose is values.data else pack(values.to_numpy())


def with_packed(fields: xr.Dataset) -> xr.Dataset:
    """Fields whose values of cells are packed: on rays, which are most, in their place, else beside it."""
    return fields.assign(
        {
            name: kept_with(values.variable, packed_of(values))
            for name, values in fields.data_vars.items()
            if packable(values)
        }
    )


def kept_with(values: xr.Variable, packed: Packed) -> xr.Variable:
    """Values of cells with what they are when packed; on rays that alone."""
    if values.ndim > len(CELLS):
        return xr.Variable(values.dims, packed, values.attrs)
    return xr.Variable(values.dims, values.data, values.attrs, {ENCODING: (packed, values.data)})
