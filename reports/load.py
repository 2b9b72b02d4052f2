"""A finished comparison directory, read and checked before anything is drawn."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from reports.errors import ReportError
from reports.metrics import Metrics, read_metrics

CURVES = ("pressure", "radius", "sector_flow_rate", "section_flow_rate")
MODELS = ("reference", "rom")
_PROFILES = ("reference_axial_velocity", "rom_axial_velocity")
_DIMENSIONS = ("variant", "time", "x", "phi", "y")
_ATTRIBUTES = (
    "case",
    "title",
    "baseline",
    "period_s",
    "compare_i",
    "compare_j",
    "compare_time_names",
    "compare_times_s",
    "case_yaml",
)
_PROVENANCE: dict[str, tuple[type, ...]] = {
    "created": (str,),
    "command": (str,),
    "git_commit": (str, type(None)),
    "package_version": (str,),
    "python": (str,),
    "versions": (dict,),
    "machine": (dict,),
    "case": (dict,),
    "inputs": (list,),
    "wall_times_s": (dict,),
    "notes": (list,),
    "variants": (dict,),
    "bands": (list,),
}


@dataclass(frozen=True)
class Comparison:
    """What a report needs of one comparison.

    Attributes
    ----------
    case, title, baseline, case_yaml : str
        Name, heading, variant without calcification ("" for none), the case file's text.
    variants : tuple of str
        In the order of the case file.
    i, j : tuple of int
        Cells to show, counted from 1.
    x, phi : tuple of float
        Their centres (m, rad).
    n_phi : int
        Cells around the artery.
    times : tuple of (str, float)
        Named instants and their times into the cycle (s).
    curves : xarray.Dataset
        Both models' pressure, radius, sector and section flow rate over the cycle at columns `i`, all φ.
    profiles : xarray.Dataset
        Both models' axial velocity (m/s) at the named instants and cells, over y = r/R.
    wall_varies_around : dict of str to bool
        Whether a variant's wall stiffness depends on φ.
    metrics : Metrics
        Every figure of the comparison.
    provenance : dict
        What provenance.json holds.
    """

    case: str
    title: str
    baseline: str
    case_yaml: str
    variants: tuple[str, ...]
    i: tuple[int, ...]
    j: tuple[int, ...]
    x: tuple[float, ...]
    phi: tuple[float, ...]
    n_phi: int
    times: tuple[tuple[str, float], ...]
    curves: xr.Dataset
    profiles: xr.Dataset
    wall_varies_around: dict[str, bool]
    metrics: Metrics
    provenance: dict[str, Any]

    def rows_of(self, variant: str) -> tuple[int, ...]:
        """Rows j worth showing: one where the wall is the same all around, else all."""
        return self.j if self.wall_varies_around[variant] else self.j[:1]


def load(directory: Path) -> Comparison:
    """Read comparison.nc, metrics.json and provenance.json of `directory`.

    Raises
    ------
    ReportError
        If a file, variable, attribute or key is absent or does not fit; the message says which.
    """
    if not directory.is_dir():
        raise ReportError(f"{directory}: not a directory")
    paths = {name: directory / name for name in ("comparison.nc", "metrics.json", "provenance.json")}
    for path in paths.values():
        if not path.is_file():
            raise ReportError(f"{path}: no such file; a finished comparison has one")
    provenance = _read_provenance(paths["provenance.json"])
    metrics = read_metrics(paths["metrics.json"])
    path = paths["comparison.nc"]
    try:
        dataset = xr.open_dataset(path, engine="netcdf4", decode_times=False)
    except (OSError, ValueError) as error:
        raise ReportError(f"{path}: cannot be read as NetCDF-4: {error}") from error
    with dataset:
        return _comparison(path, dataset, metrics, provenance)


def _read_provenance(path: Path) -> dict[str, Any]:
    try:
        provenance = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise ReportError(f"{path}: cannot be read as JSON: {error}") from error
    if not isinstance(provenance, dict):
        raise ReportError(f"{path}: an object is expected, found {type(provenance).__name__}")
    missing = [key for key in _PROVENANCE if key not in provenance]
    if missing:
        raise ReportError(f"{path}: without {', '.join(missing)}")
    for key, allowed in _PROVENANCE.items():
        if not isinstance(provenance[key], allowed):
            names = " or ".join(kind.__name__ for kind in allowed)
            raise ReportError(f"{path}: {key} is {provenance[key]!r}; {names} is expected")
    return provenance


def _comparison(path: Path, dataset: xr.Dataset, metrics: Metrics, provenance: dict[str, Any]) -> Comparison:
    _check_names(path, dataset)
    attributes = dataset.attrs
    i = _cells(path, "compare_i", attributes["compare_i"], dataset.sizes["x"])
    j = _cells(path, "compare_j", attributes["compare_j"], dataset.sizes["phi"])
    times = _instants(path, dataset)
    columns, rows = [k - 1 for k in i], [k - 1 for k in j]
    states = [int(np.abs(dataset["time"].values - t).argmin()) for _, t in times]
    stiffness = dataset["wall_stiffness"].values
    variants = tuple(str(name) for name in dataset["variant"].values)
    return Comparison(
        case=str(attributes["case"]),
        title=str(attributes["title"]),
        baseline=_baseline(path, str(attributes["baseline"]), variants),
        case_yaml=str(attributes["case_yaml"]),
        variants=variants,
        i=i,
        j=j,
        x=tuple(dataset["x"].values[columns].tolist()),
        phi=tuple(dataset["phi"].values[rows].tolist()),
        n_phi=dataset.sizes["phi"],
        times=times,
        curves=dataset[[f"{model}_{name}" for model in MODELS for name in CURVES]].isel(x=columns).load(),
        profiles=dataset[list(_PROFILES)].isel(time=states, x=columns, phi=rows).load(),
        wall_varies_around={
            name: bool(np.ptp(stiffness[k], axis=-1).max() > 1e-9 * np.abs(stiffness[k]).max())
            for k, name in enumerate(variants)
        },
        metrics=metrics,
        provenance=provenance,
    )


def _check_names(path: Path, dataset: xr.Dataset) -> None:
    needed = {f"{model}_{name}" for model in MODELS for name in CURVES} | {*_PROFILES, "wall_stiffness"}
    for what, missing in (
        ("dimension", [name for name in _DIMENSIONS if name not in dataset.sizes]),
        ("coordinate", [name for name in _DIMENSIONS if name not in dataset.coords]),
        ("variable", sorted(needed - set(dataset.data_vars))),
        ("attribute", [name for name in _ATTRIBUTES if name not in dataset.attrs]),
    ):
        if missing:
            raise ReportError(f"{path}: without {what} {', '.join(missing)}")
    for name in sorted(needed):
        if name == "wall_stiffness":
            dims: tuple[str, ...] = ("variant", "x", "phi")
        elif name.endswith("section_flow_rate"):
            dims = ("variant", "time", "x")
        else:
            dims = ("variant", "time", "x", "phi") + (("y",) if name in _PROFILES else ())
        if dataset[name].dims != dims:
            raise ReportError(f"{path}: {name} has dimensions {dataset[name].dims}; {dims} are expected")


def _baseline(path: Path, name: str, variants: tuple[str, ...]) -> str:
    if name and name not in variants:
        raise ReportError(f"{path}: baseline {name!r} is none of the variants {', '.join(variants)}")
    return name


def _cells(path: Path, name: str, value: object, size: int) -> tuple[int, ...]:
    cells = tuple(int(k) for k in np.atleast_1d(np.asarray(value)))
    outside = [k for k in cells if not 1 <= k <= size]
    if outside or not cells:
        raise ReportError(f"{path}: {name} is {list(cells)}; one or more of 1 … {size} are allowed")
    return cells


def _instants(path: Path, dataset: xr.Dataset) -> tuple[tuple[str, float], ...]:
    """Names and times to show; each time must be one of the states'."""
    text = dataset.attrs["compare_time_names"]
    try:
        names = json.loads(text)
    except (TypeError, ValueError) as error:
        raise ReportError(f"{path}: compare_time_names is {text!r}; a JSON list is expected") from error
    times = np.atleast_1d(np.asarray(dataset.attrs["compare_times_s"], dtype=float))
    if not isinstance(names, list) or len(names) != times.size:
        raise ReportError(f"{path}: {times.size} compare_times_s, but compare_time_names is {text}")
    tolerance = 1e-6 * float(dataset.attrs["period_s"])
    for name, t in zip(names, times, strict=True):
        if np.abs(dataset["time"].values - t).min() > tolerance:
            raise ReportError(f"{path}: no state at {t:g} s ({name}), which compare_times_s names")
    return tuple((str(name), float(t)) for name, t in zip(names, times, strict=True))
