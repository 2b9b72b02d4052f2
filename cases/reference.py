"""The 3D results that a case is compared with."""

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationInfo, field_validator

from cases.section import Section
from cases.values import ExistingFile, Length, Time, Words, distinct, one_of, refused, words_of
from cases.wording import choices

Axis = Literal["x", "y", "z"]
Direction = Literal["x", "y", "z", "-x", "-y", "-z"]
Items = Literal["nodes", "elements"]
NEXT_AXIS: dict[str, Direction] = {"x": "y", "y": "z", "z": "x"}


def _default_phi_zero(reference: dict[str, Any]) -> Direction:
    # where the axis was refused there is none, and the section is refused whatever stands here
    return NEXT_AXIS[reference.get("axis", "z")]


class RecordFile(Section):
    """A data record that FEBio wrote as text during the run of the plot file.

    Attributes
    ----------
    file : pathlib.Path
        Absolute path of the file.
    items : str
        Whether its values belong to nodes or elements, which the file does not tell.
    columns : tuple of str or None
        FEBio's names of the values; needed where the record has a name of its own, so that its file does not
        tell them.
    """

    file: ExistingFile
    items: Annotated[Items, one_of(Items)]
    columns: tuple[Words, ...] | None = None

    @field_validator("columns")
    @classmethod
    def _columns(cls, names: tuple[str, ...] | None) -> tuple[str, ...] | None:
        return names if names is None else distinct(names)


class FebioReference(Section):
    """A plot file of FEBio, and how its frame lies to the artery's.

    Attributes
    ----------
    plot_file : pathlib.Path
        Absolute path of the .xplt file.
    axis : str
        The artery's axis in FEBio's frame, in the direction of flow.
    origin : tuple of float, shape (3,)
        FEBio's coordinates of x = 0 on the axis, in m.
    phi_zero : str
        Direction of φ = 0, across the axis; by default the next axis of x → y → z → x.
    time_offset : float
        FEBio's time at the start of a cycle, in s.
    lumen, wall : tuple of str or None
        Names of the domains; found from the materials if None.
    log : pathlib.Path or None
        Absolute path of the run's log, which tells what the run cost and how it ended.
    data_records : tuple of RecordFile
        Values that FEBio wrote as text; they must be those of the plot file.
    """

    kind: Annotated[Literal["febio"], one_of(Literal["febio"])]
    plot_file: ExistingFile
    axis: Annotated[Axis, one_of(Axis)]
    origin: tuple[Length, Length, Length] = (0.0, 0.0, 0.0)
    phi_zero: Annotated[Direction, one_of(Direction)] = Field(default_factory=_default_phi_zero)
    time_offset: Time = 0.0
    lumen: tuple[Words, ...] | None = None
    wall: tuple[Words, ...] | None = None
    log: ExistingFile | None = None
    data_records: tuple[RecordFile, ...] = ()

    @field_validator("phi_zero")
    @classmethod
    def _phi_zero(cls, direction: str, info: ValidationInfo) -> str:
        axis = info.data.get("axis")
        if direction.removeprefix("-") == axis:
            raise refused(direction, choices(d for d in words_of(Direction) if d.removeprefix("-") != axis))
        return direction

    @field_validator("lumen", "wall")
    @classmethod
    def _domains(cls, names: tuple[str, ...] | None) -> tuple[str, ...] | None:
        return names if names is None else distinct(names)

    @property
    def input_files(self) -> tuple[Path, ...]:
        """Absolute paths of the run's files."""
        log = () if self.log is None else (self.log,)
        return (self.plot_file, *log, *(record.file for record in self.data_records))
