"""Run every variant of a case: its reference onto the cells, and the reduced model at its instants."""

import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from rich.progress import Progress as Display

from cases.reading.models import labelled
from cases.sections.case import Case
from cases.sections.inlet import ReferenceInlet
from cases.shell.terminal import progress
from solver.case.model import grid_of
from solver.errors import SolverError
from validation.compare.budget.sources import CoarserMeshes, Sources, sources_of
from validation.compare.comparison import VariantRun
from validation.errors import ValidationError
from validation.mapping.rays import Rays, rays
from validation.reference.alignment import Alignment
from validation.reference.kind import Progress, Reference
from validation.reference.kinds import kind_of
from validation.runs.cache import Cache
from validation.runs.cached import cached_alignment, cached_reference, cached_rom
from validation.runs.matched_inflow import with_inflow_of
from validation.runs.reduced_model import ReducedModelRun

WORKERS = 2  # computations at once: mapping and stepping release the interpreter's lock
AT_ONCE = 2  # variants that are computed


class _StoppedError(Exception):
    """Another variant failed, or the user interrupted: give up quietly."""


@dataclass
class Watch:
    """Progress display, cache, wall times and remarks of a comparison's steps."""

    display: Display
    cache: Cache | None = None
    stop: threading.Event = field(default_factory=threading.Event)
    remarks: list[str] = field(default_factory=list)
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
        passed = self.wall_times.get(name, 0.0) + time.perf_counter() - begin
        self.wall_times[name] = round(passed, 3)
        self.display.update(task, completed=1, total=1)


@contextmanager
def watching(cache: Cache | None = None) -> Iterator[Watch]:
    """Show progress on standard error if it is a terminal, nothing otherwise."""
    with progress() as display:
        yield Watch(display, cache)


def align_variants(cases: Mapping[str, Case], watch: Watch) -> dict[str, Alignment]:
    """Instants of every variant's reference.

    Raises
    ------
    ValidationError
        If a case states no reference; else as the kind of reference raises.
    """
    return {name: _alignment(name, case, watch) for name, case in cases.items()}


@dataclass
class _Started:
    """Computations of one variant; those of a model under its name."""

    reference: Future[Reference]
    roms: dict[str, Future[ReducedModelRun]]
    sources: dict[str, Future[Sources | None]]

    @property
    def futures(self) -> list[Future[Any]]:
        return [self.reference, *self.roms.values(), *self.sources.values()]

    def runs(self, cases: Mapping[str, Case]) -> dict[str, VariantRun]:
        """Return what each model gave."""
        return {
            model: VariantRun(
                case, self.roms[model].result(), self.reference.result(), self.sources[model].result()
            )
            for model, case in cases.items()
        }


def run_variants(
    models: Mapping[str, Mapping[str, Case]],
    alignments: Mapping[str, Alignment],
    watch: Watch,
    meanwhile: Callable[[], None] = lambda: None,
) -> Iterator[tuple[str, dict[str, VariantRun]]]:
    """Map all references and run the reduced models, two at a time, and give each variant as it is done.

    A variant comes with its runs by model, which share its reference. The order of variants may be any. The
    first error stops the others and is raised. No more than two variants are in memory but for the one that
    is looked at: the next one is begun when that is done with.

    Parameters
    ----------
    models : mapping
        By model and variant.
    alignments : mapping
        By variant.
    watch : Watch
    meanwhile : callable, optional
        Called here once while others compute.

    Raises
    ------
    ValidationError
        As the kind of reference and the solver raise.
    """
    pool = ThreadPoolExecutor(max_workers=WORKERS)
    names = list(next(iter(models.values())))
    by_variant = {name: {model: models[model][name] for model in models} for name in names}

    def start(some: list[str]) -> dict[str, _Started]:
        return _started(pool, {name: by_variant[name] for name in some}, alignments, watch)

    try:
        running, waiting = start(names[:AT_ONCE]), names[AT_ONCE:]
        meanwhile()
        while running:
            name = _first_done(running)
            yield name, running.pop(name).runs(by_variant[name])
            running |= start(waiting[:1])
            waiting = waiting[1:]
    finally:
        watch.stop.set()
        pool.shutdown(wait=False, cancel_futures=True)


def _started(
    pool: ThreadPoolExecutor,
    variants: Mapping[str, Mapping[str, Case]],
    alignments: Mapping[str, Alignment],
    watch: Watch,
) -> dict[str, _Started]:
    """Put the computations of variants into the queue.

    References take longest, so they go first and the short runs fill what processor is left over.
    """
    started = {}
    for name, cases in variants.items():
        reference = pool.submit(_reference, name, next(iter(cases.values())), alignments[name], watch)
        started[name] = _Started(reference, {}, {})
    for name, cases in variants.items():
        for model, case in cases.items():
            label = labelled(name, model, cases)
            started[name].roms[model] = pool.submit(_reduced_model, label, case, alignments[name], watch)
    for name, cases in variants.items():
        meshes = CoarserMeshes()
        for model, case in cases.items():
            both = (started[name].roms[model], started[name].reference)
            label = labelled(name, model, cases)
            started[name].sources[model] = pool.submit(_sources, label, case, both, meshes, watch)
    return started


def _first_done(running: Mapping[str, _Started]) -> str:
    """Name of a variant all of whose computations have ended well; the first that fails is raised."""
    of_variant = {future: name for name, started in running.items() for future in started.futures}
    left = Counter(of_variant.values())
    for future in as_completed(of_variant):
        future.result()
        left[of_variant[future]] -= 1
        if not left[of_variant[future]]:
            return of_variant[future]
    raise ValueError("no variant is running")


def _alignment(name: str, case: Case, watch: Watch) -> Alignment:
    return cached_alignment(watch.cache, kind_of(name, case), case, watch.remarks.append)


def _reference(name: str, case: Case, alignment: Alignment, watch: Watch) -> Reference:
    """Map the reference of one variant."""
    with watch.step(f"{name}: 3D onto cells") as progress:
        kind = kind_of(name, case)
        return cached_reference(
            watch.cache, kind, case, _points(case), progress, alignment, watch.remarks.append
        )


def _reduced_model(name: str, case: Case, alignment: Alignment, watch: Watch) -> ReducedModelRun:
    """Run the reduced model of one variant at the instants of its reference."""
    with watch.step(f"{name}: reduced model") as progress:
        try:
            return cached_rom(watch.cache, case, alignment, _points(case), progress, watch.remarks.append)
        except SolverError as error:
            raise ValidationError(f"variant {name}: {error}") from error


def _sources(
    name: str,
    case: Case,
    models: tuple[Future[ReducedModelRun], Future[Reference]],
    meshes: CoarserMeshes,
    watch: Watch,
) -> Sources | None:
    """Further runs of one variant, once both its models are there: they are ahead of it in the queue."""
    rom, reference = models[0].result(), models[1].result()
    if reference.sparse:
        return None
    with watch.step(f"{name}: sources of errors") as progress:
        try:
            remark = watch.remarks.append
            return sources_of(name, case, (rom, reference), meshes, watch.cache, progress, remark)
        except SolverError as error:
            raise ValidationError(f"variant {name}: with the inflow of 3D: {error}") from error


def resolved(models: Mapping[str, Mapping[str, Case]], watch: Watch) -> dict[str, dict[str, Case]]:
    """Cases with ``inlet.kind: reference`` with the inflow of their reference instead, others as they are.

    Raises
    ------
    ValidationError
        If the reference tells no inflow; else as the kind of reference raises.
    """
    found = {model: dict(cases) for model, cases in models.items()}
    for name, case in next(iter(models.values())).items():
        if isinstance(case.inlet, ReferenceInlet):
            alignment = _alignment(name, case, watch)
            inlet = with_inflow_of(case, _reference(name, case, alignment, watch)).inlet
            compare = case.compare.model_copy(update={"matched_inflow": True})
            for cases in found.values():
                cases[name] = cases[name].model_copy(update={"inlet": inlet, "compare": compare})
    return found


def _points(case: Case) -> Rays:
    grid = grid_of(case)
    return rays(grid.x, grid.phi)
