"""comparison.nc, opened and checked before anything is drawn."""

import json
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr

from cases.arrays import Floats
from cases.results.comparison_file import PROFILE_ERROR, PROFILE_ERROR_CURVE, REFERENCE, variable, variables
from reports.errors import ReportError

_MAY_BE_ABSENT = (PROFILE_ERROR, PROFILE_ERROR_CURVE)  # where nothing flows there is no profile
_UNREADABLE = (OSError, RuntimeError, TypeError, ValueError)  # what xarray and netCDF4 raise for broken data
ANEW = "of an earlier version, or damaged: compare its case once more"
_AXES = ("time", "x", "phi", "y")
_TEXTS = ("case", "title", "models", "baseline", "compare_time_names", "case_yaml", "variant_titles")
_NUMBERS = ("period_s", "compare_i", "compare_j", "compare_times_s")


@contextmanager
def opened(path: Path) -> Iterator[xr.Dataset]:
    """Open comparison.nc and check all that the report reads of it.

    Raises
    ------
    ReportError
        If it is no NetCDF-4 file, lacks something, or holds other dimensions, types or values than a
        finished comparison does; also if its data cannot be read later, inside the block.
    """
    try:
        dataset = xr.open_dataset(path, engine="netcdf4", decode_times=False)
    except (AttributeError, *_UNREADABLE) as error:  # the first for an attribute that is broken on disk
        raise _unreadable(path, error) from error
    try:
        with dataset:
            _check_names(path, dataset)
            _check_axes(path, dataset)
            _check_values(path, dataset)
            yield dataset
    except _UNREADABLE as error:
        raise _unreadable(path, error) from error


def _unreadable(path: Path, error: Exception) -> ReportError:
    reason = str(error).partition("\n")[0]
    return ReportError(f"{path}: cannot be read as NetCDF-4: {reason}")


def _check_names(path: Path, dataset: xr.Dataset) -> None:
    dimensions = ("variant", *_AXES, "exponent")
    for what, missing in (
        ("dimension", [name for name in dimensions if name not in dataset.sizes]),
        ("coordinate", [name for name in dimensions if name not in dataset.coords]),
        ("attribute", [name for name in (*_TEXTS, *_NUMBERS) if name not in dataset.attrs]),
    ):
        if missing:
            raise ReportError(f"{path}: without {what} {', '.join(missing)}; {ANEW}")
    expected = variables(reduced_models(path, dataset))
    missing = [name for name in expected if name not in dataset.data_vars]
    if missing:
        raise ReportError(f"{path}: without variable {', '.join(missing)}; {ANEW}")
    for name, dims in expected.items():
        if dataset[name].dims != dims:
            raise ReportError(f"{path}: {name} has dimensions {dataset[name].dims}; {dims} are expected")


def _check_axes(path: Path, dataset: xr.Dataset) -> None:
    empty = [name for name in ("variant", *_AXES) if dataset.sizes[name] == 0]
    if empty:
        raise ReportError(f"{path}: nothing along {', '.join(empty)}")
    names = [str(name) for name in dataset["variant"].values]
    if len(set(names)) < len(names):
        raise ReportError(f"{path}: variants {', '.join(names)}: each may occur once")
    for axis in (*_AXES, "exponent"):
        values = dataset[axis]
        _check_finite(path, values)
        if np.any(np.diff(values.values) <= 0):
            raise ReportError(f"{path}: {axis} does not increase")


def _check_values(path: Path, dataset: xr.Dataset) -> None:
    for name in variables(reduced_models(path, dataset)):
        if name in _MAY_BE_ABSENT:
            continue
        if name.startswith("reference_") and dataset.attrs.get("sparse_reference"):
            continue  # NaN is what the reference does not state
        if "y" in dataset[name].dims:
            continue  # checked when they are read, once: they are most of the file
        _check_finite(path, dataset[name], infinite=name.endswith("profile_exponent"))  # of plug flow


def read_profiles(
    path: Path, dataset: xr.Dataset, columns: Sequence[int], rows: Sequence[int], state: int
) -> tuple[xr.Dataset, xr.Dataset]:
    """Read all models' axial velocity at some cells of an opened comparison.nc.

    A chunk of the file holds all states of some sections, so that little is unpacked that is not wanted.

    Parameters
    ----------
    path : Path
        Named in messages.
    dataset : xarray.Dataset
        The opened file.
    columns, rows : sequence of int
        Cells along x and φ, counted from 0.
    state : int
        Number of the state of the sections.

    Returns
    -------
    (xarray.Dataset, xarray.Dataset)
        ``<model>_axial_velocity`` and that of the reference in m/s: at those cells over the cycle, each
        (variant, time, x, phi, y), and in those sections at one state, (variant, x, phi, y).

    Raises
    ------
    ReportError
        If a value read is no finite number, though the reference is no sparse one.
    """
    rays, sections = {}, {}
    for name in (variable(of, "axial_velocity") for of in (REFERENCE, *reduced_models(path, dataset))):
        of_cells, of_sections = [], []
        for whole in dataset[name]:
            part = whole.isel(x=columns).load()
            if not (name.startswith("reference_") and dataset.attrs.get("sparse_reference")):
                _check_finite(path, part)
            of_cells.append(part.isel(phi=rows))
            of_sections.append(part.isel(time=state))
        rays[name], sections[name] = xr.concat(of_cells, "variant"), xr.concat(of_sections, "variant")
    return xr.Dataset(rays), xr.Dataset(sections)


def _check_finite(path: Path, values: xr.DataArray, infinite: bool = False) -> None:
    if values.dtype.kind not in "fiu":
        raise ReportError(f"{path}: {values.name} is of type {values.dtype}; numbers are expected")
    wrong = np.isnan(values.values) if infinite else ~np.isfinite(values.values)
    if wrong.any():
        raise ReportError(f"{path}: {values.name} has {int(wrong.sum())} values that are not finite numbers")


def reduced_models(path: Path, dataset: xr.Dataset) -> tuple[str, ...]:
    """Names of the reduced models of an opened comparison.nc, in the order of the case file.

    Raises
    ------
    ReportError
        If the attribute is no JSON list of different names.
    """
    names = _words(path, "models", _text(path, "models", dataset.attrs["models"]))
    if not names or len({*names}) < len(names):
        raise ReportError(f"{path}: models is {', '.join(names) or 'empty'}; different names are expected")
    return tuple(names)


@dataclass(frozen=True)
class Attributes:
    """Attributes of comparison.nc, of the types and within the ranges that they must have.

    Attributes
    ----------
    case, title, baseline, case_yaml : str
        As stored.
    titles : dict of str to str
        Of each variant, in words.
    period : float
        Of the cycle (s).
    i, j : tuple of int
        Cells to show, counted from 1.
    times : tuple of (str, float)
        Named instants and their times into the cycle (s).
    baselines : dict of str to str
        Of each variant that has one, the variant that its changes are counted from.
    """

    case: str
    title: str
    baseline: str
    baselines: dict[str, str]
    titles: dict[str, str]
    case_yaml: str
    period: float
    i: tuple[int, ...]
    j: tuple[int, ...]
    times: tuple[tuple[str, float], ...]


def read_attributes(path: Path, dataset: xr.Dataset) -> Attributes:
    """Read the attributes of an opened comparison.nc.

    Raises
    ------
    ReportError
        If one is of another type or range, or the baseline is none of the variants.
    """
    texts = {name: _text(path, name, dataset.attrs[name]) for name in _TEXTS}
    variants = [str(name) for name in dataset["variant"].values]
    if texts["baseline"] and texts["baseline"] not in variants:
        raise ReportError(
            f"{path}: baseline {texts['baseline']!r} is none of the variants {', '.join(variants)}"
        )
    return Attributes(
        case=texts["case"],
        title=texts["title"],
        baseline=texts["baseline"],
        baselines=_baselines(path, dataset, texts["baseline"], variants),
        titles=_titles(path, texts["variant_titles"], variants),
        case_yaml=texts["case_yaml"],
        period=_period(path, dataset),
        i=_cells(path, "compare_i", dataset.attrs["compare_i"], dataset.sizes["x"]),
        j=_cells(path, "compare_j", dataset.attrs["compare_j"], dataset.sizes["phi"]),
        times=_instants(path, dataset, texts["compare_time_names"]),
    )


def _titles(path: Path, text: str, variants: Sequence[str]) -> dict[str, str]:
    titles = _words(path, "variant_titles", text)
    if len(titles) != len(variants):
        raise ReportError(f"{path}: {len(variants)} variants, but variant_titles is {text[:60]}")
    return dict(zip(variants, titles, strict=True))


def _baselines(path: Path, dataset: xr.Dataset, baseline: str, variants: Sequence[str]) -> dict[str, str]:
    """Return each changed variant's baseline; a file that has one for all need not list them."""
    listed = dataset.attrs.get("baselines")
    found = dict.fromkeys(variants, baseline) if listed is None and baseline else {}
    if listed is not None:
        try:
            found = json.loads(_text(path, "baselines", listed))
        except (RecursionError, ValueError) as error:
            raise ReportError(f"{path}: baselines is {listed[:60]!r}; a JSON object is expected") from error
        if not isinstance(found, dict) or not {*found, *found.values()} <= {*variants}:
            raise ReportError(
                f"{path}: baselines is {listed[:60]}; a variant for a variant is expected, "
                f"of {', '.join(variants)}"
            )
    return {name: of for name, of in found.items() if of != name}


def _text(path: Path, name: str, value: object) -> str:
    if not isinstance(value, str):
        raise ReportError(f"{path}: {name} is {value!r}; text is expected")
    return value


def _numbers(path: Path, name: str, value: object, kinds: str) -> Floats:
    numbers = np.atleast_1d(np.asarray(value))
    if numbers.ndim != 1 or numbers.dtype.kind not in kinds or not np.all(np.isfinite(numbers)):
        expected = "finite numbers are" if "f" in kinds else "whole numbers are"
        raise ReportError(f"{path}: {name} is {value!r}; {expected} expected")
    return numbers.astype(np.float64)


def _cells(path: Path, name: str, value: object, size: int) -> tuple[int, ...]:
    cells = tuple(int(k) for k in _numbers(path, name, value, "iu"))
    outside = [k for k in cells if not 1 <= k <= size]
    if outside or not cells:
        raise ReportError(f"{path}: {name} is {list(cells)}; one or more of 1 … {size} are allowed")
    return cells


def _instants(path: Path, dataset: xr.Dataset, text: str) -> tuple[tuple[str, float], ...]:
    """Names and times to show; each time must be one of the states'."""
    times = _numbers(path, "compare_times_s", dataset.attrs["compare_times_s"], "fiu")
    period = _period(path, dataset)
    for name, t in zip(_time_names(path, text, times.size), times, strict=True):
        if np.abs(dataset["time"].values - t).min() > 1e-6 * period:
            raise ReportError(f"{path}: no state at {t:g} s ({name}), which compare_times_s names")
    return tuple(zip(_time_names(path, text, times.size), times.tolist(), strict=True))


def _period(path: Path, dataset: xr.Dataset) -> float:
    period = _numbers(path, "period_s", dataset.attrs["period_s"], "fiu")
    if period.size != 1 or period[0] <= 0:
        raise ReportError(
            f"{path}: period_s is {dataset.attrs['period_s']!r}; one positive number is expected"
        )
    return float(period[0])


def _time_names(path: Path, text: str, count: int) -> list[str]:
    names = _words(path, "compare_time_names", text)
    if len(names) != count:
        raise ReportError(f"{path}: {count} compare_times_s, but compare_time_names is {text[:60]}")
    return names


def _words(path: Path, name: str, text: str) -> list[str]:
    """Read an attribute that is a JSON list of texts."""
    try:
        words = json.loads(text)
    except (RecursionError, ValueError) as error:
        raise ReportError(f"{path}: {name} is {text[:60]!r}; a JSON list is expected") from error
    if not isinstance(words, list) or not all(isinstance(word, str) for word in words):
        raise ReportError(f"{path}: {name} is {text[:60]!r}; a JSON list of texts is expected")
    return words
