"""What has been read of a log, and where in it the reader is."""

from dataclasses import dataclass, field
from pathlib import Path

from febio_io.text.log_model import (
    Input,
    Iteration,
    Log,
    Message,
    Norm,
    Outcome,
    RecordLines,
    Termination,
    TimeStep,
)
from febio_io.text.record_blocks import Block


@dataclass
class Attempt:
    """An attempt at a time step, as far as it has been read; see :class:`TimeStep`."""

    analysis_step: int
    number: int
    attempt: int
    time: float
    line: int
    outcome: Outcome = "unfinished"
    n_iterations: int = 0
    n_reformations: int | None = None
    n_augmentations: int = 0
    iterations: list[Iteration] = field(default_factory=list)


@dataclass
class State:
    """What has been read, and where in the log the reader is."""

    version: str = ""
    section: str = ""
    item: list[tuple[int, str]] = field(default_factory=list)
    previous: str = ""
    files: dict[str, str] = field(default_factory=dict)
    inputs: list[Input] = field(default_factory=list)
    attempts: list[Attempt] = field(default_factory=list)
    step_ended: bool = False
    retry: bool = False
    messages: list[Message] = field(default_factory=list)
    box: list[tuple[int, str]] | None = None
    matrix: dict[str, int] = field(default_factory=dict)
    totals: list[dict[str, float]] = field(default_factory=list)
    timings: dict[str, float] = field(default_factory=dict)
    old_timings: dict[str, float] = field(default_factory=dict)
    peak_memory: float | None = None
    termination: Termination = "none"
    records: dict[int, list[tuple[Block, list[tuple[int, str]]]]] = field(default_factory=dict)
    record_files: dict[int, str] = field(default_factory=dict)
    record: int | None = None
    pending: dict[str, float] = field(default_factory=dict)
    norms: dict[str, Norm] = field(default_factory=dict)


def end_iteration(state: State) -> None:
    """Put together the iteration that was being read; one that the log only counts is not shown."""
    pending, norms = state.pending, state.norms
    state.pending, state.norms = {}, {}
    if not state.attempts or "number" not in pending:
        return
    attempt = state.attempts[-1]
    attempt.n_iterations = max(attempt.n_iterations, int(pending["number"]))
    if "time" in pending:
        attempt.iterations.append(
            Iteration(
                int(pending["number"]),
                pending["time"],
                _count(pending, "stiffness_updates"),
                _count(pending, "right_hand_sides"),
                _count(pending, "reformations"),
                pending.get("line_search_step"),
                norms,
            )
        )


def _count(pending: dict[str, float], name: str) -> int | None:
    value = pending.get(name)
    return int(value) if value is not None and abs(value) < float("inf") else None


def log_of(state: State, path: Path) -> Log:
    """Give what has been read."""
    return Log(
        path=path,
        version=state.version,
        files=state.files,
        inputs=tuple(state.inputs),
        time_steps=tuple(_finished(attempt) for attempt in state.attempts),
        messages=tuple(state.messages),
        n_equations=state.matrix.get("n_equations"),
        n_nonzeros=state.matrix.get("n_nonzeros"),
        totals=tuple(state.totals),
        timings=state.timings or state.old_timings,
        peak_memory=state.peak_memory,
        termination=state.termination,
        records=tuple(_record(state, number) for number in state.records),
    )


def _finished(attempt: Attempt) -> TimeStep:
    return TimeStep(
        attempt.analysis_step,
        attempt.number,
        attempt.attempt,
        attempt.time,
        attempt.outcome,
        max(attempt.n_iterations, len(attempt.iterations)),
        attempt.n_reformations,
        attempt.n_augmentations,
        tuple(attempt.iterations),
        attempt.line,
    )


def _record(state: State, number: int) -> RecordLines:
    blocks = state.records[number]
    name = next((block.name for block, _ in blocks if block.name), "")
    return RecordLines(
        number, name, state.record_files.get(number), tuple((block, tuple(lines)) for block, lines in blocks)
    )
