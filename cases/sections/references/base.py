"""What every reference states, and what every one of a mesh states besides."""

import math
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, ValidationInfo, field_validator

from cases.errors import QuantityError
from cases.sections.base import Section
from cases.values.kinds import Context, Length, Time, ValueKind, refused, words_of
from cases.values.units import DIMENSIONS, parse_quantity
from cases.values.wording import choices

Axis = Literal["x", "y", "z"]
Direction = Literal["x", "y", "z", "-x", "-y", "-z"]
Vector = tuple[float, float, float]


def direction(literal: object) -> ValueKind:
    """Return the kind of directions: the names that a `Literal` lists, or three components."""
    words = words_of(literal)
    allowed = f"{choices(words)}, or three components, e.g. [0, 0.1, 1]"
    items = {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3}

    def parse(value: object, _context: Context | None) -> str | Vector:
        if isinstance(value, str) and value in words:
            return value
        if isinstance(value, list | tuple) and len(value) == 3 and all(map(_is_number, value)) and any(value):
            first, second, third = map(float, value)
            return first, second, third
        raise refused(value, allowed)

    return ValueKind(parse, allowed, {"anyOf": [{"enum": list(words)}, items]})


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def components(direction: str | Vector) -> Vector:
    """Return the components of a direction of length 1, stated by name ("x", "-y") or by components."""
    if isinstance(direction, str):
        sign = -1.0 if direction.startswith("-") else 1.0
        x, y, z = (sign * float(name == direction.removeprefix("-")) for name in "xyz")
        return x, y, z
    size = math.hypot(*direction)
    x, y, z = (part / size for part in direction)
    return x, y, z


NEXT_AXIS: dict[str, Direction] = {"x": "y", "y": "z", "z": "x"}
ACROSS = 1e-6  # sine of the least angle between the axis and φ = 0


def _default_phi_zero(reference: dict[str, Any]) -> Direction:
    # where the axis was refused there is none, and the section is refused whatever stands here
    axis = reference.get("axis", "z")
    if isinstance(axis, str):
        return NEXT_AXIS[axis]
    names: tuple[Direction, ...] = ("x", "y", "z")
    return min(names, key=lambda name: abs(axis["xyz".index(name)]))


def _words(direction: str | Vector) -> str:
    return direction if isinstance(direction, str) else str(list(direction))


def _unit(dimension: str) -> ValueKind:
    """Return the kind of units of a dimension, stated by name; values become their size in SI units."""
    of = DIMENSIONS[dimension]
    allowed = f"a unit of {dimension}, e.g. {choices(of.common_units)}"

    def parse(value: object, _context: Context | None) -> float:
        if isinstance(value, float) and value == 1.0:
            return value
        try:
            return parse_quantity(f"1 {value}", of)
        except QuantityError as error:
            raise refused(value, allowed, str(error)) from error

    return ValueKind(parse, allowed, {"type": "string"})


class ReferenceSection(Section):
    """3D results that a case is compared with.

    Attributes
    ----------
    sparse : bool
        Whether it states some values only; what it does not state is no error.
    time_offset : float
        The reference's time at the start of a cycle, in s.
    """

    sparse: ClassVar[bool] = False

    kind: str
    time_offset: Time = 0.0

    @property
    def files(self) -> tuple[Path, ...]:
        """Absolute paths of the files that hold the results."""
        return ()

    @property
    def coarser(self) -> tuple["ReferenceSection", ...]:
        """What is stated of the same simulation on coarser meshes, from the coarsest on."""
        return ()

    @property
    def source(self) -> tuple[str, ...]:
        """What two references share that come from the same model."""
        return (self.kind,)


class MeshReference(ReferenceSection):
    """States of a deforming mesh, and how its frame lies to the artery's.

    Attributes
    ----------
    axis : str or tuple of float
        The artery's axis in the mesh's frame, in the direction of flow, by name or by components.
    origin : tuple of float, shape (3,)
        The mesh's coordinates of x = 0 on the axis, in m.
    phi_zero : str or tuple of float
        Direction of φ = 0, of which the part across the axis counts; by default the next axis of x → y → z →
        x, or for an axis of components the coordinate that is most across it.
    symmetry : str, tuple of float or None
        Normal of a plane through the axis on one side of which the mesh lies; the other half is its image.
    length_unit, time_unit, pressure_unit : float
        Units of the files in SI, stated by name; velocities are in length_unit over time_unit.
    """

    axis: Annotated[Axis | Vector, direction(Axis)]
    origin: tuple[Length, Length, Length] = (0.0, 0.0, 0.0)
    phi_zero: Annotated[Direction | Vector, direction(Direction)] = Field(default_factory=_default_phi_zero)
    symmetry: Annotated[Direction | Vector, direction(Direction)] | None = None
    length_unit: Annotated[float, _unit("length")] = 1.0
    time_unit: Annotated[float, _unit("time")] = 1.0
    pressure_unit: Annotated[float, _unit("pressure")] = 1.0

    @field_validator("phi_zero", "symmetry")
    @classmethod
    def _across_the_axis(
        cls, direction: Direction | Vector | None, info: ValidationInfo
    ) -> Direction | Vector | None:
        axis = info.data.get("axis")
        if axis is None or direction is None:
            return direction
        along = sum(a * b for a, b in zip(components(axis), components(direction), strict=True))
        parallel = 1.0 - abs(along) < ACROSS**2
        tilted = info.field_name == "symmetry" and abs(along) > ACROSS
        if isinstance(axis, str) and isinstance(direction, str) and (parallel or tilted):
            names = (d for d in words_of(Direction) if d.removeprefix("-") != axis)
            raise refused(direction, choices(names))
        if parallel or tilted:
            raise refused(list(direction), f"a direction across reference.axis ({_words(axis)})")
        return direction
