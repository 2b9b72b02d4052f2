"""``reference.kind: vtk``: files of VTK, and of other programs that VTK reads."""

from dataclasses import replace
from pathlib import Path
from typing import Annotated, Literal

from pydantic import ValidationInfo, field_validator

from cases.sections.references.grid import GridReference
from cases.values.file_series import SERIES, FileSeries
from cases.values.kinds import TimeStep, one_of, refused, whole_number

Number = Annotated[int, whole_number("a whole number from 0 on", lambda value: value >= 0)]


class VtkReference(GridReference):
    """States in files that VTK reads.

    Attributes
    ----------
    result_files : tuple of FileSeries
        One part of every state each: a .pvd or another file of all states, a pattern, or a list.
    time_step : float or None
        Time between files whose numbers differ by one, in s: a file's time is its number times this. None
        where the files state their times.
    first, last : int or None
        Least and largest number of the files that are taken; all if None.
    """

    kind: Annotated[Literal["vtk"], one_of(Literal["vtk"])]
    result_files: Annotated[tuple[FileSeries, ...], SERIES]
    time_step: TimeStep | None = None
    first: Number | None = None
    last: Number | None = None

    @field_validator("last")
    @classmethod
    def _some_are_left(cls, last: int | None, info: ValidationInfo) -> int | None:
        parts, first = info.data.get("result_files"), info.data.get("first")
        if parts and not any((first or 0) <= n <= (n if last is None else last) for n in parts[0].numbers):
            numbers = f"numbers from {parts[0].numbers[0]} to {parts[0].numbers[-1]}"
            raise refused(last, f"a number that leaves files; there are {numbers}")
        return last

    @property
    def parts(self) -> tuple[FileSeries, ...]:
        """What is taken of ``result_files``."""
        return tuple(self._taken(part) for part in self.result_files)

    def _taken(self, part: FileSeries) -> FileSeries:
        least, most = self.first or 0, part.numbers[-1] if self.last is None else self.last
        kept = [k for k, number in enumerate(part.numbers) if least <= number <= most]
        return replace(
            part,
            paths=tuple(part.paths[k] for k in kept),
            numbers=tuple(part.numbers[k] for k in kept),
            times=None if part.times is None else tuple(part.times[k] for k in kept),
        )

    @property
    def files(self) -> tuple[Path, ...]:
        """Absolute paths of all files that are read."""
        return tuple(path for part in self.parts for path in (*part.paths, *part.companions))
