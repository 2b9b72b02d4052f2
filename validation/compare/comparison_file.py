"""comparison.nc, written variant by variant as each is finished, so that none waits in memory."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import h5py
import netCDF4
import numpy as np
import xarray as xr

from validation.errors import ValidationError
from validation.runs.packed import Packed, X, chunk_of, packable, packed_of


class ComparisonFile:
    """An open comparison.nc.

    Parameters
    ----------
    file : netCDF4.Dataset
        Open for writing, empty.
    variants : sequence of str
        All that will be written, in order.
    attributes : mapping
        Global attributes.
    """

    def __init__(self, file: netCDF4.Dataset, variants: Sequence[str], attributes: Mapping[str, Any]) -> None:
        self._file = file
        self._variants = list(variants)
        self._blocks: list[tuple[str, tuple[int, ...], bytes]] = []
        file.setncatts(dict(attributes))
        file.createDimension("variant", len(self._variants))
        names = file.createVariable("variant", str, ("variant",))
        names[:] = np.array(self._variants, dtype=object)

    def write(self, variant: str, dataset: xr.Dataset) -> None:
        """Write one variant; all have the same axes. Values of cells wait, packed, for :meth:`finish`.

        Raises
        ------
        ValidationError
            If the file cannot be written.
        """
        try:
            self._define(dataset)
            index = self._variants.index(variant)
            for name, values in dataset.data_vars.items():
                if packable(values):
                    self._blocks += _blocks(str(name), index, packed_of(values))
                else:
                    self._file[str(name)][index] = values.to_numpy()
        except (OSError, RuntimeError) as error:
            raise _unwritable(error) from error

    def finish(self) -> None:
        """Close the file and put into it what is packed, chunk by chunk: nothing is packed twice."""
        path = self._file.filepath()
        self._file.close()
        with h5py.File(path, "r+") as file:
            for name, offsets, block in self._blocks:
                file[name].id.write_direct_chunk(offsets, block)

    def _define(self, dataset: xr.Dataset) -> None:
        """Add axes and variables that no earlier variant had: another model may give more fields."""
        there = set(self._file.variables)
        for name, axis in dataset.coords.items():
            if name in there:
                continue
            words = axis.dtype.kind in "OU"
            self._file.createDimension(str(name), axis.size)
            stored = self._file.createVariable(str(name), str if words else axis.dtype, (str(name),))
            stored.setncatts(axis.attrs)
            stored[:] = axis.to_numpy().astype(object) if words else axis.to_numpy()
        for name, values in dataset.data_vars.items():
            if name in there:
                continue
            stored = self._file.createVariable(
                str(name),
                values.dtype,
                ("variant", *map(str, values.dims)),
                compression="zlib",
                complevel=1,
                shuffle=True,
                fill_value=np.nan if values.dtype.kind == "f" else None,
                chunksizes=_chunks(values),
                chunk_cache=1000,  # bytes, less than a chunk: compress at once, while variants are computed
            )
            stored.setncatts(values.attrs)


def _chunks(values: xr.DataArray) -> tuple[int, ...]:
    """One variant, and of values of cells a block."""
    return (1, *(chunk_of(values) if packable(values) else values.shape))


def _blocks(name: str, variant: int, packed: Packed) -> Iterator[tuple[str, tuple[int, ...], bytes]]:
    """Blocks of a variable with the numbers of their first entries."""
    for number, block in enumerate(packed.blocks):
        first = [0] * packed.ndim
        first[X] = number * packed.chunk[X]
        yield name, (variant, *first), block


def _close(file: netCDF4.Dataset) -> None:
    """Close a file unless it is closed already."""
    try:
        if file.isopen():
            file.close()
    except RuntimeError as error:  # what HDF5 still holds does not fit on the disk
        raise _unwritable(error) from error


@contextmanager
def comparison_file(
    path: Path, variants: Sequence[str], attributes: Mapping[str, Any]
) -> Iterator[ComparisonFile]:
    """Write comparison.nc: NetCDF-4, compressed without loss.

    Raises
    ------
    ValidationError
        If the file cannot be written.
    """
    try:
        file = netCDF4.Dataset(path, "w", format="NETCDF4")
    except OSError as error:
        raise _unwritable(error) from error
    with ExitStack() as stack:
        stack.callback(_close, file)
        stored = ComparisonFile(file, variants, attributes)
        yield stored
        try:
            stored.finish()
        except (OSError, RuntimeError) as error:
            raise _unwritable(error) from error


def _unwritable(error: OSError | RuntimeError) -> ValidationError:
    """Error that says why; netCDF and HDF5 report a full disk as RuntimeError too."""
    return ValidationError(f"comparison.nc cannot be written: {getattr(error, 'strerror', None) or error}")
