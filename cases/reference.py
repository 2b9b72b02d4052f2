"""The 3D results that a case is compared with."""

from typing import Annotated, Any, Literal

from pydantic import Field, ValidationInfo, field_validator

from cases.section import Section
from cases.values import ExistingFile, Length, Time, Words, distinct, one_of, refused, words_of
from cases.wording import choices

Axis = Literal["x", "y", "z"]
Direction = Literal["x", "y", "z", "-x", "-y", "-z"]
NEXT_AXIS: dict[str, Direction] = {"x": "y", "y": "z", "z": "x"}


def _default_phi_zero(reference: dict[str, Any]) -> Direction:
    # where the axis was refused there is none, and the section is refused whatever stands here
    return NEXT_AXIS[reference.get("axis", "z")]


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
    """

    kind: Annotated[Literal["febio"], one_of(Literal["febio"])]
    plot_file: ExistingFile
    axis: Annotated[Axis, one_of(Axis)]
    origin: tuple[Length, Length, Length] = (0.0, 0.0, 0.0)
    phi_zero: Annotated[Direction, one_of(Direction)] = Field(default_factory=_default_phi_zero)
    time_offset: Time = 0.0
    lumen: tuple[Words, ...] | None = None
    wall: tuple[Words, ...] | None = None

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
