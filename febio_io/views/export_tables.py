"""Writes plot files, logs and data records as tables (.csv) and labelled arrays (.nc)."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from cases.arrays import Singles
from febio_io.text.data_records import DataRecord
from febio_io.text.log import Log
from febio_io.views.arrays import ITEMS, SECTIONS, to_xarray
from febio_io.views.staging import safe_name
from febio_io.xplt import Mesh, Plot, Variable
from febio_io.xplt.mesh import PADDING, Domain, Region
from febio_io.xplt.whole import Quantity, quantities, regions_in, values_in

Advance = Callable[[], None]


def write_plot_csv(
    plot: Plot, folder: Path, variables: tuple[Variable, ...], states: list[int], advance: Advance
) -> None:
    """Write a table for each variable: a row for each state and node, item, or node of an item.

    Rows are left out where there are no values. Columns: "state", "time", the region and what in it, values.
    """
    taken: set[str] = set()
    for quantity in quantities(variables, SECTIONS):
        name = f"{safe_name(plot.path.stem)}_{safe_name(quantity.label)}"
        while name.lower() in taken:
            name += "_"
        taken.add(name.lower())
        with (folder / f"{name}.csv").open("w", encoding="utf-8", newline="") as file:
            head = True
            for state in states:
                for table in _tables(plot, quantity, state):
                    table.to_csv(file, header=head, index=False, float_format="%.9g")
                    head = False
                advance()


def _tables(plot: Plot, quantity: Quantity, state: int) -> list[pd.DataFrame]:
    mesh, kind = plot.mesh_of(state), quantity.kind
    regions = {region.region: region for region in regions_in(mesh, kind.section)}
    tables = []
    for number, values in values_in(plot, quantity, state).items():
        keys: dict[str, Any] = {"state": state, "time": plot.times[state]}
        rows = np.atleast_1d(values).reshape(-1, kind.n_components or 1)
        if number in regions:
            keys |= _region_keys(mesh, regions[number], kind)
            rows, keys = _without_padding(regions[number], kind, rows, keys)
        elif kind.section == "node":
            keys["node"] = mesh.node_ids
        names = _distinct(("value",) if kind.is_scalar else kind.components, keys)
        tables.append(pd.DataFrame(keys | {name: rows[:, place] for place, name in enumerate(names)}))
    return tables


def _region_keys(mesh: Mesh, region: Region, kind: Variable) -> dict[str, Any]:
    keys: dict[str, Any] = {kind.section: region.region, f"{kind.section}_name": region.name}
    if kind.storage == "node":
        return keys | {"node": mesh.node_ids[region.nodes]}
    if kind.storage == "region":
        return keys
    items = region.element_ids if isinstance(region, Domain) else np.arange(1, region.n_items + 1)
    if kind.storage == "item":
        return keys | {ITEMS[kind.section]: items}
    places = np.arange(1, region.nodes_per_item + 1)
    return keys | {
        ITEMS[kind.section]: np.repeat(items, len(places)),
        "place": np.tile(places, region.n_items),
    }


def _without_padding(
    region: Region, kind: Variable, rows: Singles, keys: dict[str, Any]
) -> tuple[Singles, dict[str, Any]]:
    table = getattr(region, "faces", getattr(region, "lines", None))
    if kind.storage != "mult" or table is None:
        return rows, keys
    used = (table != PADDING).ravel()
    kept = {key: value[used] if isinstance(value, np.ndarray) else value for key, value in keys.items()}
    return rows[used], kept


def _distinct(names: tuple[str, ...], taken: dict[str, Any]) -> list[str]:
    found: list[str] = []
    for name in names:
        label, count = name, 1
        while label in taken or label in found:
            count += 1
            label = f"{name} ({count})"
        found.append(label)
    return found


def write_plot_nc(
    plot: Plot, folder: Path, variables: tuple[Variable, ...], states: list[int], advance: Advance
) -> None:
    """Write one netCDF file."""
    names = {variable.name for variable in variables}
    dataset = to_xarray(plot, variables=names, states=states)
    write_nc(dataset, folder / f"{safe_name(plot.path.stem)}.nc")
    advance()


def write_nc(dataset: xr.Dataset, path: Path) -> None:
    """Write a dataset; netCDF does not take slashes in names."""
    names = {name: str(name).replace("/", "_") for name in (*dataset.variables, *dataset.sizes)}
    dataset.rename({old: new for old, new in names.items() if old != new}).to_netcdf(path, engine="netcdf4")


def record_dataset(record: DataRecord, columns: list[str] | None) -> xr.Dataset:
    """Give the columns of a record that are wanted; all, unless given."""
    dataset = record.to_xarray()
    return dataset if columns is None else dataset[columns]


def log_tables(log: Log) -> dict[str, pd.DataFrame]:
    """Give a log as tables: steps, iterations, messages, inputs, timings."""
    iterations = [
        {"analysis_step": step.analysis_step, "step": step.number, "attempt": step.attempt}
        | {"iteration": item.number, "time": item.time, "line_search_step": item.line_search_step}
        | {
            f"{name} {part}": getattr(norm, part)
            for name, norm in item.norms.items()
            for part in ("initial", "current", "required")
        }
        for step in log.time_steps
        for item in step.iterations
    ]
    return {
        "steps": log.steps_table(),
        "iterations": pd.DataFrame(iterations),
        "messages": pd.DataFrame([vars(item) for item in log.messages], columns=["line", "kind", "text"]),
        "inputs": pd.DataFrame(
            [vars(item) for item in log.inputs], columns=["line", "section", "item", "name", "value"]
        ),
        "timings": pd.DataFrame(sorted(log.timings.items()), columns=["what", "seconds"]),
    }
