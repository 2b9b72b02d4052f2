"""Both models of a variant, from the cache where nothing that determines them has changed."""

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeVar

import numpy as np
import xarray as xr

from cases.sections.case import Case
from validation.errors import ValidationError
from validation.mapping.rays import Rays
from validation.reference.alignment import Alignment
from validation.reference.direction import inflow_sign
from validation.reference.kind import Progress, Reference, ReferenceKind
from validation.runs.cache import Cache, Entry
from validation.runs.keys import key_of
from validation.runs.packed import with_packed
from validation.runs.provenance import shown_path
from validation.runs.reduced_model import ReducedModelRun, compile_kernels, run_reduced_model

Remark = Callable[[str], None]


@dataclass(frozen=True)
class Numbers:
    """Some numbers that took long to find, as JSON holds them, and what to say of finding them."""

    values: dict[str, Any]
    description: dict[str, Any] = field(default_factory=dict)


T = TypeVar("T", ReducedModelRun, Reference, Numbers)


def rom_key(case: Case, alignment: Alignment, rays: Rays) -> str:
    """Key of a run of the reduced model: all but titles, reference, uncertainty, cells, instants, bands."""
    model = {
        name: getattr(case, name)
        for name in type(case).model_fields
        if name not in {"title", "reference", "compare", "uncertainty"}
    }
    return key_of("reduced model", {"case": model, "alignment": alignment, "rays": rays})


def reference_key(case: Case, alignment: Alignment, rays: Rays) -> str:
    """Key of a mapped reference; the names of its files are part of it, for messages show them."""
    parts = {
        "reference": case.reference,
        "files": [shown_path(path) for path in case.input_files],
        "geometry": case.geometry,
        "calcification": case.calcification,
        "inlet": {"period": case.inlet.period, "sign": inflow_sign(case, alignment)},
        "cells": case.compare.cells,
        "alignment": alignment,
        "rays": rays,
    }
    return key_of("reference", parts)


def _key(key: str, along_rays: bool) -> str:
    return key if along_rays else f"{key}-cells"


def _kept_fields(fields: xr.Dataset, along_rays: bool) -> xr.Dataset:
    """Fields as they are kept: packed, or without those along rays."""
    return with_packed(fields) if along_rays else fields.drop_dims("y")


def cached_reference(
    store: Cache | None,
    kind: ReferenceKind,
    case: Case,
    rays: Rays,
    progress: Progress,
    alignment: Alignment,
    remark: Remark,
    along_rays: bool = True,
) -> Reference:
    """Read a reference, or take it from the cache; with fields along rays where asked for."""

    def unpacked(entry: Entry) -> Reference:
        facts = entry.facts
        return Reference(
            fields=entry.datasets["fields"],
            checks=entry.datasets["checks"],
            alignment=alignment,
            description=facts["description"],
            notes=tuple(facts["notes"]),
            warnings=tuple(facts["warnings"]),
            sparse=facts["sparse"],
            cycle=facts["cycle"],
        )

    def packed(found: Reference) -> Entry:
        fields = _kept_fields(found.fields, along_rays)
        datasets = {"fields": fields, "checks": found.checks}
        facts = {
            "description": found.description,
            "notes": list(found.notes),
            "warnings": list(found.warnings),
            "sparse": found.sparse,
            "cycle": dict(found.cycle),
        }
        return Entry(datasets, facts)

    return _cached(
        store,
        lambda: _key(reference_key(case, alignment, rays), along_rays),
        lambda: kind.read(case, rays, progress, alignment),
        packed,
        unpacked,
        remark,
    )


def cached_rom(
    store: Cache | None,
    case: Case,
    alignment: Alignment,
    rays: Rays,
    progress: Progress,
    remark: Remark,
    along_rays: bool = True,
) -> ReducedModelRun:
    """Run the reduced model, or take its run from the cache; with fields along rays where asked for."""

    def computed() -> ReducedModelRun:
        compile_kernels(case)
        return run_reduced_model(case, alignment, rays, progress, along_rays)

    def unpacked(entry: Entry) -> ReducedModelRun:
        facts = entry.facts
        return ReducedModelRun(
            fields=entry.datasets["fields"],
            stiffness=entry.datasets["wall"]["wall_stiffness"],
            cycle_change=facts["cycle_change"],
            description=facts["description"],
        )

    def packed(found: ReducedModelRun) -> Entry:
        fields = _kept_fields(found.fields, along_rays)
        datasets = {"fields": fields, "wall": found.stiffness.to_dataset(name="wall_stiffness")}
        return Entry(datasets, {"cycle_change": found.cycle_change, "description": found.description})

    return _cached(
        store,
        lambda: _key(rom_key(case, alignment, rays), along_rays),
        computed,
        packed,
        unpacked,
        remark,
    )


def cached_numbers(
    store: Cache | None, key: Callable[[], str], compute: Callable[[], Numbers], remark: Remark
) -> Numbers:
    """Compute some numbers, or take them from the cache."""
    return _cached(
        store,
        key,
        compute,
        lambda found: Entry({}, {"values": found.values, "description": found.description}),
        lambda entry: Numbers(entry.facts["values"], entry.facts["description"]),
        remark,
    )


def cached_alignment(store: Cache | None, kind: ReferenceKind, case: Case, remark: Remark) -> Alignment:
    """Align a reference with the reduced model, or take its instants from the cache."""
    parts = {
        name: getattr(case, name)
        for name in type(case).model_fields
        if name not in {"title", "compare", "uncertainty"}
    }

    def compute() -> Numbers:
        found = kind.align(case)
        return Numbers({name: np.asarray(value).tolist() for name, value in vars(found).items()})

    try:
        key = key_of("reference", {"alignment of": parts})
    except OSError:  # of a file that its reader should name
        return kind.align(case)
    stated = cached_numbers(store, lambda: key, compute, remark).values
    arrays = {name: np.array(value) for name, value in stated.items() if isinstance(value, list)}
    return Alignment(**(stated | arrays))


def _cached(
    store: Cache | None,
    key: Callable[[], str],
    compute: Callable[[], T],
    packed: Callable[[T], Entry],
    unpacked: Callable[[Entry], T],
    remark: Remark,
) -> T:
    """Return what is kept under a key, else compute and keep it; what goes wrong with the cache is said."""
    if store is None:
        return _timed(compute)
    name = key()
    try:
        entry = store.get(name)
        if entry is not None:
            found = unpacked(entry)
            found.description["from_cache"] = True
            return found
    except (ValidationError, KeyError) as error:
        remark(f"cache: {error}; computed anew")
    kept = packed(_timed(compute))
    try:
        store.put(name, kept)
    except ValidationError as error:
        remark(f"cache: {error}; the result is not kept")
    return unpacked(kept)


def _timed(compute: Callable[[], T]) -> T:
    """Note in its description how long a result took."""
    begin = time.perf_counter()
    found = compute()
    found.description["wall_time_s"] = round(time.perf_counter() - begin, 3)
    return found
