"""``reference.kind: series``: values over one cycle at a place, as published benchmarks state them."""

from pathlib import Path
from typing import Annotated, ClassVar, Literal

from cases.sections.references.base import ReferenceSection
from cases.values.kinds import ExistingFile, Position, one_of


class SeriesReference(ReferenceSection):
    """Pressure, flow rate, radius or its change over one cycle at one place along the artery.

    Attributes
    ----------
    x : float
        The place, in m.
    file : pathlib.Path
        CSV whose columns are named with their units: `t_s`, and one or more of `pressure_kPa`,
        `flow_rate_mL_s`, `radius_mm`, `radius_change_mm` (over its least of the cycle) and their like. Its
        times are repeated with the inlet's period.
    """

    sparse: ClassVar[bool] = True

    kind: Annotated[Literal["series"], one_of(Literal["series"])]
    x: Position
    file: ExistingFile

    @property
    def files(self) -> tuple[Path, ...]:
        """Absolute path of the file that holds the values."""
        return (self.file,)

    @property
    def source(self) -> tuple[str, ...]:
        """Kind of the reference and its file."""
        return self.kind, str(self.file)
