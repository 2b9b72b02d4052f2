"""What a reference states whose files hold named arrays on a mesh: which are which, and which cells."""

from typing import Annotated, Literal

from pydantic import ValidationInfo, field_validator, model_validator

from cases.sections.base import Section
from cases.sections.references.base import MeshReference
from cases.values.kinds import Context, Density, ValueKind, Words, distinct, one_of, refused

Positions = Literal["reference", "deformed"]


def _mark(value: object, _context: Context | None) -> float:
    if not isinstance(value, int | float) or isinstance(value, bool):
        raise refused(value, "a number")
    return float(value)


Mark = Annotated[float, ValueKind(_mark, "a number", {"type": "number"}, "1")]


class Selection(Section):
    """Some cells of the files: by the values of an array of cells, by file, or by block.

    Attributes
    ----------
    array : str or None
        Array of cells, one number each.
    values : tuple of float or None
        Its values in the cells meant.
    file : str or None
        One of the texts of ``result_files``; of a .pvd with parts "NAME.pvd, part N".
    block : str or None
        Name of a block.
    """

    array: Words | None = None
    values: tuple[Mark, ...] | None = None
    file: Words | None = None
    block: Words | None = None

    @field_validator("values")
    @classmethod
    def _different(cls, values: tuple[float, ...] | None) -> tuple[float, ...] | None:
        return values if values is None else distinct(values)

    @model_validator(mode="after")
    def _one_way(self) -> "Selection":
        stated = [name for name in ("array", "file", "block") if getattr(self, name) is not None]
        allowed = "{array: …, values: […]}, {file: …} or {block: …}"
        if len(stated) != 1 or (self.array is None) != (self.values is None):
            raise refused(self.model_dump(exclude_none=True), allowed)
        return self


class GridReference(MeshReference):
    """States in files of named arrays.

    Attributes
    ----------
    velocity, pressure : str
        Arrays of nodes or cells; velocity is absolute.
    displacement : str or None
        Array of nodes: displacement of the mesh. None: the files' positions are all there is.
    positions : str
        Whether the files' points are those of the unloaded mesh, or of the deformed one.
    lumen, wall, calcified : Selection or None
        Cells of blood (default: those with a velocity), of wall, and those of the wall that are calcified.
        Without wall, the lumen's outer surface is its wall.
    pressure_density : float or None
        Density by which a kinematic pressure (length_unit²/time_unit²) is multiplied, in kg/m³.
    """

    velocity: Words
    pressure: Words
    displacement: Words | None = None
    positions: Annotated[Positions, one_of(Positions)] = "reference"
    lumen: Selection | None = None
    wall: Selection | None = None
    calcified: Selection | None = None
    pressure_density: Density | None = None

    @field_validator("pressure_density")
    @classmethod
    def _one_pressure(cls, density: float | None, info: ValidationInfo) -> float | None:
        if density is not None and info.data.get("pressure_unit") not in (None, 1.0):
            raise refused(f"{density:g} kg/m^3", "no pressure_unit beside a kinematic pressure")
        return density

    @property
    def pressure_factor(self) -> float:
        """What a pressure of the files is multiplied by, to be in Pa."""
        if self.pressure_density is None:
            return self.pressure_unit
        return self.pressure_density * (self.length_unit / self.time_unit) ** 2
