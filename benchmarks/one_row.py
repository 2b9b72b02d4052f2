"""One row of 120 cells through 12,000 steps with 1,200 saved states, in two checkouts side by side.

    python benchmarks/one_row.py OLDER [--repeat N]

OLDER is a folder with another checkout and an environment of its own in `.venv`. A process of each runs the
same cases in turn, A B A B, after a run that loads its kernels; times are processor seconds of the runs
alone. The cases: a common carotid artery with a Windkessel and one pressure a row; the same behind a
resistance; and with one pressure a section.
"""

import argparse
import os
import statistics
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parents[1]
WINDKESSEL = (
    "{kind: windkessel, proximal_resistance: 2.4875e8 Pa s/m^3, distal_resistance: 1.8697e9 Pa s/m^3,"
    " compliance: 1.7529e-10 m^3/Pa, venous_pressure: 0 Pa}"
)
RESISTANCE = "{kind: resistance, resistance: 2.1e9 Pa s/m^3, offset: 0 Pa}"
KINDS = {
    "windkessel": ("row", WINDKESSEL),
    "resistance": ("row", RESISTANCE),
    "section": ("section", WINDKESSEL),
}
CASE = """name: one_row
title: One row
geometry: {{length: 126 mm, radius: 3 mm, wall_thickness: 0.3 mm}}
blood: {{density: 1060 kg/m^3, viscosity: 4 mPa s}}
wall: {{law: thin, youngs_modulus: 700 kPa, poisson_ratio: 0.499, reference_pressure: 10.933 kPa}}
calcification: {{pattern: none}}
inlet: {{kind: flow, waveform: {waveform}}}
outlet: {outlet}
solver: {{scheme: semi_implicit, pressure: {pressure}, n_x: 120, n_phi: 1, time_step: 0.1 ms, cycles: 2,
  closure: average, profile_exponent: 2}}
"""
RUNS = """
import sys, tempfile, time
from pathlib import Path

import numpy as np

try:
    from cases.reading.case_file import load_case_file
    from solver.case.run import run_case
except ImportError:  # an older checkout
    from cases.case_file import load_case_file
    from solver.case_run import run_case

with tempfile.TemporaryDirectory() as folder:
    path = Path(folder) / "one_row.yaml"
    path.write_text(sys.argv[1], encoding="utf-8")
    (case,) = load_case_file(path).variants.values()
times = np.linspace(0.0, 1.2, 1201)
run_case(case, times[:3])
print("ready", flush=True)
for _ in sys.stdin:
    begin = time.process_time()
    run_case(case, times)
    print(time.process_time() - begin, flush=True)
"""


def started(python: str | Path, checkout: Path, text: str) -> subprocess.Popen[str]:
    """Process of a checkout that runs the case once a line of its input."""
    process = subprocess.Popen(  # noqa: S603
        [python, "-c", RUNS, text],
        cwd=checkout,
        env=os.environ | {"PYTHONPATH": str(checkout)},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    answered(process)
    return process


def answered(process: subprocess.Popen[str]) -> str:
    """Line that a process answers with."""
    line = process.stdout.readline().strip() if process.stdout else ""
    if not line:
        sys.exit(f"a run failed: exit status {process.wait()}")
    return line


def timed(process: subprocess.Popen[str]) -> float:
    """Processor time of one run, s."""
    print(file=process.stdin, flush=True)
    return float(answered(process))


def main() -> None:
    """Run both checkouts in turn and tell the ratios."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("older", type=Path, help="folder of the other checkout")
    parser.add_argument("--repeat", type=int, default=5)
    options = parser.parse_args()
    older, waveform = options.older.resolve(), HERE / "reference_data/boileau2015/cca_inflow.csv"
    for kind, (pressure, outlet) in KINDS.items():
        text = CASE.format(waveform=waveform, outlet=outlet, pressure=pressure)
        pair = [started(sys.executable, HERE, text), started(older / ".venv/bin/python", older, text)]
        costs = [[timed(process) for process in pair] for _ in range(options.repeat)]
        for process in pair:
            process.communicate()
        new, old = (statistics.median(column) for column in zip(*costs, strict=True))
        ratio = statistics.median(a / b for a, b in costs)
        print(f"{kind}: {new:.3f} s; older {old:.3f} s; ratio {ratio:.3f}")


if __name__ == "__main__":
    main()
