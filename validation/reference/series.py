"""``reference.kind: series``: pressure, flow rate and radius over one cycle at one place.

What the series does not state is NaN. It is repeated with the inlet's period and shifted by its declared
offset alone; a cubic spline takes it to even instants, which references of several variants then share.
"""

from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from cases.arrays import Floats
from cases.sections.case import Case
from cases.sections.references.series import SeriesReference
from cases.values.column_file import MMHG
from cases.values.wording import choices
from validation.errors import UnusableReferenceError
from validation.mapping.derived import as_dataset
from validation.mapping.rays import Rays
from validation.reference.alignment import SLACK, WHOLE, Alignment
from validation.reference.kind import Progress, Reference, ReferenceKind
from validation.reference.unstated import nothing_stated
from validation.runs.provenance import shown_path

TIMES = {"t_s": 1.0, "t_ms": 1e-3}
COLUMNS = {  # of the file: the field that it holds, and its unit in SI
    "pressure_Pa": ("section_pressure", 1.0),
    "pressure_kPa": ("section_pressure", 1e3),
    "pressure_mmHg": ("section_pressure", float(MMHG)),
    "flow_rate_m3_s": ("section_flow_rate", 1.0),
    "flow_rate_cm3_s": ("section_flow_rate", 1e-6),
    "flow_rate_mL_s": ("section_flow_rate", 1e-6),
    "radius_m": ("radius", 1.0),
    "radius_mm": ("radius", 1e-3),
    "radius_change_m": ("radius_change", 1.0),
    "radius_change_mm": ("radius_change", 1e-3),
}
FEWEST = 3  # instants


def align_series(case: Case) -> Alignment:
    """Instants of the cycle, evenly, as many as the series has.

    Raises
    ------
    UnusableReferenceError
        If the file has no increasing times, or they do not cover one cycle.
    """
    stated, period = _stated(case), case.inlet.period
    times = _times(stated, _table(stated))
    if not WHOLE * period <= np.ptp(times) <= (1 + SLACK) * period:
        raise UnusableReferenceError(
            f"{stated.file}: times from {times[0]:g} s to {times[-1]:g} s; "
            f"allowed: one cycle of {period:g} s (period of the inlet)"
        )
    instants = period * np.arange(times.size) / times.size
    return Alignment(
        states=np.arange(times.size),
        cycle_times=instants,
        rom_times=instants + (case.solver.cycles - 1) * period,
        cycles_later=case.solver.cycles - 1,
        coverage=1.0,
    )


def read_series(
    case: Case, rays: Rays, progress: Progress | None = None, alignment: Alignment | None = None
) -> Reference:
    """Read a series onto the section whose middle lies at its place.

    Raises
    ------
    UnusableReferenceError
        If no section's middle does, or the file holds nothing that is compared, or what is no number.
    """
    stated = _stated(case)
    alignment = align_series(case) if alignment is None else alignment
    section = _section(stated, rays)
    fields = nothing_stated(rays, alignment, "radius_change")
    table = _table(stated)
    known = [name for name in table if name in COLUMNS]
    if not known:
        raise UnusableReferenceError(
            f"{stated.file}: columns {', '.join(map(str, table))}; allowed: one or more of {choices(COLUMNS)}"
        )
    times, wanted = _times(stated, table), alignment.cycle_times + stated.time_offset
    for name in known:
        field, unit = COLUMNS[name]
        values = _at(wanted, times, unit * _numbers(stated, table, name), case.inlet.period)
        if field == "radius_change":  # some are stated over a least value of earlier cycles
            values = values - values.min()
        fields[field][:, section] = values[:, None] if fields[field].ndim > 2 else values
    if progress:
        progress(1, 1)
    return Reference(
        fields=as_dataset(fields, rays, alignment.cycle_times),
        checks=xr.Dataset(coords={"time": alignment.cycle_times}),
        alignment=alignment,
        description=_description(stated, alignment, known),
        notes=(),
        sparse=stated.sparse,
    )


def _stated(case: Case) -> SeriesReference:
    if not isinstance(case.reference, SeriesReference):
        raise UnusableReferenceError("the case states no series as reference")
    return case.reference


def _table(stated: SeriesReference) -> pd.DataFrame:
    try:
        return pd.read_csv(stated.file, comment="#", skipinitialspace=True)
    except (OSError, ValueError) as error:
        raise UnusableReferenceError(f"{stated.file}: cannot be read as CSV: {error}") from error


def _numbers(stated: SeriesReference, table: pd.DataFrame, column: str) -> Floats:
    values = pd.to_numeric(table[column], errors="coerce").to_numpy(dtype=float)
    (bad,) = np.nonzero(~np.isfinite(values))
    if bad.size:
        raise UnusableReferenceError(
            f"{stated.file}: row {bad[0] + 1} of {column}: {table[column].iloc[bad[0]]}; allowed: a number"
        )
    return values


def _times(stated: SeriesReference, table: pd.DataFrame) -> Floats:
    name = next((name for name in TIMES if name in table), None)
    if name is None:
        have = ", ".join(map(str, table))
        raise UnusableReferenceError(f"{stated.file}: no column {choices(TIMES)}; it has: {have}")
    times = TIMES[name] * _numbers(stated, table, name)
    if times.size < FEWEST or np.any(np.diff(times) <= 0):
        raise UnusableReferenceError(
            f"{stated.file}: {times.size} times that do not all increase; allowed: {FEWEST} or more that do"
        )
    return np.asarray(times)


def _at(times: Floats, known: Floats, values: Floats, period: float) -> Floats:
    """Values at the ``known`` times of the series, repeated with the period, at others by a cubic spline."""
    from scipy.interpolate import CubicSpline

    if np.ptp(known) > (1 - SLACK) * period:  # the last instant is the first of the next cycle
        known, values = known[:-1], values[:-1]
    spline = CubicSpline(
        np.append(known, known[0] + period), np.append(values, values[0]), bc_type="periodic"
    )
    return np.asarray(spline(known[0] + np.mod(times - known[0], period)))


def _section(stated: SeriesReference, rays: Rays) -> int:
    """Section whose middle is the stated place."""
    dx = float(rays.x[1] - rays.x[0])
    nearest = int(np.argmin(np.abs(rays.x - stated.x)))
    if abs(rays.x[nearest] - stated.x) > SLACK * dx:
        raise UnusableReferenceError(
            f"reference.x: {stated.x:g} m; allowed: the middle of a section, e.g. {rays.x[nearest]:g} m "
            "(an odd solver.n_x has one at mid-length)"
        )
    return nearest


def _description(stated: SeriesReference, alignment: Alignment, columns: list[str]) -> dict[str, Any]:
    count = alignment.cycle_times.size
    return {
        "kind": "series",
        "file": shown_path(stated.file),
        "x_m": stated.x,
        "time_offset_s": stated.time_offset,
        "columns": ", ".join(columns),
        "states": count,
        "states_compared": count,
        "coverage": round(alignment.coverage, 6),
    }


KIND = ReferenceKind(align_series, read_series)
