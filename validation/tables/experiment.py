"""What an experiment is: entries that compute numbers, and rows that hold them against the thesis's."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

Number = float | None  # None where a run has no result, such as the Courant number of one that blew up
Result = dict[str, Number | list[Number]]
Results = Mapping[str, Result]


@dataclass(frozen=True)
class Entry:
    """One computation whose result is kept.

    Attributes
    ----------
    name : str
        Unique among all experiments; also the name of its file.
    compute : callable
        Returns numbers by name.
    quick : bool
        Whether it belongs to the quick subset.
    """

    name: str
    compute: Callable[[], Result]
    quick: bool


@dataclass(frozen=True)
class Check:
    """One number beside the thesis's.

    Attributes
    ----------
    case, quantity, unit : str
        What it is.
    ours : float
    thesis : float or None
        None for a property that the thesis states in words.
    low, high : float
        Range in which ``ours`` must lie.
    """

    case: str
    quantity: str
    unit: str
    ours: float
    thesis: float | None
    low: float
    high: float

    @property
    def met(self) -> bool:
        """Whether the tolerance is met."""
        return self.low <= self.ours <= self.high

    @property
    def difference(self) -> float | None:
        """Relative difference from the thesis."""
        return None if self.thesis is None else self.ours / self.thesis - 1


@dataclass(frozen=True)
class Experiment:
    """One table, figure or sentence of the thesis.

    Attributes
    ----------
    name, title : str
        How the user calls it and what it is.
    entries : sequence of Entry
    rows : callable
        Rows of the results at hand, by entry name.
    draw : callable or None
        Draws its figures of the results at hand into a folder; returns their paths.
    """

    name: str
    title: str
    entries: Sequence[Entry]
    rows: Callable[[Results], list[Check]]
    draw: Callable[[Results, Path], list[Path]] | None = None


def within(
    case: str, quantity: str, unit: str, ours: float, thesis: float, tolerance: float, rounding: float = 0.0
) -> Check:
    """Check with a relative tolerance beyond the rounding of what is printed."""
    allowed = tolerance * abs(thesis) + rounding
    return Check(case, quantity, unit, ours, thesis, thesis - allowed, thesis + allowed)


def number(result: Result, name: str) -> float:
    """Return one number of a result.

    Raises
    ------
    TypeError
        If the result holds a list or nothing under this name.
    """
    value = result[name]
    if not isinstance(value, int | float):
        raise TypeError(f"{name} is {value!r}, not a number")
    return float(value)


def numbers(result: Result, name: str) -> list[Number]:
    """Return a list of numbers of a result.

    Raises
    ------
    TypeError
        If the result holds something else under this name.
    """
    value = result[name]
    if not isinstance(value, list):
        raise TypeError(f"{name} is {value!r}, not a list")
    return value
