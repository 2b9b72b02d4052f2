"""What goes wrong with a case file: one error family, one clear line for each problem."""

from dataclasses import dataclass
from pathlib import Path

from cases.shell.errors import InputError


class CaseError(InputError, ValueError):
    """The input is wrong; the message says where, what was found and what is allowed."""


class QuantityError(CaseError):
    """A text is not a quantity of the expected dimension; the message is the reason alone."""


class UnreadableFileError(CaseError):
    """A file cannot be read; the message is the reason alone."""


class ColumnFileError(CaseError):
    """A waveform or a wall curve cannot be read from its file."""


class RefusedValueError(CaseError):
    """A value breaks a rule of the schema.

    Attributes
    ----------
    key : tuple of str or int
        Where the offending value stands below the value that was checked; empty if it is that value.
    """

    def __init__(self, message: str, key: tuple[str | int, ...] = ()) -> None:
        super().__init__(message)
        self.key = key


@dataclass(frozen=True)
class Problem:
    """One problem of a case file: the line and the key where it stands, and what is wrong."""

    line: int
    key: str
    message: str


class CaseFileError(CaseError):
    """A case file cannot be used.

    Attributes
    ----------
    path : pathlib.Path
        The case file, as it was given.
    problems : tuple of Problem
        All problems that were found, in the file's order; empty if the file could not be read.
    """

    def __init__(self, path: Path, message: str, problems: tuple[Problem, ...] = ()) -> None:
        super().__init__(message)
        self.path = path
        self.problems = problems

    @classmethod
    def of_problems(cls, path: Path, problems: list[Problem]) -> "CaseFileError":
        """Join problems, a line each and none twice, in the order of the file's lines."""
        ordered = tuple(sorted(dict.fromkeys(problems), key=lambda problem: problem.line))
        lines = (f"{path}, line {p.line}: {p.key}: {p.message}" for p in ordered)
        return cls(path, "\n".join(lines), ordered)
