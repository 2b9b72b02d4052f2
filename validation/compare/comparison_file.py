"""comparison.nc, written variant by variant as each is finished, so that none waits in memory."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import xarray as xr

from validation.errors import ValidationError


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
        file.setncatts(dict(attributes))
        file.createDimension("variant", len(self._variants))
        names = file.createVariable("variant", str, ("variant",))
        names[:] = np.array(self._variants, dtype=object)

    def write(self, variant: str, dataset: xr.Dataset) -> None:
        """Write one variant; all have the same axes.

        Raises
        ------
        ValidationError
            If the file cannot be written.
        """
        try:
            self._define(dataset)
            for name, values in dataset.data_vars.items():
                self._file[str(name)][self._variants.index(variant)] = values.to_numpy()
        except (OSError, RuntimeError) as error:  # netCDF reports a full disk as RuntimeError
            raise ValidationError(f"comparison.nc cannot be written: {error}") from error

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
    """One variant, and of fields on cells one state: what is read at once."""
    by_state = "time" in values.dims and "phi" in values.dims
    return (1, *(1 if dim == "time" and by_state else size for dim, size in values.sizes.items()))


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
        raise ValidationError(f"comparison.nc cannot be written: {error.strerror or error}") from error
    with file:
        yield ComparisonFile(file, variants, attributes)
