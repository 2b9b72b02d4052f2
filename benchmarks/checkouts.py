"""Two checkouts side by side: do the ready cases give the same figures, and what does each cost?

    python benchmarks/checkouts.py OLDER [--cases NAME ...] [--repeat N] [--fresh]

OLDER is a folder with another checkout and an environment of its own in `.venv` (the README's first command
makes it), as this one has. Both run each case in turn, A B A B, each with a cache of its own; rows of
metrics.json are compared one by one, those of the first model where a case has several. Exit status 1 if a
figure differs by more than the tolerance.
"""

import argparse
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).parents[1]
CASES = ("calcification", "coupled", "thesis")
TOLERANCE = 1e-12
KEY = ("variant", "quantity", "statistic", "inflow", "i", "j", "t_s", "band")
VALUES = ("rom", "reference", "error")


@dataclass
class Cost:
    """Wall and processor time, s, of each counted run."""

    wall: list[float] = field(default_factory=list)
    processor: list[float] = field(default_factory=list)


def run(checkout: Path, case: str, work: Path, options: list[str]) -> tuple[float, float]:
    """Wall and processor time of one comparison, s; its result is in ``work/case``."""
    command = [str(checkout / ".venv/bin/python"), "-m", "validation.compare", f"cases/{case}.yaml"]
    command += ["--output", str(work / case), *options]
    surroundings = os.environ | {"ARTERIAL_ROM_CACHE": str(work / "cache"), "PYTHONPATH": str(checkout)}
    before = os.times()
    subprocess.run(command, cwd=checkout, env=surroundings, check=True, capture_output=True)  # noqa: S603
    after = os.times()
    used = after.children_user + after.children_system - before.children_user - before.children_system
    return after.elapsed - before.elapsed, used


def rows(path: Path) -> dict[tuple[object, ...], dict[str, object]]:
    """Rows of a metrics.json's first model by what they are about; older ones name no model."""
    found = json.loads(path.read_text(encoding="utf-8"))
    first = found[0].get("model") if found else None
    return {tuple(row.get(name, "") for name in KEY): row for row in found if row.get("model") == first}


def differences(new: Path, old: Path, tolerance: float) -> list[str]:
    """Figures that differ, and rows that only one side has, a line each."""
    mine, theirs = rows(new), rows(old)
    lines = [
        f"only in {side}: {key}"
        for side, a, b in (("older", theirs, mine), ("this", mine, theirs))
        for key in a.keys() - b.keys()
    ]
    for key in mine.keys() & theirs.keys():
        for name in VALUES:
            a, b = mine[key][name], theirs[key][name]
            if key[1] == "wall_time":
                continue
            if (a is None) != (b is None) or (
                isinstance(a, float)
                and isinstance(b, float)
                and not math.isclose(a, b, rel_tol=tolerance, abs_tol=tolerance)
            ):
                lines.append(f"{key} {name}: {a!r} now, {b!r} before")
    return lines


def main() -> int:
    """Run both checkouts and compare them."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("older", type=Path, help="folder of the other checkout")
    parser.add_argument("--cases", nargs="+", default=CASES, help="names of files in cases/")
    parser.add_argument("--repeat", type=int, default=1, help="counted runs of each, after one that warms up")
    parser.add_argument("--fresh", action="store_true", help="compute both models in the counted runs too")
    parser.add_argument("--tolerance", type=float, default=TOLERANCE)
    options = parser.parse_args()
    checkouts = {"this": HERE, "older": options.older.resolve()}
    broken = False
    with tempfile.TemporaryDirectory() as folder:
        for case in options.cases:
            costs = {name: Cost() for name in checkouts}
            for counted in range(options.repeat + 1):
                for name, checkout in checkouts.items():
                    fresh = ["--fresh"] if options.fresh else []
                    wall, used = run(checkout, case, Path(folder) / name, fresh)
                    if counted:
                        costs[name].wall.append(wall)
                        costs[name].processor.append(used)
            results = [Path(folder) / name / case / "metrics.json" for name in checkouts]
            lines = differences(*results, options.tolerance)
            broken |= bool(lines)
            print(f"{case}: {len(rows(results[0]))} rows, {len(lines)} differences")
            print("\n".join(f"  {line}" for line in lines[:20]))
            for kind in ("wall", "processor"):
                a, b = (statistics.median(getattr(costs[name], kind)) for name in checkouts)
                print(f"  {kind} time {a:.2f} s; older {b:.2f} s; ratio {a / b:.3f}")
    return int(broken)


if __name__ == "__main__":
    sys.exit(main())
