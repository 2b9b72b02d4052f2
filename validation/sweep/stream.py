"""Chunks of samples through a scheduler: a bounded number at a time, each result as soon as it is there."""

import time
from collections.abc import Callable, Iterable, Iterator
from typing import TypeAlias

from distributed import CancelledError, Client, Future, KilledWorker, wait

from validation.errors import ValidationError
from validation.sweep.chunk import Plan, Record, failed, run_chunk
from validation.sweep.samples import Sample

IN_FLIGHT = 3  # chunks for each thread of the workers: what is computed, and what waits for it
LOOK_EVERY = 2.0  # s
WITHOUT_WORKERS = 10.0  # s after which a local cluster that lost all its workers is given new ones
LOST = "the scheduler was lost; what is done is kept, and the same command goes on"

Chunk = tuple[int, list[Sample]]
Records: TypeAlias = "Future[list[Record]]"
SamePlan: TypeAlias = "Future[Plan]"
Run = Callable[[list[Sample], Plan], list[Record]]


def computed(
    client: Client, chunks: Iterable[Chunk], plan: Plan, run: Run = run_chunk
) -> Iterator[tuple[int, list[Record]]]:
    """Yield the records of each chunk with its number, in the order in which they are finished.

    A task whose worker dies is repeated; where workers die again and again its samples are run one by one,
    and that with which they die is recorded as failed.

    Raises
    ------
    ValidationError
        If the scheduler is lost.
    """
    kept = client.submit(_itself, plan, pure=False)  # a task, so that it is made again if its worker dies
    waiting = iter(chunks)
    running: dict[Records, Chunk] = {}

    def begin(count: int) -> None:
        for _, chunk in zip(range(count), waiting, strict=False):
            running[client.submit(run, chunk[1], kept, pure=False)] = chunk

    begin(IN_FLIGHT * max(1, sum(client.nthreads().values())))
    while running:
        for future in _finished(client, list(running)):
            number, samples = running.pop(future)
            yield number, _records(client, future, samples, plan, kept, run)
            begin(1)


def _finished(client: Client, futures: list[Records]) -> list[Records]:
    """Wait until one task or more has ended, however it did; start workers anew where none is left."""
    alone_since = time.monotonic()
    while True:
        try:
            return list(wait(futures, timeout=LOOK_EVERY, return_when="FIRST_COMPLETED").done)
        except TimeoutError:
            now = time.monotonic()
            if client.cluster is None or client.scheduler_info()["workers"]:
                alone_since = now
            elif now - alone_since > WITHOUT_WORKERS:
                workers = len(client.cluster.worker_spec)
                client.cluster.scale(0)
                client.cluster.scale(workers)
                alone_since = now
        except CancelledError as error:
            raise ValidationError(LOST) from error


def _records(
    client: Client, future: Records, samples: list[Sample], plan: Plan, kept: SamePlan, run: Run
) -> list[Record]:
    """Return the records of a finished chunk; of one that cannot be run whole, sample by sample."""
    if future.status == "finished":
        return list(future.result())
    if len(samples) == 1:
        return [failed(samples[0], plan, _words(future.exception()))]
    records = []
    for sample in samples:
        (alone,) = _finished(client, [client.submit(run, [sample], kept, pure=False)])
        records += _records(client, alone, [sample], plan, kept, run)
    return records


def _words(error: BaseException | None) -> str:
    if isinstance(error, KilledWorker):
        return "the workers that ran it died (out of memory?)"
    return f"{type(error).__name__}: {error}"


def _itself(plan: Plan) -> Plan:
    return plan
