"""Timings of the solver: each scheme in this process, and the whole command."""

import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numba
import numpy as np
from rich.box import SIMPLE_HEAD
from rich.table import Table

from cases.reading.case_file import CaseFile, load_case_file
from cases.sections.case import Case
from solver.case.godunov import THREADS
from solver.case.model import model_of
from solver.case.run import walk
from solver.errors import SolverError
from validation.runs.provenance import provenance

ROOT = Path(__file__).parents[2]
VARIANTS = ("none", "axisymmetric", "local")
EXPLICIT = "local_explicit"


@dataclass(frozen=True)
class Run:
    """Time that one run took, without its start: wall and processor seconds, and what was computed."""

    wall_s: float
    cpu_s: float
    steps: int
    sweeps: int


@dataclass(frozen=True)
class Timing:
    """One line of the table.

    Attributes
    ----------
    name : str
    cores : int
        Threads that may compute side by side.
    cells, steps, sweeps : int
        Of one run; sweeps of the implicit scheme's iteration, else 0.
    wall_s, cpu_s : list of float
        Seconds of each repetition.
    median_s : float
        Median of ``wall_s``, for all steps.
    updates_per_s, sweep_updates_per_s : float or None
        Cells × steps, and cells × sweeps, over the median; None for a whole process, and without sweeps.
    extrapolated : bool
        Whether ``median_s`` was inferred from fewer steps.
    """

    name: str
    cores: int
    cells: int
    steps: int
    sweeps: int
    wall_s: list[float]
    cpu_s: list[float]
    median_s: float
    updates_per_s: float | None
    sweep_updates_per_s: float | None
    extrapolated: bool = False


def timed_run(case: Case, end: float) -> Run:
    """Run a case to ``end`` (s), saving states once a cycle; finding the start is not timed."""
    period = case.inlet.period
    times = np.append(np.arange(0.0, end * (1 - 1e-9), period), end)
    stops = walk(case, model_of(case), times)
    next(stops)
    wall, cpu = time.perf_counter(), time.process_time()
    stop = list(stops)[-1]
    return Run(time.perf_counter() - wall, time.process_time() - cpu, stop.steps, stop.sweeps)


def row_of(name: str, cores: int, case: Case, runs: Sequence[Run]) -> Timing:
    """Summarise the repetitions of one run."""
    cells = case.solver.n_x * case.solver.n_phi
    median = statistics.median(run.wall_s for run in runs)
    steps, sweeps = runs[-1].steps, runs[-1].sweeps
    return Timing(
        name,
        cores,
        cells,
        steps,
        sweeps,
        [run.wall_s for run in runs],
        [run.cpu_s for run in runs],
        median,
        cells * steps / median,
        cells * sweeps / median if sweeps else None,
    )


def implicit_row(variant: str, case: Case, repeat: int) -> Timing:
    """Scheme ``semi_implicit`` on one core; one more run before the measured ones warms the caches."""
    end = case.inlet.period * case.solver.cycles
    threads = numba.get_num_threads()
    numba.set_num_threads(1)
    try:
        timed_run(case, case.inlet.period / 10)
        runs = [timed_run(case, end) for _ in range(repeat)]
    finally:
        numba.set_num_threads(threads)
    return row_of(f"semi_implicit, {variant}", 1, case, runs)


def explicit_row(case: Case, most: int | None) -> Timing:
    """Scheme ``godunov`` on two cores, once; all steps, or the first ``most`` extrapolated to all."""
    end, dt = case.inlet.period * case.solver.cycles, case.solver.time_step
    timed_run(case, 10 * dt)
    if most is None or end <= most * dt:
        return row_of("godunov, local", THREADS, case, [timed_run(case, end)])
    row = row_of("godunov, local", THREADS, case, [timed_run(case, most * dt)])
    steps = round(end / dt)
    return replace(row, steps=steps, median_s=row.median_s * steps / row.steps, extrapolated=True)


def process_row(path: Path, case: Case, repeat: int) -> Timing:
    """Time ``python -m solver`` as a whole process, with its kernels compiled and cached before."""
    seconds = []
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "run.nc"
        command = [sys.executable, "-m", "solver", str(path), "--variant", "local", "--output", str(output)]
        for _ in range(repeat + 1):
            begin = time.perf_counter()
            done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)  # noqa: S603
            seconds.append(time.perf_counter() - begin)
            if done.returncode:
                raise SolverError(done.stderr.strip())
    cells, warm = case.solver.n_x * case.solver.n_phi, seconds[1:]
    return Timing("python -m solver, local", 1, cells, 0, 0, warm, [], statistics.median(warm), None, None)


def measure(path: Path, repeat: int, most: int | None, shown: Callable[[str], None]) -> list[Timing]:
    """Measure all rows, the explicit one by ``most`` steps if any; ``shown`` is told what is measured next.

    Raises
    ------
    CaseError, SolverError
        If the case cannot be read or a run fails.
    """
    file: CaseFile = load_case_file(path)
    rows = []
    for variant in VARIANTS:
        shown(f"semi_implicit, {variant}")
        rows.append(implicit_row(variant, file.variants[variant], repeat))
    shown("godunov, local")
    rows.append(explicit_row(file.variants[EXPLICIT], most))
    shown("python -m solver")
    rows.append(process_row(path, file.variants["local"], repeat))
    return rows


def _rate(value: float | None) -> str:
    return "" if value is None else f"{value / 1e6:.1f}"


def table_of(rows: Sequence[Timing]) -> Table:
    """Lay rows out for the terminal."""
    table = Table(
        title="Median of the repetitions; updates = cells × steps, sweeps = cells × sweeps",
        title_justify="left",
        box=SIMPLE_HEAD,
    )
    table.add_column("run", overflow="fold")
    headings = ("cores", "cells", "steps", "s", "CPU s", "10⁶ updates/s", "10⁶ sweeps/s")
    for heading in headings:
        table.add_column(heading, justify="right")
    for row in rows:
        table.add_row(
            row.name,
            str(row.cores),
            str(row.cells),
            str(row.steps) if row.steps else "",
            ("≈ " if row.extrapolated else "") + f"{row.median_s:.3g}",
            f"{statistics.median(row.cpu_s):.3g}" if row.cpu_s and not row.extrapolated else "",
            _rate(row.updates_per_s),
            _rate(row.sweep_updates_per_s),
        )
    return table


def result_of(rows: Sequence[Timing], path: Path, command: list[str]) -> dict[str, Any]:
    """Collect what is kept: the rows, and what measured them."""
    return {**provenance(path, [], command), "rows": [asdict(row) for row in rows]}
