"""Wall curves: pressure over radius of a healthy wall, read from a CSV file."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from cases.errors import ColumnFileError
from cases.values.column_file import PRESSURE, RADIUS, array_of, read_samples

if TYPE_CHECKING:
    from cases.arrays import Floats

FEWEST_ROWS = 4


@dataclass(frozen=True)
class WallCurve:
    """Transmural pressure of the healthy wall over lumen radius; equal to one of the same rows elsewhere.

    Attributes
    ----------
    rows : tuple of (float, float), length n
        Radii in m, positive, and pressures in Pa; both increase strictly.
    path : pathlib.Path or None
        The file it was read from.
    """

    rows: tuple[tuple[float, float], ...]
    path: Path | None = field(default=None, compare=False)

    @cached_property
    def radii(self) -> Floats:
        """Radii in m, (n,); read-only."""
        return array_of(self.rows, 0)

    @cached_property
    def pressures(self) -> Floats:
        """Pressures in Pa, (n,); read-only."""
        return array_of(self.rows, 1)


def read_wall_curve(path: Path, name: str | None = None) -> WallCurve:
    """Read pressure over radius from a CSV file.

    The header names the columns with their units: a radius (`radius_mm`, `radius_m`), then a pressure
    (`pressure_Pa`, `pressure_kPa`, `pressure_mmHg`). Lines that start with # are comments.

    Parameters
    ----------
    path : pathlib.Path
        The file.
    name : str, optional
        How messages call the file; its path by default.

    Returns
    -------
    WallCurve
        SI values.

    Raises
    ------
    ColumnFileError
        The file cannot be read, or a radius or a pressure does not increase; with the line to blame.
    """
    try:
        samples = read_samples(path, RADIUS, PRESSURE, FEWEST_ROWS)
        samples.require_increasing(0, "radius", "radii")
        samples.require_increasing(1, "pressure", "pressures")
    except ColumnFileError as error:
        raise ColumnFileError(f"{name or path}{error}") from error
    return WallCurve(samples.rows, path)
