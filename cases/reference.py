"""The 3D results that a case is compared with."""

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, Tag, ValidationInfo, field_validator

from cases.section import Section
from cases.values import (
    ExistingFile,
    Length,
    Time,
    Words,
    distinct,
    one_of,
    refused,
    whole_number,
    words_of,
)
from cases.wording import choices

CellCount = Annotated[int, whole_number("a whole number from 1 on", lambda value: value >= 1)]
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

    @property
    def files(self) -> tuple[Path, ...]:
        """Absolute paths of the files that hold the results."""
        return (self.plot_file,)

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


class TablesReference(Section):
    """Results printed in tables: values at some cells and instants, and a few numbers of the whole cycle.

    Attributes
    ----------
    simulation : str
        Which rows to take of tables that hold several simulations: what their column `simulation` says.
    model : str
        Which rows to take of `quoted`: what its column `model` says.
    n_x, n_phi : int
        Grid on which the tables count their cells; the solver's must be the same.
    time_offset : float
        The tables' time at the start of a cycle, in s.
    instants : tuple of float
        The tables' times, in s; a printed time stands for the nearest one within 2 ms.
    section_flow_rate, sector_flow_rate : pathlib.Path or None
        Tables with columns `t_s`, `j` (sectors only) and `i_1`, … of flow rates in cm³/s.
    axial_dominance_radial, axial_dominance_azimuthal : pathlib.Path or None
        Tables with columns `j` and `i_1`, … of the largest |v_r|/v_x and |v_φ|/v_x.
    quoted : pathlib.Path or None
        Table with columns `quantity`, `model`, `simulation`, `value`, `unit`.
    """

    kind: Annotated[Literal["tables"], one_of(Literal["tables"])]
    simulation: Words = "3D"
    model: Words
    n_x: CellCount = 120
    n_phi: CellCount = 48
    time_offset: Time = 0.0
    instants: tuple[Time, ...]
    section_flow_rate: ExistingFile | None = None
    sector_flow_rate: ExistingFile | None = None
    axial_dominance_radial: ExistingFile | None = None
    axial_dominance_azimuthal: ExistingFile | None = None
    quoted: ExistingFile | None = None

    _instants = field_validator("instants")(distinct)

    @property
    def files(self) -> tuple[Path, ...]:
        """Absolute paths of the files that hold the results."""
        stated = (
            self.section_flow_rate,
            self.sector_flow_rate,
            self.axial_dominance_radial,
            self.axial_dominance_azimuthal,
            self.quoted,
        )
        return tuple(path for path in stated if path is not None)


Reference = Annotated[FebioReference, Tag("febio")] | Annotated[TablesReference, Tag("tables")]
