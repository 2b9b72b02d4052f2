"""Wall curves: pressure over radius of a healthy wall, read from a CSV file."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from cases.arrays import Floats
from cases.errors import ColumnFileError
from cases.values.column_file import PRESSURE, RADIUS, Samples, read_samples

FEWEST_ROWS = 4


@dataclass(frozen=True, eq=False)
class WallCurve:
    """Transmural pressure of the healthy wall over lumen radius.

    Attributes
    ----------
    radii : ndarray, shape (n,)
        Radii in m, positive and strictly increasing.
    pressures : ndarray, shape (n,)
        Pressures in Pa, strictly increasing.
    path : pathlib.Path or None
        The file it was read from.
    """

    radii: Floats
    pressures: Floats
    path: Path | None = None

    def __eq__(self, other: object) -> bool:
        """Compare radii and pressures, not where they were read from."""
        if not isinstance(other, WallCurve):
            return NotImplemented
        return np.array_equal(self.radii, other.radii) and np.array_equal(self.pressures, other.pressures)

    def __hash__(self) -> int:
        """Agree with equality, so that cases can be dictionary keys."""
        return hash((self.radii.tobytes(), self.pressures.tobytes()))


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
        SI values; its arrays are read-only.

    Raises
    ------
    ColumnFileError
        The file cannot be read, or a radius or a pressure does not increase; with the line to blame.
    """
    try:
        samples = read_samples(path, RADIUS, PRESSURE, FEWEST_ROWS)
        _check_curve(samples)
    except ColumnFileError as error:
        raise ColumnFileError(f"{name or path}{error}") from error
    return WallCurve(samples.first, samples.second, path)


def _check_curve(samples: Samples) -> None:
    """Refuse radii or pressures that do not increase."""
    samples.require_increasing(samples.first, "radius", "radii")
    samples.require_increasing(samples.second, "pressure", "pressures")
