"""A finished comparison directory, read and checked before anything is drawn."""

import codecs
import hashlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import xarray as xr
from pydantic import TypeAdapter

from cases.arrays import Floats
from cases.results import comparison_file
from cases.results.comparison_file import CALCIFIED, REFERENCE, ROM, WALL_STIFFNESS, variable
from cases.results.provenance import Provenance, ReducedModelSettings
from reports.errors import ReportError
from reports.result.dataset import Attributes, opened, read_attributes, read_profiles, reduced_models
from reports.result.metrics import Metrics, read_metrics
from reports.result.strict_json import read_json

DOMINANCE = ("axial_dominance_radial", "axial_dominance_azimuthal")  # not in every model
FIELDS = ("pressure", "radius", "sector_flow_rate", "section_flow_rate", "profile_exponent")


@dataclass(frozen=True)
class Comparison:
    """What a report needs of one comparison, with one of its reduced models in view.

    Attributes
    ----------
    model : str
        The reduced model in view: of it are `metrics`, and all fields that are named ``rom_…``.
    views : dict of str to Comparison
        By reduced model, the same comparison with that model in view.
    directory : Path
        Where it lies.
    case, title, baseline, case_yaml : str
        Name, heading, variant without calcification ("" for none), the case file's text.
    variants : tuple of str
        In the order of the case file.
    titles : dict of str to str
        Of each variant, in words.
    period : float
        Of the cycle (s).
    i, j : tuple of int
        Cells to show, counted from 1.
    x, phi : tuple of float
        Their centres (m, rad).
    n_phi : int
        Cells around the artery.
    times : tuple of (str, float)
        Named instants and their times into the cycle (s).
    baselines : dict of str to str
        Of each variant that has one, the variant that its changes are counted from.
    sparse : bool
        Whether the reference states some values only; NaN is what it does not.
    fields : xarray.Dataset
        Both models' pressure, radius, sector and section flow rate, profile exponent, and the error of the
        profile closest to 3D, over the cycle on all cells; which cells are calcified.
    profiles : xarray.Dataset
        Both models' axial velocity (m/s) at the shown cells over the cycle, over y = r/R.
    sections : xarray.Dataset
        The same all around the shown columns at the first named instant.
    maps : xarray.Dataset
        The fields at the named instants.
    error_curves : xarray.DataArray
        At the named instants and shown cells, relative error of the closest profile over its exponent.
    pressure_range_over_section : xarray.Dataset
        Of both models and each variant, the largest range over φ of the pressure in a section (Pa).
    wall_varies_around : dict of str to bool
        Whether a variant's wall stiffness depends on φ.
    metrics : Metrics
        Every figure of the comparison.
    provenance : Provenance
        What provenance.json holds.
    """

    directory: Path
    case: str
    title: str
    baseline: str
    case_yaml: str
    variants: tuple[str, ...]
    titles: dict[str, str]
    period: float
    i: tuple[int, ...]
    j: tuple[int, ...]
    x: tuple[float, ...]
    phi: tuple[float, ...]
    n_phi: int
    times: tuple[tuple[str, float], ...]
    baselines: dict[str, str]
    sparse: bool
    fields: xr.Dataset
    profiles: xr.Dataset
    sections: xr.Dataset
    maps: xr.Dataset
    error_curves: xr.DataArray
    pressure_range_over_section: xr.Dataset
    wall_varies_around: dict[str, bool]
    metrics: Metrics
    provenance: Provenance
    model: str = ROM
    views: dict[str, "Comparison"] = field(default_factory=dict, compare=False, repr=False)

    @property
    def models(self) -> tuple[str, ...]:
        """Names of the reduced models, in the order of the case file."""
        return tuple(self.views) or (self.model,)

    def of(self, model: str) -> "Comparison":
        """Return this comparison with another of its reduced models in view."""
        return self.views.get(model, self)

    def array(self, name: str, variant: str) -> Floats:
        """Values of a field of one variant over the cycle, as stored and SI."""
        return np.asarray(self.fields[name].values[self.variants.index(variant)], dtype=float)

    def settings(self, variant: str) -> ReducedModelSettings:
        """How the model in view ran for a variant."""
        return self.provenance.variants[variant].models[self.model]

    @property
    def states(self) -> tuple[int, ...]:
        """Numbers of the states at the named instants, counted from 0."""
        time = self.fields["time"].values
        return tuple(int(np.abs(time - t).argmin()) for _, t in self.times)

    def calcified(self, variant: str, i: int, j: int | None = None) -> bool:
        """Whether cell (i, j), or any cell of section i, is inside the calcification."""
        inside = self.fields["calcified"].sel(variant=variant).values[i - 1]
        return bool(inside.any() if j is None else inside[j - 1])

    @property
    def changed(self) -> tuple[str, ...]:
        """Variants that have another one as their baseline."""
        return tuple(name for name in self.variants if name in self.baselines)

    def rows_of(self, variant: str) -> tuple[int, ...]:
        """Rows j worth showing: one where the wall is the same all around, else all."""
        return self.j if self.wall_varies_around[variant] else self.j[:1]


def load(directory: Path) -> Comparison:
    """Read comparison.nc, metrics.json and provenance.json of `directory`.

    Raises
    ------
    ReportError
        If a file, variable, attribute, key or row is absent, does not fit or contradicts another; the
        message says which.
    """
    if not directory.is_dir():
        raise ReportError(f"{directory}: not a directory")
    paths = {name: directory / name for name in ("comparison.nc", "metrics.json", "provenance.json")}
    for path in paths.values():
        if not path.is_file():
            raise ReportError(f"{path}: no such file; a finished comparison has one")
    provenance = read_json(paths["provenance.json"], TypeAdapter(Provenance))
    metrics = read_metrics(paths["metrics.json"])
    with opened(paths["comparison.nc"]) as dataset:
        return _comparison(directory, dataset, metrics, provenance)


def _comparison(directory: Path, dataset: xr.Dataset, metrics: Metrics, provenance: Provenance) -> Comparison:
    path = directory / "comparison.nc"
    attributes = read_attributes(path, dataset)
    variants = tuple(str(name) for name in dataset["variant"].values)
    models = reduced_models(path, dataset)
    check_consistency(directory, (variants, models), attributes, metrics, provenance)
    columns, rows = [k - 1 for k in attributes.i], [k - 1 for k in attributes.j]
    states = [int(np.abs(dataset["time"].values - t).argmin()) for _, t in attributes.times]
    wanted = [variable(of, name) for of in (REFERENCE, *models) for name in (*FIELDS, *DOMINANCE)]
    names = [name for name in wanted if name in dataset]
    fields = dataset[[*names, comparison_file.PROFILE_ERROR, CALCIFIED]].load()
    profiles, sections = read_profiles(path, dataset, columns, rows, states[0] if states else 0)
    error_curves = dataset[comparison_file.PROFILE_ERROR_CURVE].load()
    views: dict[str, Comparison] = {}
    for model in models:
        seen = _in_view(fields, model)
        views[model] = Comparison(
            directory=directory,
            **vars(attributes),
            variants=variants,
            x=tuple(dataset["x"].values[columns].tolist()),
            phi=tuple(dataset["phi"].values[rows].tolist()),
            n_phi=dataset.sizes["phi"],
            sparse=bool(dataset.attrs.get("sparse_reference")),
            fields=seen,
            profiles=_in_view(profiles, model),
            sections=_in_view(sections, model),
            maps=seen.isel(time=states),
            error_curves=error_curves,
            pressure_range_over_section=_pressure_range(seen[["reference_pressure", "rom_pressure"]]),
            wall_varies_around=_varies_around(dataset[variable(model, WALL_STIFFNESS)].load()),
            metrics=metrics.of(model),
            provenance=provenance,
            model=model,
            views=views,
        )
    return views[models[0]]


def _in_view(fields: xr.Dataset, model: str) -> xr.Dataset:
    """Fields of one reduced model under the names that a single one has, beside those of no model."""
    own, single = variable(model, ""), variable(ROM, "")
    names = {str(n): single + str(n).removeprefix(own) for n in fields.data_vars if str(n).startswith(own)}
    others = [n for n in fields.data_vars if str(n).startswith(variable(REFERENCE, "")) or n == CALCIFIED]
    return fields[[*names, *others]].rename(names)


def _pressure_range(pressure: xr.Dataset) -> xr.Dataset:
    return (pressure.max("phi") - pressure.min("phi")).max(("time", "x"))


def _varies_around(stiffness: xr.DataArray) -> dict[str, bool]:
    return {
        str(wall["variant"].item()): bool(
            np.ptp(wall.values, axis=-1).max() > 1e-9 * np.abs(wall.values).max()
        )
        for wall in stiffness
    }


def check_consistency(
    directory: Path,
    names: tuple[Sequence[str], Sequence[str]],
    attributes: Attributes,
    metrics: Metrics,
    provenance: Provenance,
) -> None:
    """Compare what comparison.nc, metrics.json and provenance.json of `directory` each say.

    `names` are the variants and the reduced models of comparison.nc.

    Raises
    ------
    ReportError
        If the case's name, names of variants or models, or the case file's text differ; the message names
        the place.
    """
    variants, models = names
    _check_rows(directory / "metrics.json", names, attributes.case, metrics)
    path = directory / "provenance.json"
    if set(provenance.variants) != set(variants):
        raise ReportError(
            f"{path}: variants are {_names(provenance.variants)}; comparison.nc has {_names(variants)}"
        )
    for name, record in provenance.variants.items():
        if set(record.models) != set(models):
            raise ReportError(
                f"{path}: {name}: models are {_names(record.models)}; comparison.nc has {_names(models)}"
            )
    for number, band in enumerate(provenance.bands, start=1):
        unknown = [name for name in band.variants or () if name not in variants]
        if unknown:
            raise ReportError(
                f"{path}: bands, row {number}: variant {unknown[0]!r} is none of {_names(variants)}"
            )
    if provenance.case.sha256 not in _checksums(attributes.case_yaml):
        raise ReportError(
            f"{path}: case, sha256 is {provenance.case.sha256}, which is not that of the case file's text "
            "in comparison.nc (case_yaml)"
        )


def _check_rows(path: Path, names: tuple[Sequence[str], Sequence[str]], case: str, metrics: Metrics) -> None:
    variants, models = names
    for number, row in enumerate(metrics.rows, start=1):
        if row.case != case:
            raise ReportError(f"{path}: row {number}: case is {row.case!r}; comparison.nc is of {case!r}")
        if row.variant not in variants:
            raise ReportError(f"{path}: row {number}: variant {row.variant!r} is none of {_names(variants)}")
        if row.model not in models:
            raise ReportError(f"{path}: row {number}: model {row.model!r} is none of {_names(models)}")


def _names(names: Iterable[str]) -> str:
    return ", ".join(names) or "none"


def _checksums(text: str) -> set[str]:
    """Checksums of the files that are read as `text`: with either line ending, with or without a mark."""
    unix = text.replace("\r\n", "\n")
    contents = [t.encode() for t in (text, unix, unix.replace("\n", "\r\n"))]
    return {
        hashlib.sha256(mark + content).hexdigest() for mark in (b"", codecs.BOM_UTF8) for content in contents
    }
