"""Many cases in one call: threads that advance whole runs side by side inside the kernels.

The kernels take all steps between two saved instants in one call and hold no lock of Python's meanwhile, so
that threads compute side by side. A case that fails ends alone.

A run here takes the same steps as :func:`solver.case.run.run_case` and gives the same bits, with one
exception: where rows stand for others (:mod:`solver.geometry.symmetry`), it differs by round-off.
"""

import os
import threading
import time
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

from cases.arrays import Floats
from cases.sections.case import Case
from solver.case.model import model_of
from solver.case.plain_run import is_plain, plain_states
from solver.case.run import walk
from solver.errors import ModelError, SolverError
from solver.geometry.symmetry import all_rows, fewer_rows
from solver.marching.semi_implicit import Progress, checked_times
from solver.marching.walk import history_of
from solver.model.parameters import Model
from solver.runs.result import CellHistory

T = TypeVar("T")
Keep = Callable[[Model, CellHistory], T]


@dataclass(frozen=True)
class Outcome(Generic[T]):
    """What became of one case.

    Attributes
    ----------
    kept : object or None
        What ``keep`` made of its states; None where it failed.
    error : SolverError or None
        What stopped it.
    cpu_s : float
        Processor seconds of its thread: model, steady start, run and ``keep``.
    """

    kept: T | None
    error: SolverError | None
    cpu_s: float


class _StoppedError(Exception):
    """The user interrupted the batch: give up quietly."""


def available_threads() -> int:
    """Processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def run_batch(
    cases: Sequence[Case],
    times: Floats | Sequence[Floats],
    keep: Keep[T],
    threads: int | None = None,
    progress: Progress | None = None,
    every_row: bool = True,
) -> list[Outcome[T]]:
    """Run cases side by side, each through its output times.

    Parameters
    ----------
    cases : sequence of Case
        They may differ in everything, grid and scheme included.
    times : ndarray (n_times,), or a sequence of such, one for each case
        Increasing, s; a step ends on each.
    keep : callable
        Makes of a model and its states what is to be kept; called once a case, in the case's thread. The
        states are released after it. ``solver.runs.result.cell_dataset`` keeps all fields. Diagnostics are
        evaluated only where the case states ``solver.limits`` or ``error_tolerance``, or scheme godunov.
    threads : int, optional
        Default: one for each processor that this process may use.
    progress : callable, optional
        Called with (cases done, cases in all) after each case, in the calling thread.
    every_row : bool, optional
        Whether ``keep`` is given all rows of the case; else only those that were computed, with a model of
        them, where others are alike or their mirror images.

    Returns
    -------
    list of Outcome
        In the order of the cases.

    Raises
    ------
    ModelError
        For times that do not increase, or not as many as cases.
    """
    instants = _times_of(cases, times)
    stop = threading.Event()
    workers = threads or available_threads()
    pool = ThreadPoolExecutor(max_workers=max(1, min(workers, len(cases))))
    try:
        futures = [
            pool.submit(_outcome, case, each, keep, stop, every_row)
            for case, each in zip(cases, instants, strict=True)
        ]
        _report(futures, progress)
        return [future.result() for future in futures]
    finally:
        stop.set()
        pool.shutdown(wait=True, cancel_futures=True)


def _times_of(cases: Sequence[Case], times: Floats | Sequence[Floats]) -> list[Floats]:
    """Output times of each case."""
    shared = isinstance(times, np.ndarray) and times.ndim == 1
    each = [times] * len(cases) if shared else list(times)
    if len(each) != len(cases):
        raise ModelError(
            f"output times of {len(each)} cases; allowed: one array, or one for each of {len(cases)}"
        )
    return [checked_times(own, case.solver.time_step) for own, case in zip(each, cases, strict=True)]


def _report(futures: list[Future[Outcome[T]]], progress: Progress | None) -> None:
    """Tell how many cases are done, until all are, or one raises what is no failure of a run."""
    pending = set(futures)
    while pending:
        done, pending = wait(pending, return_when=FIRST_COMPLETED)
        for future in done:
            future.result()
        if progress:
            progress(float(len(futures) - len(pending)), float(len(futures)))


def _outcome(case: Case, times: Floats, keep: Keep[T], stop: threading.Event, every_row: bool) -> Outcome[T]:
    """Run one case; its failure is what became of it."""
    begin = time.thread_time()
    try:
        model = model_of(case)
        computed = fewer_rows(model) if is_plain(case) else model
        cells = _states(case, computed, times, stop)
        whole = (model, _in_all_rows(cells, model.grid.n_phi)) if every_row else (computed, cells)
        kept = keep(*whole)
    except SolverError as error:
        return Outcome(None, error, time.thread_time() - begin)
    return Outcome(kept, None, time.thread_time() - begin)


def _in_all_rows(cells: CellHistory, n_phi: int) -> CellHistory:
    """States of a model's fewer rows in all its ``n_phi`` rows."""
    area, flow, pressure, exponent = (
        all_rows(values, n_phi) for values in (cells.area, cells.flow, cells.pressure, cells.exponent)
    )
    return cells._replace(area=area, flow=flow, pressure=pressure, exponent=exponent)


def _states(case: Case, model: Model, times: Floats, stop: threading.Event) -> CellHistory:
    """States of a case at its output times."""

    def reached() -> None:
        if stop.is_set():
            raise _StoppedError

    if is_plain(case):
        return plain_states(case, model, times, reached)
    stops = []
    for each in walk(case, model, times):
        stops.append(each)
        reached()
    return history_of(stops)
