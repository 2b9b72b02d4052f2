"""Tables 3.6, 3.7 and 3.9, 2D rows: three cardiac cycles."""

from functools import partial

import numpy as np

from solver.geometry.calcification import Patch
from solver.marching.godunov import march, march_to_steady, thesis_criteria
from solver.marching.godunov_setup import held, repeated
from validation.tables.artery import (
    CM3,
    FINE_STEP,
    LONGEST,
    PULSATILE_OUTLET,
    QUARTER_CM,
    artery,
    calcifying,
    healthy_steady_state,
    plaque,
    ring,
    thesis_table,
    thesis_waveform,
)
from validation.tables.experiment import Check, Entry, Experiment, Result, Results, number, within

CELLS = (1, 39, 61, 82, 120)
# Printed times and the ones meant. The third cycle ends at 2.392 s. Tables 3.6 and 3.9 print the same
# instant differently: far from the plaque 48 sectors of table 3.9 make the section flow rate of table 3.6.
INSTANTS = {1.692: 1.693, 1.693: 1.693, 1.884: 1.884, 2.393: 765_440 * FINE_STEP}
WALL_RAMP = 80e-3  # s
HALF_A_DIGIT = 0.5e-4  # cm³/s, table 3.9
THREADS = 2


def _key(time: float, row: int, cell: int) -> str:
    return f"t={time:.3f} j={row} i={cell}"


def three_cycles(patch: Patch | None, n_phi: int, times: tuple[float, ...], rows: tuple[int, ...]) -> Result:
    """Flow rates ½QΔφ (cm³/s) in cells at times, from the steady state of the same wall.

    With one row the sector is the whole section. ``times`` are as the thesis prints them.
    """
    resistance, offset = PULSATILE_OUTLET
    outlet = {"resistance": resistance, "offset": held(offset)}
    state = repeated(healthy_steady_state(PULSATILE_OUTLET), n_phi)
    setup = artery(120, n_phi, FINE_STEP, patch, inlet=thesis_waveform(), **outlet)
    if patch is not None:
        growing = artery(120, n_phi, FINE_STEP, patch, **outlet, **calcifying(n_phi, WALL_RAMP))
        criteria = thesis_criteria("flow" if n_phi == 1 else "ends")
        steady = march_to_steady(growing, state, criteria, not_before=WALL_RAMP, longest=LONGEST)
        state = steady.state
    instants = [INSTANTS[time] for time in times]
    run = march(setup, repeated(state, 1), instants, threads=THREADS if n_phi > 1 else 1)
    result: Result = {"steps": run.steps, "courant": run.courant}
    for time, reached in zip(times, run.states, strict=True):
        for row in rows:
            for cell in CELLS:
                sector = 0.5 * setup.grid.dphi * float(reached.flow[cell, row - 1]) * CM3
                result[_key(time, row, cell)] = sector
    return result


def _section_rows(table: str, entry: str, tolerance: float, results: Results) -> list[Check]:
    """Rows of table 3.6 or 3.7."""
    if entry not in results:
        return []
    printed = thesis_table(table)
    rows = []
    for _, line in printed[printed["simulation"] == "2D"].iterrows():
        for cell in CELLS:
            ours = number(results[entry], _key(float(line["t_s"]), 1, cell))
            case = f"t = {line['t_s']:.3f} s, i = {cell}"
            rows.append(within(case, "flow rate", "cm^3/s", ours, float(line[f"i_{cell}"]), tolerance))
    return rows


def _sector_rows(results: Results) -> list[Check]:
    """Rows of table 3.9: 0.5 % beyond rounding."""
    if "table 3.9" not in results:
        return []
    rows = []
    for _, line in thesis_table("3_9").iterrows():
        for cell in CELLS:
            ours = number(results["table 3.9"], _key(float(line["t_s"]), int(line["j"]), cell))
            thesis = float(line[f"i_{cell}"])
            case = f"j = {int(line['j'])}, t = {line['t_s']:.3f} s, i = {cell}"
            rows.append(within(case, "sector flow rate", "cm^3/s", ours, thesis, 0.005, HALF_A_DIGIT))
    return rows


SECTION_TIMES = (1.693, 1.884, 2.393)
SECTOR_TIMES = (1.692, 1.884, 2.393)

EXPERIMENTS = (
    Experiment(
        "3.6",
        "Three cycles without calcification",
        [Entry("table 3.6", partial(three_cycles, None, 1, SECTION_TIMES, (1,)), quick=True)],
        partial(_section_rows, "3_6", "table 3.6", 0.002),
    ),
    Experiment(
        "3.7",
        "Three cycles with axisymmetric calcification",
        [Entry("table 3.7", partial(three_cycles, ring(QUARTER_CM), 1, SECTION_TIMES, (1,)), quick=True)],
        partial(_section_rows, "3_7", "table 3.7", 0.005),
    ),
    Experiment(
        "3.9",
        "Three cycles with local calcification, 120 × 48 cells",
        [
            Entry(
                "table 3.9",
                partial(three_cycles, plaque(3 / 8 * np.pi), 48, SECTOR_TIMES, (4, 15, 25)),
                quick=False,
            )
        ],
        _sector_rows,
    ),
)
