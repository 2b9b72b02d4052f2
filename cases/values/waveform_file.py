"""Waveforms: one cardiac cycle of a boundary's quantity, read from a CSV file."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from cases.arrays import Floats
from cases.errors import ColumnFileError
from cases.values.column_file import TIME, VELOCITY, Column, Samples, read_samples
from cases.values.ranges import PERIODS

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
        Values in SI units (m/s, m³/s or Pa); the last one equals the first.
    period : float
        Period in s.
    path : pathlib.Path or None
        The file it was read from.
    """

    times: Floats
    values: Floats
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


def read_waveform(path: Path, name: str | None = None, quantity: Column = VELOCITY) -> Waveform:
    """Read one period of a quantity from a CSV file.

    The header names the columns with their units: a time (`t_s`, `t_ms`), then the quantity (e.g.
    `mean_velocity_cm_s`). Lines that start with # are comments.

    Parameters
    ----------
    path : pathlib.Path
        The file.
    name : str, optional
        How messages call the file; its path by default.
    quantity : Column
        What the second column must hold: `VELOCITY`, `FLOW_RATE` or `PRESSURE` of `cases.values.column_file`.

    Returns
    -------
    Waveform
        SI values; its arrays are read-only.

    Raises
    ------
    ColumnFileError
        The file cannot be read, or is no closed waveform; with the line where one is to blame.
    """
    try:
        samples = read_samples(path, TIME, quantity, FEWEST_ROWS)
        _check_cycle(samples, quantity.unit)
    except ColumnFileError as error:
        raise ColumnFileError(f"{name or path}{error}") from error
    return Waveform(samples.first, samples.second, float(samples.first[-1]), path)


def _check_cycle(samples: Samples, unit: str) -> None:
    """Refuse times that do not increase from 0, and values that do not close the cycle."""
    times, values, lines = samples.first, samples.second, samples.lines
    if times[0] != 0.0:
        raise ColumnFileError(f", line {lines[0]}: starts at {times[0]:g} s; allowed: a first time of 0")
    samples.require_increasing(times, "time", "times")
    if times[-1] not in PERIODS:
        raise ColumnFileError(f", line {lines[-1]}: a period of {times[-1]:g} s; allowed: {PERIODS}")
    if abs(values[-1] - values[0]) > CLOSURE * np.abs(values).max():
        found = f"ends at {values[-1]:.9g} {unit} but starts at {values[0]:.9g} {unit}"
        raise ColumnFileError(f", line {lines[-1]}: {found}; allowed: a last value equal to the first")
