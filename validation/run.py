"""Run every variant of a case: its reference onto the cells, then the reduced model at its instants."""

import threading
import time
from collections.abc import Iterator, Mapping
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait
from contextlib import contextmanager
from dataclasses import dataclass, field

from rich.console import Console
from rich.progress import Progress as Display

from cases.schema import Case
from solver.errors import SolverError
from solver.from_case import grid_of
from validation.comparison import VariantRun
from validation.errors import ValidationError
from validation.febio_reference import read_febio
from validation.rays import rays
from validation.reduced_model import run_reduced_model
from validation.reference import Progress, ReferenceReader

REFERENCES: dict[str, ReferenceReader] = {"febio": read_febio}
WORKERS = 2  # variants at once: mapping and stepping release the interpreter's lock


class _StoppedError(Exception):
    """Another variant failed, or the user interrupted: give up quietly."""


@dataclass
class Watch:
    """Progress display and wall times of a comparison's steps."""

    display: Display
    stop: threading.Event = field(default_factory=threading.Event)
    wall_times: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def step(self, name: str) -> Iterator[Progress]:
        """Time one step under ``name`` and show how far it is."""
        task = self.display.add_task(name, total=None)
        begin = time.perf_counter()

        def update(done: float, total: float) -> None:
            if self.stop.is_set():
                raise _StoppedError
            self.display.update(task, completed=done, total=total)

        yield update
        self.wall_times[name] = round(time.perf_counter() - begin, 3)
        self.display.update(task, completed=1, total=1)


@contextmanager
def watching() -> Iterator[Watch]:
    """Show progress on standard error if it is a terminal, nothing otherwise."""
    console = Console(stderr=True)
    with Display(console=console, transient=True, disable=not console.is_terminal) as display:
        yield Watch(display)


def run_variant(name: str, case: Case, watch: Watch) -> VariantRun:
    """Map the reference of one variant, then run the reduced model.

    Raises
    ------
    ValidationError
        If the case states no reference; else as the reader and the solver raise.
    """
    if case.reference is None:
        raise ValidationError(f"variant {name!r} states no reference")
    grid = grid_of(case)
    points = rays(grid.x, grid.phi)
    with watch.step(f"{name}: 3D onto cells") as progress:
        reference = REFERENCES[case.reference.kind](case, points, progress)
    with watch.step(f"{name}: reduced model") as progress:
        try:
            rom = run_reduced_model(case, reference.alignment, points, progress)
        except SolverError as error:
            raise ValidationError(f"variant {name!r}: {error}") from error
    return VariantRun(case, rom, reference)


def run_variants(cases: Mapping[str, Case], watch: Watch) -> dict[str, VariantRun]:
    """Run all variants, two at a time; the first error stops the others and is raised."""
    with ThreadPoolExecutor(max_workers=WORKERS) as pool:
        futures = {name: pool.submit(run_variant, name, case, watch) for name, case in cases.items()}
        try:
            wait(futures.values(), return_when=FIRST_EXCEPTION)
            failed = [future for future in futures.values() if future.done() and future.exception()]
            for future in failed:
                future.result()
            return {name: future.result() for name, future in futures.items()}
        finally:
            watch.stop.set()
            pool.shutdown(wait=False, cancel_futures=True)
