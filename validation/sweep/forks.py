"""The process of which the workers of a sweep are forks: what they import is imported once, and at once.

A worker that takes the place of another is there at once too, and all share the memory of what is imported.
"""

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing import forkserver, get_all_start_methods, resource_tracker

LIBRARIES_WITH_THREADS = ("OMP", "OPENBLAS", "MKL", "NUMBA")
ONE_THREAD = {f"{name}_NUM_THREADS": "1" for name in LIBRARIES_WITH_THREADS}
# of a worker, which makes and drops the same arrays for each sample: it keeps their memory
KEPT_MEMORY = {
    "MALLOC_ARENA_MAX": "1",
    "MALLOC_MMAP_THRESHOLD_": str(32 * 2**20),
    "MALLOC_TRIM_THRESHOLD_": str(256 * 2**20),
}
OF_WORKERS = ONE_THREAD | KEPT_MEMORY
FORKED = "forkserver"
METHOD = FORKED if FORKED in get_all_start_methods() else "spawn"
IMPORTED = ["distributed", "validation.sweep.chunk"]


@contextmanager
def surroundings() -> Iterator[None]:
    """State to what starts in a block that it runs in one thread and keeps memory: libraries read it."""
    own = {name: os.environ.get(name) for name in OF_WORKERS}
    os.environ.update(OF_WORKERS)
    try:
        yield
    finally:
        for name, value in own.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def import_ahead() -> None:
    """Start that process, where the system has forks; it imports while the caller goes on."""
    if METHOD != FORKED:
        return
    forkserver.set_forkserver_preload(IMPORTED)
    # a terminal sends Ctrl-C to that process too: it inherits that it is blocked
    resource_tracker.ensure_running()  # which would end that
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # inherited
    try:
        with surroundings():
            forkserver.ensure_running()
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
