"""The 3D results that a case is compared with."""

import math
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, Tag, ValidationInfo, field_validator

from cases.errors import QuantityError, RefusedValueError
from cases.sections.base import Section
from cases.values.kinds import (
    Context,
    ExistingFile,
    Length,
    RunFile,
    Switch,
    Time,
    TimeStep,
    ValueKind,
    Words,
    counted,
    distinct,
    existing_file,
    number,
    one_of,
    refused,
    whole_number,
    words_of,
)
from cases.values.units import DIMENSIONS, parse_quantity
from cases.values.wording import choices

CellCount = Annotated[int, whole_number("a whole number from 1 on", lambda value: value >= 1)]
Axis = Literal["x", "y", "z"]
Direction = Literal["x", "y", "z", "-x", "-y", "-z"]
Items = Literal["nodes", "elements"]
Core = Literal["wedges", "o_grid"]
MOST_ELEMENTS = 10_000  # in one direction
MOST_CYCLES, MOST_STATES_PER_CYCLE = 100, 1000
ElementCount = Annotated[int, counted(MOST_ELEMENTS)]
CycleCount = Annotated[int, counted(MOST_CYCLES)]
StatesPerCycle = Annotated[int, counted(MOST_STATES_PER_CYCLE)]
Bias = Annotated[float, number("a number from 0.05 to 20", lambda value: 0.05 <= value <= 20)]
NEXT_AXIS: dict[str, Direction] = {"x": "y", "y": "z", "z": "x"}


Vector = tuple[float, float, float]
ACROSS = 1e-6  # sine of the least angle between the axis and φ = 0


def _direction(literal: object) -> ValueKind:
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


class Generate(Section):
    """How the FEBio model of a case is made (`python -m febio_io.feb`), as long as there is no plot file.

    Attributes
    ----------
    mesh : tuple of int
        Elements around (a multiple of 4 from 8 on), from the axis to the wall (2 or more), through the wall,
        and along the artery.
    bias : float
        Radial size of the innermost elements over that of those at the wall.
    core : str
        Elements at the axis: wedges, or the squares of an O-grid (a multiple of 8 elements around).
    cycles : int
        Cycles after the ramp, which lasts until `reference.time_offset`.
    time_step : float or None
        In s; a 200th of the cycle if None.
    states_per_cycle : int
        States of the plot file, at least.
    data_records : bool
        Whether FEBio also writes some values as text.
    """

    mesh: tuple[ElementCount, ElementCount, ElementCount, ElementCount] = (24, 8, 3, 30)
    bias: Bias = 1.0
    core: Annotated[Core, one_of(Core)] = "wedges"
    cycles: CycleCount = 2
    time_step: TimeStep | None = None
    states_per_cycle: StatesPerCycle = 40
    data_records: Switch = False

    @field_validator("mesh")
    @classmethod
    def _mesh(cls, mesh: tuple[int, int, int, int]) -> tuple[int, int, int, int]:
        if mesh[0] < 8 or mesh[0] % 4:
            raise refused(mesh[0], "a multiple of 4 from 8 on", key=(0,))
        if mesh[1] < 2:
            raise refused(mesh[1], "2 or more", key=(1,))
        return mesh


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

    file: RunFile
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
    generate : Generate or None
        How the model is made whose run writes the files below; without it, they must exist.
    plot_file : pathlib.Path
        Absolute path of the .xplt file.
    axis : str or tuple of float
        The artery's axis in FEBio's frame, in the direction of flow, by name or by components.
    origin : tuple of float, shape (3,)
        FEBio's coordinates of x = 0 on the axis, in m.
    phi_zero : str or tuple of float
        Direction of φ = 0, of which the part across the axis counts; by default the next axis of x → y → z →
        x, or for an axis of components the coordinate that is most across it.
    time_offset : float
        FEBio's time at the start of a cycle, in s.
    lumen, wall : tuple of str or None
        Names of the domains; found from the materials if None.
    calcified : tuple of str or None
        Names of those domains of the wall that are calcified; their extent is compared with the case's.
    symmetry : str, tuple of float or None
        Normal of a plane through the axis on one side of which the mesh lies; the other half is its image.
    length_unit, time_unit, pressure_unit : float
        Units of the file in SI, stated by name; velocities are in length_unit over time_unit.
    log : pathlib.Path or None
        Absolute path of the run's log, which tells what the run cost and how it ended.
    data_records : tuple of RecordFile
        Values that FEBio wrote as text; they must be those of the plot file.
    """

    kind: Annotated[Literal["febio"], one_of(Literal["febio"])]
    generate: Generate | None = None
    plot_file: RunFile
    axis: Annotated[Axis | Vector, _direction(Axis)]
    origin: tuple[Length, Length, Length] = (0.0, 0.0, 0.0)
    phi_zero: Annotated[Direction | Vector, _direction(Direction)] = Field(default_factory=_default_phi_zero)
    time_offset: Time = 0.0
    lumen: tuple[Words, ...] | None = None
    wall: tuple[Words, ...] | None = None
    calcified: tuple[Words, ...] | None = None
    symmetry: Annotated[Direction | Vector, _direction(Direction)] | None = None
    length_unit: Annotated[float, _unit("length")] = 1.0
    time_unit: Annotated[float, _unit("time")] = 1.0
    pressure_unit: Annotated[float, _unit("pressure")] = 1.0
    log: RunFile | None = None
    data_records: tuple[RecordFile, ...] = ()

    @property
    def files(self) -> tuple[Path, ...]:
        """Absolute paths of the run's files."""
        log = () if self.log is None else (self.log,)
        return (self.plot_file, *log, *(record.file for record in self.data_records))

    @field_validator("plot_file", "log", mode="before")
    @classmethod
    def _is_there(cls, stated: object, info: "ValidationInfo[Context | None]") -> object:
        if stated is not None and info.data.get("generate") is None:
            existing_file(stated, info.context)
        return stated

    @field_validator("plot_file")
    @classmethod
    def _as_febio_names_it(cls, path: Path, info: ValidationInfo) -> Path:
        if info.data.get("generate") is not None and path.suffix != ".xplt":
            raise refused(path.name, "with generate, a name that ends in .xplt, as FEBio writes it")
        return path

    @field_validator("data_records", mode="before")
    @classmethod
    def _are_there(cls, stated: object, info: "ValidationInfo[Context | None]") -> object:
        records = stated if isinstance(stated, list) and info.data.get("generate") is None else []
        for place, record in enumerate(records):
            if isinstance(record, dict) and "file" in record:
                try:
                    existing_file(record["file"], info.context)
                except RefusedValueError as error:
                    raise RefusedValueError(str(error), (place, "file")) from error
        return stated

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

    @field_validator("lumen", "wall", "calcified")
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
