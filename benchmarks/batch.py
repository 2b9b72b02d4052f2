"""Measure what a case costs in a batch, beside a run of its own: 120 × 48 cells, one cycle at 1 ms.

    python benchmarks/batch.py [--cases 1000] [--output benchmarks/batch.json]

Every case has another calcification, viscosity and outlet. Three kinds: patches anywhere, of which all rows
are computed; patches symmetric about φ = 180 deg, of which one half is; and rings, of which one row is. The
cost of a case in the batch holds all that it takes: checking its values, its wall, its steady start, the run
and the few numbers kept. The last batch takes the time step that `error_tolerance` chooses, as a sweep does;
its cost holds the choice, and its numbers are held against those of the case's own step. Costs are processor
seconds, so that other work on the machine counts little; ratios are of one and the same run of this script.
"""

import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from scipy.stats import qmc

from cases.arrays import Floats
from cases.reading.calibration_file import changed_values
from cases.reading.case_file import load_case_file
from cases.reading.numeric_keys import numeric_keys
from cases.reading.template import case_with, load_template
from cases.sections.case import Case
from cases.shell.whole import write_text
from cases.values.kinds import STEP_TOLERANCE
from solver.case.run import run_case
from solver.model.parameters import Model
from solver.runs.batch import run_batch
from solver.runs.result import CellHistory, section_mean
from validation.runs.provenance import provenance
from validation.runs.time_step import SAMPLE, at_step, chosen

ROOT = Path(__file__).parents[1]
CASE = ROOT / "benchmarks" / "thesis.yaml"
INSTANTS = 40  # saved states of the cycle
FEW = 100  # cases, where ratios are wanted
SINGLE_RUNS, COMMANDS = 10, 3  # at most: no more than there are cases
# Latin hypercube over E and place of the patch, viscosity, resistance and offset of the outlet; SI
KEYS = {
    "calcification.youngs_modulus": (1e6, 2e7),
    "calcification.x[1]": (2e-3, 7e-3),
    "calcification.x[2]": (8e-3, 13e-3),
    "blood.viscosity": (0.003, 0.005),
    "outlet.resistance": (4e9, 7e9),
    "outlet.offset": (6e3, 9e3),
}
ANGLES = {"calcification.phi[1]": (1.6, 3.1), "calcification.phi[2]": (3.3, 4.8)}
KINDS = {"anywhere": ("local", KEYS | ANGLES), "symmetric": ("local", KEYS), "rings": ("axisymmetric", KEYS)}


def one_cycle(path: Path, folder: Path) -> Path:
    """Write the case with one cycle; its waveform by an absolute path."""
    text = path.read_text(encoding="utf-8").replace("cycles: 3", "cycles: 1")
    place = folder / path.name
    place.write_text(text.replace("reference_data/", f"{ROOT}/reference_data/"), encoding="utf-8")
    return place


def cases_of(path: Path, kind: str, count: int) -> list[Case]:
    """Checked cases of a design."""
    variant, spans = KINDS[kind]
    template = load_template(path, variant)
    known = numeric_keys(load_case_file(path).variants[variant])
    keys = [known[name] for name in spans]
    low, high = zip(*spans.values(), strict=True)
    points = qmc.scale(qmc.LatinHypercube(len(keys), rng=1).random(count), low, high)
    return [case_with(template, changed_values(keys, point)) for point in points]


def numbers(_model: Model, cells: CellHistory) -> tuple[float, float, float]:
    """What is kept: systolic and diastolic pressure, Pa, and the largest radius, m."""
    pressure = section_mean(cells.pressure, cells.area)
    return float(pressure.max()), float(pressure.min()), float(np.sqrt(cells.area.max()))


def measured(run: Callable[[], object]) -> dict[str, float]:
    """Wall and processor seconds of a call."""
    wall, cpu = time.perf_counter(), time.process_time()
    run()
    return {"wall_s": time.perf_counter() - wall, "cpu_s": time.process_time() - cpu}


def command_cpu_s(path: Path, folder: Path, count: int) -> float:
    """Processor seconds of ``python -m solver`` on the case, its kernels compiled before."""
    output = folder / "run.nc"
    command = [sys.executable, "-m", "solver", str(path), "--variant", "local", "--output", str(output)]
    spent = []
    for _ in range(count):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(command, cwd=ROOT, capture_output=True, check=True)  # noqa: S603
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        spent.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return statistics.median(spent)


def kept_of(cases: Sequence[Case], times: Floats, threads: int) -> Floats:
    """Numbers of each case (n, 3), NaN where it fails."""
    outcomes = run_batch(cases, times, numbers, threads, every_row=False)
    return np.array([(np.nan,) * 3 if outcome.kept is None else outcome.kept for outcome in outcomes])


def step_of(cases: Sequence[Case], times: Floats, threads: int) -> float:
    """Time step that keeps each number of a sample of cases to `error_tolerance`'s default, s."""
    some = [cases[n] for n in np.unique(np.linspace(0, len(cases) - 1, SAMPLE).astype(int))]

    def at(step: float) -> Floats:
        return kept_of([at_step(case, step) for case in some], times, threads)

    def scales(values: Floats) -> Floats:
        return np.nanmax(np.abs(values), axis=0)

    return chosen(cases[0].solver.time_step, times, 0.0, at, scales, STEP_TOLERANCE).time_step


def batch_row(path: Path, kind: str, count: int, threads: int, choose: bool = False) -> dict[str, Any]:
    """Measure one batch, reading and checking its cases included; what it costs a case."""
    found: dict[str, Any] = {}

    def run() -> None:
        cases = cases_of(path, kind, count)
        times = np.linspace(0.0, cases[0].inlet.period, INSTANTS + 1)
        found["step"] = step_of(cases, times, threads) if choose else cases[0].solver.time_step
        found["kept"] = kept_of([at_step(case, found["step"]) for case in cases], times, threads)

    row = measured(run)
    per_case = {"cpu_s_per_case": row["cpu_s"] / count, "wall_s_per_case": row["wall_s"] / count}
    about = {"kind": kind, "threads": threads, "cases": count, "time_step_s": found["step"]}
    failed = int(np.isnan(found["kept"]).any(axis=1).sum())
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    return {**about, "failed": failed, **row, **per_case, "peak_memory_mb": peak, "kept": found["kept"]}


def measure(count: int) -> dict[str, Any]:
    """All figures."""
    few = min(count, FEW)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        path = one_cycle(CASE, folder)
        case = load_case_file(path).variants["local"]
        times = np.linspace(0.0, case.inlet.period, INSTANTS + 1)
        run_case(case, times)
        single = [measured(lambda: run_case(case, times))["cpu_s"] for _ in range(min(SINGLE_RUNS, count))]
        command = command_cpu_s(path, folder, min(COMMANDS, count))
        batches = [batch_row(path, kind, few, threads) for kind in KINDS for threads in (1, 2)]
        batches += [batch_row(path, "anywhere", count, 2, choose) for choose in (False, True)]
    own, other = (row["kept"] for row in batches[-2:])
    batches[-1]["largest_deviation"] = float(np.max(np.abs(other / own - 1.0)))
    for row in batches:
        del row["kept"]
    in_process = statistics.median(single)
    for row in batches:
        row["share_of_run_case"] = row["cpu_s_per_case"] / in_process
        row["share_of_command"] = row["cpu_s_per_case"] / command
    return {
        **provenance(CASE, [], ["python", *sys.argv]),
        "load_average": os.getloadavg(),
        "run_case_cpu_s": single,
        "run_case_median_cpu_s": in_process,
        "command_median_cpu_s": command,
        "batches": batches,
    }


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--cases", type=int, default=1000)
    parser.add_argument("--output", type=Path, default=ROOT / "benchmarks" / "batch.json")
    chosen = parser.parse_args()
    found = measure(chosen.cases)
    write_text(chosen.output, json.dumps(found, indent=1) + "\n")
    print(f"one run in the process: {found['run_case_median_cpu_s']:.3f} s; ", end="")
    print(f"python -m solver: {found['command_median_cpu_s']:.2f} s")
    for row in found["batches"]:
        print(
            f"{row['cases']} {row['kind']} on {row['threads']} threads, {1e3 * row['time_step_s']:.3g} ms: "
            f"{row['cpu_s_per_case']:.3f} s a case "
            f"({row['share_of_run_case']:.0%} of a run, {row['share_of_command']:.0%} of the command), "
            f"{row['wall_s']:.1f} s in all by the clock, {row['failed']} failed"
        )
    print(f"largest deviation from the case's own step: {found['batches'][-1]['largest_deviation']:.1e}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
