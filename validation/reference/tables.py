"""``reference.kind: tables``: printed results at some cells and instants of the reduced model's grid.

What the tables do not state is NaN. The reduced model runs through instants all over the cycle, so that its
extremes can be compared with those that are quoted.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from cases.errors import QuantityError
from cases.fields import FIELDS
from cases.sections.case import Case
from cases.sections.references.tables import TablesReference
from cases.values.units import DIMENSION_OF_UNIT, parse_quantity
from validation.errors import UnusableReferenceError
from validation.mapping.derived import as_dataset
from validation.mapping.rays import Rays
from validation.reference.alignment import Alignment
from validation.reference.kind import Progress, Reference, ReferenceKind
from validation.reference.unstated import nothing_stated
from validation.runs.provenance import shown_path

PRINTED = 2e-3  # s: printed times are rounded, and one instant is not always printed alike
BETWEEN = 40  # instants besides those of the tables
CM3 = 1e-6  # m³ in a cm³
QUOTED = {  # quantities of the table of quoted values, by the names that metrics give them
    "systolic_pressure": "systolic_pressure",
    "diastolic_pressure": "diastolic_pressure",
    "max_pressure_difference": "largest_pressure_difference",
    "max_inner_radius": "largest_radius",
    "min_inner_radius": "least_radius",
    "max_radius_variation": "largest_radius_variation",
}


def align_tables(case: Case) -> Alignment:
    """Instants of the tables, and others between them.

    Raises
    ------
    UnusableReferenceError
        If an instant lies outside the cycle, or the case's grid is not that of the tables.
    """
    stated, period = _stated(case), case.inlet.period
    for name, ours, theirs in (
        ("n_x", case.solver.n_x, stated.n_x),
        ("n_phi", case.solver.n_phi, stated.n_phi),
    ):
        if ours != theirs:
            raise UnusableReferenceError(
                f"reference.{name}: the tables count cells of {theirs}, the case has solver.{name} {ours}"
            )
    printed = np.array(stated.instants) - stated.time_offset
    if printed.min() < -PRINTED or printed.max() > period + PRINTED:
        raise UnusableReferenceError(
            f"reference.instants: {printed.min():g} s to {printed.max():g} s into the cycle; "
            f"allowed: 0 s to {period:g} s (is reference.time_offset right?)"
        )
    instants = np.clip(printed, 0.0, period)
    regular = np.linspace(0.0, period, BETWEEN + 1)
    apart = np.min(np.abs(regular[:, None] - instants), axis=1) > PRINTED
    times = np.sort(np.concatenate([instants, regular[apart]]))
    cycles = case.solver.cycles
    return Alignment(
        states=np.arange(times.size),
        cycle_times=times,
        rom_times=times + (cycles - 1) * period,
        cycles_later=cycles - 1 - round(stated.time_offset / period),
        coverage=float(np.ptp(times)) / period,
    )


def read_tables(
    case: Case, rays: Rays, progress: Progress | None = None, alignment: Alignment | None = None
) -> Reference:
    """Read tables onto the cells that they name.

    Raises
    ------
    UnusableReferenceError
        If a file lacks a column, or states a cell, an instant or a unit that does not fit.
    """
    stated = _stated(case)
    alignment = align_tables(case) if alignment is None else alignment
    fields = nothing_stated(rays, alignment)
    tables = (
        ("section_flow_rate", stated.section_flow_rate, CM3),
        ("sector_flow_rate", stated.sector_flow_rate, CM3),
        ("axial_dominance_radial", stated.axial_dominance_radial, 1.0),
        ("axial_dominance_azimuthal", stated.axial_dominance_azimuthal, 1.0),
    )
    for name, path, factor in tables:
        if path is not None:
            _fill(fields[name], path, stated, alignment, factor)
    if progress:
        progress(1, 1)
    return Reference(
        fields=as_dataset(fields, rays, alignment.cycle_times),
        checks=xr.Dataset(coords={"time": alignment.cycle_times}),
        alignment=alignment,
        description=_description(stated, alignment),
        notes=(),
        sparse=stated.sparse,
        cycle=_quoted(stated),
    )


def _stated(case: Case) -> TablesReference:
    if not isinstance(case.reference, TablesReference):
        raise UnusableReferenceError("the case states no tables as reference")
    return case.reference


def _table(path: Path, columns: tuple[str, ...]) -> pd.DataFrame:
    """Read a CSV file that has these columns at least."""
    try:
        table = pd.read_csv(path)
    except (OSError, ValueError) as error:
        raise UnusableReferenceError(f"{path}: cannot be read as CSV: {error}") from error
    missing = [name for name in columns if name not in table]
    if missing:
        have = ", ".join(map(str, table.columns))
        raise UnusableReferenceError(f"{path}: no column {', '.join(missing)}; it has: {have}")
    return table


def _fill(
    values: NDArray[np.floating], path: Path, stated: TablesReference, alignment: Alignment, factor: float
) -> None:
    """Set values of a field (time, x[, phi]) or (x, phi) that a table states."""
    by_time, by_row = values.shape[0] == alignment.cycle_times.size, values.shape[-1] == stated.n_phi
    table = _table(path, (*(("t_s",) if by_time else ()), *(("j",) if by_row else ())))
    if "simulation" in table:
        table = table[table["simulation"] == stated.simulation]
    if table.empty:
        raise UnusableReferenceError(f"{path}: no rows of simulation {stated.simulation}")
    cells = {name: _number(path, name) for name in map(str, table.columns) if name.startswith("i_")}
    for line in table.to_dict("records"):
        place: list[Any] = [_state(path, float(line["t_s"]), stated, alignment)] if by_time else []
        for name, i in cells.items():
            here = [*place, _inside(path, i, stated.n_x, "i")]
            if by_row:
                here.append(_inside(path, int(line["j"]), stated.n_phi, "j"))
            values[tuple(here)] = factor * float(line[name])


def _number(path: Path, column: str) -> int:
    digits = column.removeprefix("i_")
    if not digits.isdecimal():
        raise UnusableReferenceError(f"{path}: column {column}; allowed: i_ and a cell's number")
    return int(digits)


def _inside(path: Path, cell: int, count: int, axis: str) -> int:
    """Index of a cell, which tables count from 1."""
    if not 1 <= cell <= count:
        raise UnusableReferenceError(f"{path}: cell {axis} = {cell}; allowed: 1 to {count}")
    return cell - 1


def _state(path: Path, time: float, stated: TablesReference, alignment: Alignment) -> int:
    """State of the stated instant that a printed time means."""
    instants = np.array(stated.instants)
    nearest = int(np.argmin(np.abs(instants - time)))
    if abs(instants[nearest] - time) > PRINTED:
        allowed = ", ".join(f"{instant:g} s" for instant in instants)
        raise UnusableReferenceError(f"{path}: t = {time:g} s is none of reference.instants ({allowed})")
    within = instants[nearest] - stated.time_offset
    return int(np.argmin(np.abs(alignment.cycle_times - within)))


def _quoted(stated: TablesReference) -> Mapping[str, float]:
    """Numbers of the whole cycle, SI, by the names of metrics."""
    path = stated.quoted
    if path is None:
        return {}
    table = _table(path, ("quantity", "model", "simulation", "value", "unit"))
    chosen = table[(table["model"] == stated.model) & (table["simulation"] == stated.simulation)]
    found = {}
    for line in chosen.to_dict("records"):
        name = QUOTED.get(str(line["quantity"]))
        if name is None:
            continue
        dimension = DIMENSION_OF_UNIT[FIELDS[name].unit]
        try:
            found[name] = parse_quantity(f"{line['value']} {line['unit']}", dimension)
        except QuantityError as error:
            raise UnusableReferenceError(f"{path}: {line['quantity']}: {error}") from error
    if {"systolic_pressure", "diastolic_pressure"} <= found.keys():
        found["pulse_pressure"] = found["systolic_pressure"] - found["diastolic_pressure"]
    return found


def _description(stated: TablesReference, alignment: Alignment) -> dict[str, Any]:
    return {
        "kind": "tables",
        "file": ", ".join(shown_path(path) for path in stated.files),
        "simulation": stated.simulation,
        "model": stated.model,
        "states": len(stated.instants),
        "states_compared": len(stated.instants),
        "coverage": round(alignment.coverage, 6),
    }


KIND = ReferenceKind(align_tables, read_tables)
