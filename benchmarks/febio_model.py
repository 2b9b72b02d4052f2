"""Measure how long a FEBio model takes to write and to check.

    python benchmarks/febio_model.py [--elements 1000000]

The case is the ready one with a local calcification, its mesh refined. Aimed at: 10⁶ elements in 20 s.
"""

import argparse
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from cases.reading.case_file import load_case_file
from febio_io.feb.from_case import Choices, artery_model
from febio_io.feb.model import MeshSize
from febio_io.feb.structure import read_structure
from febio_io.feb.writer import write_model
from solver.case.periodic_outlet import periodic_outlet_flow

CASE = Path(__file__).parents[1] / "cases" / "calcification.yaml"


def timed(what: str, run: Callable[[], object]) -> None:
    wall, processor = time.perf_counter(), time.process_time()
    run()
    wall, processor = time.perf_counter() - wall, time.process_time() - processor
    print(f"{what:40} {wall:8.2f} s, {processor:.2f} s of processor time")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--elements", type=int, default=1_000_000)
    options = parser.parse_args()
    fine = max(1, round((options.elements / 7920) ** (1 / 3)))
    n_z = max(30, round(options.elements / (24 * fine * 11 * fine)))
    size = MeshSize(24 * fine, 8 * fine, 3 * fine, n_z)
    model = artery_model(load_case_file(CASE).variants["local"], Choices(size), periodic_outlet_flow)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.feb"
        timed(f"writing {size.n_elements} elements", lambda: write_model(model, path))
        print(f"{path.stat().st_size / 1e6:.0f} MB")
        timed("reading and checking them", lambda: read_structure(path))
    return 0


if __name__ == "__main__":
    sys.exit(main())
