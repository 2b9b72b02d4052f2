"""Waveforms: one cardiac cycle of an inlet quantity, read from a CSV file."""

from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cases.errors import QuantityError, WaveformError
from cases.units import parse_number
from cases.wording import but_allowed, choices, nearest, shown

# header name → factor to SI; decimal, so that 8.41199 cm/s is the float closest to 0.0841199
TIME_COLUMNS = {"t_s": Decimal(1), "t_ms": Decimal("0.001")}
VELOCITY_COLUMNS = {"mean_velocity_m_s": Decimal(1), "mean_velocity_cm_s": Decimal("0.01")}
FEWEST_ROWS = 3
CLOSURE = 1e-9


@dataclass(frozen=True, eq=False)
class Waveform:
    """One period of a quantity over time, to be repeated.

    Attributes
    ----------
    times : ndarray, shape (n,)
        Times in s, strictly increasing from 0; the last one is the period.
    values : ndarray, shape (n,)
        Values in SI units (mean velocity: m/s); the last one equals the first.
    period : float
        Period in s.
    path : pathlib.Path or None
        The file it was read from.
    """

    times: NDArray[np.float64]
    values: NDArray[np.float64]
    period: float
    path: Path | None = None

    def __eq__(self, other: object) -> bool:
        """Compare times and values, not where they were read from."""
        if not isinstance(other, Waveform):
            return NotImplemented
        return np.array_equal(self.times, other.times) and np.array_equal(self.values, other.values)

    def __hash__(self) -> int:
        """Agree with equality, so that cases can be dictionary keys."""
        return hash((self.times.tobytes(), self.values.tobytes()))


def read_waveform(path: Path, name: str | None = None) -> Waveform:
    """Read one period of mean velocity from a CSV file.

    The header names the columns with their units: a time (`t_s`, `t_ms`) and a mean velocity
    (`mean_velocity_m_s`, `mean_velocity_cm_s`). Lines that start with # are comments.

    Parameters
    ----------
    path : pathlib.Path
        The file.
    name : str, optional
        How messages call the file; its path by default.

    Returns
    -------
    Waveform
        SI values; its arrays are read-only.

    Raises
    ------
    WaveformError
        The file cannot be read, or is no closed waveform; with the line where one is to blame.
    """
    shown_name = name or str(path)
    try:
        lines = path.read_bytes().decode("utf-8-sig").splitlines()
    except OSError as error:
        raise WaveformError(f"{shown_name}: {error.strerror or error}") from error
    except UnicodeDecodeError as error:
        raise WaveformError(f"{shown_name}: not UTF-8 text") from error
    try:
        return _parse(lines, path)
    except WaveformError as error:
        raise WaveformError(f"{shown_name}{error}") from error


def _parse(lines: list[str], path: Path) -> Waveform:
    """Parse the lines of a file; messages start behind the file's name."""
    numbered = [
        (number, [cell.strip() for cell in line.split(",")])
        for number, line in enumerate(lines, start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not numbered:
        raise WaveformError(": empty; allowed: a header and rows of numbers")
    header, *rows = numbered
    factors = _factors(*header)
    if len(rows) < FEWEST_ROWS:
        raise WaveformError(f": {len(rows)} rows; allowed: {FEWEST_ROWS} or more")
    samples = np.array([_row(number, cells, header[1], factors) for number, cells in rows])
    _check_cycle(samples, [number for number, _ in rows])
    times, values = samples.T.copy()
    times.setflags(write=False)
    values.setflags(write=False)
    return Waveform(times, values, float(times[-1]), path)


def _factors(number: int, names: list[str]) -> tuple[Decimal, Decimal]:
    """Return the SI factors of the time and the velocity column."""
    known = TIME_COLUMNS | VELOCITY_COLUMNS
    for name in names:
        if name not in known:
            message = but_allowed(f"unknown column {shown(name)}{nearest(name, known)}", choices(known))
            raise WaveformError(f", line {number}: {message}")
    if len(names) != 2 or names[0] not in TIME_COLUMNS or names[1] not in VELOCITY_COLUMNS:
        allowed = f"{choices(TIME_COLUMNS)}, then {choices(VELOCITY_COLUMNS)}"
        raise WaveformError(f", line {number}: columns {', '.join(names)}; allowed: {allowed}")
    return TIME_COLUMNS[names[0]], VELOCITY_COLUMNS[names[1]]


def _row(
    number: int, cells: list[str], names: list[str], factors: tuple[Decimal, Decimal]
) -> tuple[float, float]:
    """Return time and value of one row, in SI units."""
    if len(cells) != len(names):
        raise WaveformError(f", line {number}: {len(cells)} columns; allowed: {len(names)}")
    values = []
    for name, cell, factor in zip(names, cells, factors, strict=True):
        try:
            values.append(parse_number(cell, factor))
        except QuantityError as error:
            found = f"{name}: {shown(cell)}"
            raise WaveformError(f", line {number}: {found}; allowed: a finite number") from error
    return values[0], values[1]


def _check_cycle(samples: NDArray[np.float64], numbers: list[int]) -> None:
    """Refuse times that do not increase from 0, and values that do not close the cycle."""
    times, values = samples.T
    if times[0] != 0.0:
        raise WaveformError(f", line {numbers[0]}: starts at {times[0]:g} s; allowed: a first time of 0")
    (late,) = np.nonzero(np.diff(times) <= 0)
    if late.size:
        line = numbers[int(late[0]) + 1]
        raise WaveformError(f", line {line}: time does not increase; allowed: strictly increasing times")
    if abs(values[-1] - values[0]) > CLOSURE * np.abs(values).max():
        found = f"ends at {values[-1]:.9g} m/s but starts at {values[0]:.9g} m/s"
        raise WaveformError(f", line {numbers[-1]}: {found}; allowed: a last value equal to the first")
