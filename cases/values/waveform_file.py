"""Waveforms: one cardiac cycle of a boundary's quantity, read from a CSV file."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from cases.errors import ColumnFileError
from cases.values.column_file import TIME, VELOCITY, Column, Samples, array_of, read_samples
from cases.values.ranges import PERIODS

if TYPE_CHECKING:
    from cases.arrays import Floats

FEWEST_ROWS = 3
CLOSURE = 1e-9


@dataclass(frozen=True)
class Waveform:
    """One period of a quantity over time, to be repeated; equal to one of the same rows from another file.

    Attributes
    ----------
    rows : tuple of (float, float), length n
        Times in s, strictly increasing from 0 to the period, and values in SI units (m/s, m³/s or Pa), the
        last of which equals the first.
    period : float
        Period in s.
    path : pathlib.Path or None
        The file it was read from.
    """

    rows: tuple[tuple[float, float], ...]
    period: float = field(compare=False)
    path: Path | None = field(default=None, compare=False)

    @cached_property
    def times(self) -> Floats:
        """Times in s, (n,); read-only."""
        return array_of(self.rows, 0)

    @cached_property
    def values(self) -> Floats:
        """Values in SI units, (n,); read-only."""
        return array_of(self.rows, 1)


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
        SI values.

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
    return Waveform(samples.rows, samples.rows[-1][0], path)


def _check_cycle(samples: Samples, unit: str) -> None:
    """Refuse times that do not increase from 0, and values that do not close the cycle."""
    (start, first), *_, (period, last) = samples.rows
    lines = samples.lines
    if start != 0.0:
        raise ColumnFileError(f", line {lines[0]}: starts at {start:g} s; allowed: a first time of 0")
    samples.require_increasing(0, "time", "times")
    if period not in PERIODS:
        raise ColumnFileError(f", line {lines[-1]}: a period of {period:g} s; allowed: {PERIODS}")
    if abs(last - first) > CLOSURE * max(abs(value) for _, value in samples.rows):
        found = f"ends at {last:.9g} {unit} but starts at {first:.9g} {unit}"
        raise ColumnFileError(f", line {lines[-1]}: {found}; allowed: a last value equal to the first")
