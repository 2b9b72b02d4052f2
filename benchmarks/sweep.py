"""Speed of sweeps: 1000 cases on two cores, one worker against two, and what the scheduler costs a task.

python benchmarks/sweep.py [--cases 1000] [--output benchmarks/sweep.json]

Wall times mean something on a quiet machine only: the JSON states the load before, what all processes
of the machine used meanwhile, and processor seconds besides.
"""

import argparse
import hashlib
import json
import os
import platform
import resource
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pandas as pd
import psutil

from validation.sweep.chunk import Plan, Record
from validation.sweep.cluster import PROCESSES, connected
from validation.sweep.run import Where, run_sweep
from validation.sweep.samples import Sample
from validation.sweep.stream import computed
from validation.sweep.study import load_study

ROOT = Path(__file__).parents[1]
STUDY = """
name: benchmark
base: {base}
variant: local
overrides: {{solver: {{cycles: 1}}}}
parameters:
  calcification.youngs_modulus: {{start: 1 MPa, stop: 20 MPa, count: {count}}}
"""
TASK_S, TASKS = 0.1, 200
LOOK_EVERY = 0.2  # s
BLOCK = bytes(1_000_000)


def spin(samples: list[Sample], _plan: Plan) -> list[Record]:
    """Keep a processor busy for a tenth of a second of its own time, without Python's lock, as a run does."""
    end = time.thread_time() + TASK_S
    while time.thread_time() < end:
        hashlib.sha256(BLOCK).digest()
    return [{"sample": sample.number} for sample in samples]


def timed(work: Callable[[], object]) -> dict[str, float]:
    """Wall time of some work, and the share of the machine that was idle or at other work meanwhile."""
    begin, ticks = time.perf_counter(), _ticks()
    work()
    wall = time.perf_counter() - begin
    busy = (_ticks() - ticks) / os.sysconf("SC_CLK_TCK")
    return {"wall_s": round(wall, 2), "machine_busy_s": round(busy, 2)}


def _ticks() -> int:
    """Processor ticks of the whole machine that were not idle."""
    words = Path("/proc/stat").read_text(encoding="utf-8").split("\n", 1)[0].split()[1:]
    user, nice, system, _, _, *interrupts = map(int, words[:8])
    return user + nice + system + sum(interrupts)


def sweep_of(count: int, workers: int, folder: Path) -> dict[str, Any]:
    """Sweep the ready local case (120 x 48, one cycle, its step chosen), start of the cluster included."""
    path = folder / "study.yaml"
    path.write_text(STUDY.format(base=ROOT / "cases/calcification.yaml", count=count), encoding="utf-8")
    out = folder / f"{count}-{workers}"
    with memory_of_workers() as peaks:
        found = timed(lambda: run_sweep(load_study(path), Where(out, PROCESSES, workers), print))
    records = pd.read_parquet(out / "samples")
    if len(records) != count or records["status"].ne("ok").any():
        raise SystemExit(f"{out}: not all of {count} samples are there")
    own = round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
    step = json.loads((out / "study.json").read_text(encoding="utf-8"))["time_steps"]["local"]
    return found | {
        "cases": count,
        "workers": workers,
        "samples_cpu_s": round(records["seconds"].sum(), 2),
        "time_step": step,
        "peak_memory_mb": {"client": own, "workers": sorted(map(round, peaks.values()))[-workers:]},
    }


@contextmanager
def memory_of_workers() -> Iterator[dict[int, float]]:
    """Watch the processes that this one starts: the largest resident memory of each, MB, by number."""
    peaks: dict[int, float] = {}
    done = threading.Event()

    def watch() -> None:
        while not done.wait(LOOK_EVERY):
            for process in psutil.Process().children(recursive=True):
                try:
                    used = process.memory_info().rss / 2**20
                except psutil.NoSuchProcess:
                    continue
                peaks[process.pid] = max(used, peaks.get(process.pid, 0.0))

    watcher = threading.Thread(target=watch)
    watcher.start()
    try:
        yield peaks
    finally:
        done.set()
        watcher.join()


def rest(samples: list[Sample], _plan: Plan) -> list[Record]:
    """Take a tenth of a second and no processor."""
    time.sleep(TASK_S)
    return [{"sample": sample.number} for sample in samples]


def overhead(workers: int) -> dict[str, float]:
    """Share that the scheduler adds to tasks of a tenth of a second, on a cluster that has started.

    ``processor``: of their processor time, in the client (scheduler included) and the workers together,
    whatever else the machine does; ``waiting``: of the wall time of tasks that only wait, so that they do not
    compete with the scheduler; ``wall``: of the wall time of tasks that compute, which says something on an
    idle machine with more processors than workers.
    """
    chunks = [(number, [Sample(number, "", (), None)]) for number in range(TASKS)]
    nothing, tasks_s = Plan((), (), {}), TASKS * TASK_S
    with connected(PROCESSES, workers, print) as client:

        def processor_s() -> float:
            return time.process_time() + sum(client.run(time.process_time).values())

        list(computed(client, chunks[: 4 * workers], nothing, spin))
        begin = processor_s()
        found = timed(lambda: list(computed(client, chunks, nothing, spin)))
        spent = processor_s() - begin
        waited = timed(lambda: list(computed(client, chunks, nothing, rest)))
    return found | {
        "workers": workers,
        "processor": round(spent / tasks_s - 1.0, 4),
        "waiting": round(waited["wall_s"] * workers / tasks_s - 1.0, 4),
        "wall": round(found["wall_s"] * workers / tasks_s - 1.0, 4),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=1000)
    parser.add_argument("--output", type=Path, default=ROOT / "benchmarks/sweep.json")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        sweep_of(16, 2, folder)  # compiles the kernels
        result = {
            "machine": {
                "system": platform.platform(),
                "processors": os.cpu_count(),
                "load_before": os.getloadavg()[0],
            },
            "thousand": sweep_of(options.cases, 2, folder),
            "scaling": [sweep_of(options.cases // 4, workers, folder) for workers in (1, 2)],
            "scheduler": [overhead(workers) for workers in (1, 2)],
        }
    one, two = (found["wall_s"] for found in result["scaling"])
    result["efficiency_of_two_workers"] = round(one / (2.0 * two), 3)
    options.output.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    print(json.dumps(result, indent=1))


if __name__ == "__main__":
    main()
