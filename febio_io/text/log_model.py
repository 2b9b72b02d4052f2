"""What a log tells of a run: inputs, time steps, messages, cost, and how it ended."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from febio_io.errors import FebioKeyError
from febio_io.text.data_records import DataRecord, make_record
from febio_io.text.record_blocks import Block, add_row

if TYPE_CHECKING:
    import pandas as pd

Outcome = Literal["converged", "failed", "unfinished"]
MessageKind = Literal["warning", "error", "info"]
Termination = Literal["normal", "error", "none"]


@dataclass(frozen=True)
class Norm:
    """One convergence norm, squared as FEBio prints it: at the start of the step, now, and as required."""

    initial: float
    current: float
    required: float


@dataclass(frozen=True)
class Iteration:
    """One equilibrium iteration.

    Attributes
    ----------
    number : int
        Number in the time step, from 1.
    time : float
        Time of the step.
    stiffness_updates, right_hand_sides, reformations : int or None
        Counts since the start of the step, as FEBio prints them.
    line_search_step : float or None
        Step length that the line search chose.
    norms : mapping of str to Norm
        Norms by FEBio's names: "residual", "energy", "displacement" …
    """

    number: int
    time: float
    stiffness_updates: int | None
    right_hand_sides: int | None
    reformations: int | None
    line_search_step: float | None
    norms: Mapping[str, Norm]


@dataclass(frozen=True)
class TimeStep:
    """One attempt at a time step.

    Attributes
    ----------
    analysis_step : int
        Number of the analysis step, from 1.
    number : int
        Number of the time step in it, from 1.
    attempt : int
        1, or more where the step is tried again.
    time : float
        The time aimed at.
    outcome : {"converged", "failed", "unfinished"}
        "unfinished" where the log says neither.
    n_iterations : int
        Equilibrium iterations, also where the log does not show them.
    n_reformations : int or None
        Reformations of the stiffness matrix, where the log tells.
    n_augmentations : int
        Augmentations.
    iterations : tuple of Iteration
        The iterations that the log shows.
    line : int
        Line of the log where the attempt starts.
    """

    analysis_step: int
    number: int
    attempt: int
    time: float
    outcome: Outcome
    n_iterations: int
    n_reformations: int | None
    n_augmentations: int
    iterations: tuple[Iteration, ...]
    line: int


@dataclass(frozen=True)
class Message:
    """One boxed message: its kind, its text, and the line of the log where the box starts."""

    kind: MessageKind
    text: str
    line: int


@dataclass(frozen=True)
class Input:
    """One echoed input: section, what in it (e.g. a material; may be empty), name, value, and line."""

    section: str
    item: str
    name: str
    value: str
    line: int


@dataclass(frozen=True)
class RecordLines:
    """The notes of one data record in the log, with its lines unless these are in a separate file.

    Attributes
    ----------
    number : int
        1-based place of the record in the model.
    name : str
        Its name, or the list of its data where it has none.
    file : str or None
        Name of the separate file.
    blocks : tuple of (Block, tuple of (int, str))
        Each note's header, and the numbered lines of values that follow it.
    """

    number: int
    name: str
    file: str | None
    blocks: tuple[tuple[Block, tuple[tuple[int, str], ...]], ...]


@dataclass(frozen=True, eq=False)
class Log:
    """What a log file tells of a run.

    Attributes
    ----------
    path : Path
        The file.
    version : str
        Version of FEBio; empty where the file does not say.
    files : dict of str to str
        Names of the run's files: "Input file", "Plot file", "Log file".
    inputs : tuple of Input
        The model as FEBio echoes it; wording and order depend on FEBio's version.
    time_steps : tuple of TimeStep
        All attempts at time steps.
    messages : tuple of Message
        Warnings, errors and other boxed messages.
    n_equations, n_nonzeros : int or None
        Size of the last stiffness matrix.
    totals : tuple of dict
        Of each analysis step, the totals that FEBio prints at its end.
    timings : dict of str to float
        Seconds, by FEBio's labels: "Solve time", "Total elapsed time" …
    peak_memory : float or None
        Megabytes, where the log tells (Windows).
    termination : {"normal", "error", "none"}
        How the run ended; "none": it was killed, crashed or is still running.
    records : tuple of RecordLines
        The data records.
    """

    path: Path
    version: str
    files: dict[str, str]
    inputs: tuple[Input, ...]
    time_steps: tuple[TimeStep, ...]
    messages: tuple[Message, ...]
    n_equations: int | None
    n_nonzeros: int | None
    totals: tuple[dict[str, float], ...]
    timings: dict[str, float]
    peak_memory: float | None
    termination: Termination
    records: tuple[RecordLines, ...]

    @property
    def warnings(self) -> tuple[Message, ...]:
        """The warnings."""
        return tuple(message for message in self.messages if message.kind == "warning")

    @property
    def errors(self) -> tuple[Message, ...]:
        """The errors."""
        return tuple(message for message in self.messages if message.kind == "error")

    @property
    def elapsed(self) -> float | None:
        """Seconds that the whole run took; None where the log does not tell."""
        return self.timings.get("Total elapsed time")

    @property
    def n_converged(self) -> int:
        """Time steps that converged."""
        return sum(step.outcome == "converged" for step in self.time_steps)

    @property
    def n_retries(self) -> int:
        """Attempts at time steps that had failed before."""
        return sum(step.attempt > 1 for step in self.time_steps)

    @property
    def n_iterations(self) -> int:
        """Equilibrium iterations of all attempts."""
        return sum(step.n_iterations for step in self.time_steps)

    def steps_table(self) -> pd.DataFrame:
        """Give one row for each attempt at a time step, without its iterations."""
        import pandas as pd

        columns = [name for name in TimeStep.__dataclass_fields__ if name != "iterations"]
        return pd.DataFrame(
            [[getattr(step, name) for name in columns] for step in self.time_steps], columns=columns
        )

    def data_record(self, number: int, *, columns: tuple[str, ...] | None = None) -> DataRecord:
        """Read the values of a data record that are in the log itself.

        Parameters
        ----------
        number : int
            1-based place of the record in the model.
        columns : tuple of str, optional
            Names of the values, where the record has a name of its own.

        Returns
        -------
        DataRecord
            The record.

        Raises
        ------
        FebioKeyError
            If there is no such record, or its values are in a separate file.
        FebioFormatError
            If a line is not an item with its values. In the log, FEBio cuts lines of more than 2047
            characters.
        """
        by_number = {record.number: record for record in self.records}
        if number not in by_number:
            known = ", ".join(map(str, by_number)) or "none"
            raise FebioKeyError(f"{self.path}: no data record {number}; the log has {known}")
        record = by_number[number]
        if record.file is not None:
            raise FebioKeyError(f"{self.path}: the values of data record {number} are in {record.file}")
        blocks: list[Block] = []
        for header, lines in record.blocks:
            block = Block(header.line, header.step, header.time, header.name)
            block.positional = blocks[-1].positional if blocks else None
            for line, text in lines:
                add_row(self.path, block, line, text)
            blocks.append(block)
        return make_record(self.path, blocks, cut="", columns=columns)
