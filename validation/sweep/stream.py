"""Chunks of samples through a scheduler: a bounded number at a time, each result as soon as it is there."""

from collections.abc import Callable, Iterable, Iterator
from typing import TypeAlias, TypeVar

from distributed import Client, Future, KilledWorker, as_completed

from validation.errors import ValidationError
from validation.sweep.chunk import Plan, Record, failed, run_chunk
from validation.sweep.samples import Sample

IN_FLIGHT = 3  # chunks for each thread of the workers: what is computed, and what waits for it
Chunk = tuple[int, list[Sample]]
Records: TypeAlias = "Future[list[Record]]"
SamePlan: TypeAlias = "Future[Plan]"
Run = Callable[[list[Sample], Plan], list[Record]]
T = TypeVar("T")


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
    running: dict[object, Chunk] = {}
    finished = as_completed(loop=client.loop)

    def begin(chunk: Chunk) -> None:
        future = client.submit(run, chunk[1], kept, pure=False)
        running[future.key] = chunk
        finished.add(future)

    for chunk in _first(waiting, IN_FLIGHT * max(1, sum(client.nthreads().values()))):
        begin(chunk)
    for future in finished:
        number, samples = running.pop(future.key)
        records = _records(client, future, samples, plan, kept, run)
        del future  # and with it what the workers keep of it
        yield number, records
        for chunk in _first(waiting, 1):
            begin(chunk)


def _first(items: Iterator[T], count: int) -> Iterator[T]:
    for _, item in zip(range(count), items, strict=False):
        yield item


def _records(
    client: Client, future: Records, samples: list[Sample], plan: Plan, kept: SamePlan, run: Run
) -> list[Record]:
    """Return the records of a finished chunk; of one that cannot be run whole, sample by sample."""
    if future.status == "finished":
        return list(future.result())
    if future.status in ("cancelled", "lost"):
        raise ValidationError("the scheduler was lost; what is done is kept, and the same command goes on")
    if len(samples) == 1:
        return [failed(samples[0], plan, _words(future.exception()))]
    return [
        record
        for sample in samples
        for record in _records(
            client, _done(client.submit(run, [sample], kept, pure=False)), [sample], plan, kept, run
        )
    ]


def _done(future: Records) -> Records:
    """Wait for a task, however it ends."""
    future.exception()
    return future


def _words(error: BaseException | None) -> str:
    if isinstance(error, KilledWorker):
        return "the workers that ran it died (out of memory?)"
    return f"{type(error).__name__}: {error}"


def _itself(plan: Plan) -> Plan:
    return plan
