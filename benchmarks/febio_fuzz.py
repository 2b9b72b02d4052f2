"""Feed damaged files to the readers of febio_io, and count what must not happen.

    python benchmarks/febio_fuzz.py [--runs N] [--seed K] [--engine mutations|coverage]

Every input is one of the tests' samples, damaged: a plot file, the inside of a compressed state, a log, a
data record or a model. It is read whole. Allowed are success and an error of the package's own family; an
input that leads to anything else is kept in `--keep` and makes the exit status 1: another exception, more
than `--seconds` for one input, more than `--memory` megabytes. "mutations" is this own driver; "coverage"
steers by the lines reached and needs atheris (pip install atheris).
"""

import argparse
import contextlib
import importlib
import random
import resource
import signal
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from types import FrameType

from febio_io.errors import FebioError


class TooSlowError(BaseException):
    """One input took too long."""


def resident_megabytes() -> float:
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 1e6


def too_slow(_number: int, _frame: FrameType | None) -> None:
    raise TooSlowError


def run_mutations(options: argparse.Namespace, folder: Path) -> int:
    inputs = importlib.import_module("febio_fuzz_inputs")
    kinds = [kind for kind in inputs.kinds() if options.kinds is None or kind.name in options.kinds]
    weights = [kind.weight for kind in kinds]
    random_ = random.Random(options.seed)  # noqa: S311 - nothing secret
    signal.signal(signal.SIGALRM, too_slow)
    outcomes: Counter[str] = Counter()
    slowest, started, early, path = 0.0, time.perf_counter(), 0.0, folder / "input"
    for run in range(options.runs):
        if run == max(options.runs // 10, 1):
            early = resident_megabytes()
        (kind,) = random_.choices(kinds, weights)
        content = kind.around(inputs.mutate(random_.choice(kind.samples), random_))
        path.write_bytes(content)
        before = time.process_time()
        signal.setitimer(signal.ITIMER_REAL, options.seconds)
        try:
            kind.read(path)
            outcome = "read"
        except FebioError as error:
            outcome = f"refused by {type(error).__name__}"
        except (Exception, TooSlowError) as error:  # noqa: BLE001 - finding them is the point
            outcome = f"WRONG: {type(error).__name__}"
            (options.keep / f"{options.seed}_{run}").write_bytes(content)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
        slowest = max(slowest, time.process_time() - before)
        outcomes[f"{kind.name:18} {outcome}"] += 1
    print(f"{options.runs} inputs, seed {options.seed}, {time.perf_counter() - started:.0f} s")
    for outcome, count in sorted(outcomes.items()):
        print(f"  {outcome:50} {count:8}")
    print(f"  slowest input {1e3 * slowest:.0f} ms of processor time")
    print(f"  resident memory {early:.0f} MB after a tenth of them, {resident_megabytes():.0f} MB at the end")
    return int(any("WRONG" in outcome for outcome in outcomes))


def run_coverage(options: argparse.Namespace, folder: Path) -> int:
    import atheris

    with atheris.instrument_imports(include=["febio_io"]):
        kinds = importlib.import_module("febio_fuzz_inputs").kinds()
    corpus = folder / "corpus"
    corpus.mkdir()
    for number, kind in enumerate(kinds):
        for place, content in enumerate(kind.samples):
            (corpus / f"{number}_{place}").write_bytes(bytes([number]) + content)
    path = folder / "input"

    def one_input(data: bytes) -> None:
        if data:
            kind = kinds[data[0] % len(kinds)]
            path.write_bytes(kind.around(data[1:]))
            with contextlib.suppress(FebioError):
                kind.read(path)

    limits = [f"-runs={options.runs}", f"-seed={options.seed}", "-max_len=8192"]
    limits += [f"-timeout={options.seconds}", f"-rss_limit_mb={options.memory}"]
    limits += [f"-artifact_prefix={options.keep}/", "-print_final_stats=1"]
    atheris.Setup([sys.argv[0], *limits, str(corpus)], one_input)
    atheris.Fuzz()
    return 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--runs", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--engine", choices=("mutations", "coverage"), default="mutations")
    parser.add_argument("--kinds", nargs="+", metavar="NAME", help="only these, e.g. model, log")
    parser.add_argument("--seconds", type=int, default=5, help="most for one input")
    parser.add_argument("--memory", type=int, default=2048, help="most megabytes")
    parser.add_argument("--keep", type=Path, default=Path("fuzz_findings"), metavar="DIR")
    options = parser.parse_args()
    options.keep.mkdir(parents=True, exist_ok=True)
    run = run_coverage
    if options.engine == "mutations":
        run = run_mutations
        most = options.memory << 20
        resource.setrlimit(resource.RLIMIT_DATA, (most, most))
    shared_memory = Path("/dev/shm")  # noqa: S108 - fast where it is there
    with tempfile.TemporaryDirectory(dir=shared_memory if shared_memory.is_dir() else None) as folder:
        return run(options, Path(folder))


if __name__ == "__main__":
    sys.exit(main())
