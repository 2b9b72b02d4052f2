"""Where samples are run: processes or threads of this machine, or a scheduler that is there already."""

import logging
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import dask
from distributed import Client, LocalCluster

from validation.errors import ValidationError
from validation.runs.sources import code_digest
from validation.sweep.forks import METHOD, OF_WORKERS, import_ahead

PROCESSES, THREADS = "processes", "threads"
CONNECT_WITHIN = "10s"
CLOSE_WITHIN = 5.0  # s
# for each worker process: a terminal sends Ctrl-C to it too, but its cluster is to end it, and what tornado
# says of a heartbeat that this cuts short is no user's matter
IN_WORKERS = """
import logging, signal
signal.signal(signal.SIGINT, signal.SIG_IGN)
logging.getLogger("tornado.application").setLevel(logging.CRITICAL)
"""
SETTINGS = {
    "distributed.worker.multiprocessing-method": METHOD,
    "distributed.nanny.pre-spawn-environ": OF_WORKERS,
    "distributed.scheduler.allowed-failures": 3,  # workers that may die with one task
    "distributed.admin.large-graph-warning-threshold": "1GiB",  # a reference travels once
    "distributed.comm.retry.count": 2,
    "distributed.comm.timeouts.connect": CONNECT_WITHIN,  # a worker that died does not answer
    "distributed.worker.profile.enabled": False,  # it would take a share of every sample
}


@contextmanager
def connected(scheduler: str, workers: int, tell: Callable[[str], None]) -> Iterator[Client]:
    """Connect to a scheduler.

    Parameters
    ----------
    scheduler : str
        ``processes`` or ``threads`` of this machine, or the address of a scheduler.
    workers : int
        Processes or threads.
    tell : callable
        Takes what a user should know meanwhile.

    Raises
    ------
    ValidationError
        If no scheduler answers at an address, or its workers have another version of this program.
    """
    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # what it reports is told by the sweep itself
    with dask.config.set(SETTINGS), warnings.catch_warnings():
        warnings.filterwarnings("ignore", module="distributed")
        if scheduler in (PROCESSES, THREADS):
            with _local(scheduler, workers) as cluster, Client(cluster) as client:
                yield client
        else:
            with _at(scheduler) as client:
                _check_workers(client, scheduler, tell)
                yield client


@contextmanager
def _local(kind: str, workers: int) -> Iterator[LocalCluster]:
    if kind == PROCESSES:
        import_ahead()
    own = {"n_workers": workers, "threads_per_worker": 1}
    shared = {"n_workers": 1, "threads_per_worker": workers}
    cluster = LocalCluster(
        processes=kind == PROCESSES,
        dashboard_address=None,
        silence_logs=logging.CRITICAL,
        preload=[IN_WORKERS] if kind == PROCESSES else [],
        **(own if kind == PROCESSES else shared),
    )
    try:
        yield cluster
    finally:
        cluster.close(timeout=CLOSE_WITHIN)


@contextmanager
def _at(address: str) -> Iterator[Client]:
    try:
        client = Client(address, timeout=CONNECT_WITHIN)
    except (OSError, ValueError) as error:
        raise ValidationError(f"--scheduler {address}: no scheduler answers: {error}") from error
    with client:
        yield client


def _check_workers(client: Client, address: str, tell: Callable[[str], None]) -> None:
    """Refuse workers that would compute other numbers."""
    if not client.scheduler_info()["workers"]:
        tell(f"{address}: waiting for a worker")
    client.wait_for_workers(1)
    for worker, found in client.run(code_digest, "sweep", on_error="return").items():
        if isinstance(found, BaseException):
            raise ValidationError(
                f"{address}: worker {worker} cannot run samples: {type(found).__name__}: {found}"
            )
        if found != code_digest("sweep"):
            raise ValidationError(
                f"{address}: worker {worker} has another version of this program or of its libraries"
            )
