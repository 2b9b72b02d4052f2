"""``reference.kind: febio``: a run of FEBio, or how its model is made."""

from pathlib import Path
from typing import Annotated, Literal

from pydantic import ValidationInfo, field_validator

from cases.errors import RefusedValueError
from cases.sections.base import Section
from cases.sections.references.base import MeshReference
from cases.values.kinds import (
    Context,
    ExistingFile,
    RunFile,
    Switch,
    TimeStep,
    Words,
    counted,
    distinct,
    existing_file,
    number,
    one_of,
    refused,
)

Items = Literal["nodes", "elements"]
Core = Literal["wedges", "o_grid"]
MOST_ELEMENTS = 10_000  # in one direction
MOST_CYCLES, MOST_STATES_PER_CYCLE = 100, 1000
ElementCount = Annotated[int, counted(MOST_ELEMENTS)]
CycleCount = Annotated[int, counted(MOST_CYCLES)]
StatesPerCycle = Annotated[int, counted(MOST_STATES_PER_CYCLE)]
Bias = Annotated[float, number("a number from 0.05 to 20", lambda value: 0.05 <= value <= 20)]


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


def _must_exist(info: "ValidationInfo[Context | None]") -> bool:
    """Whether the files of the run must be there: not where they are made from the case."""
    return info.data.get("generate") is None and (info.context is None or info.context.results_exist)


class FebioReference(MeshReference):
    """A plot file of FEBio.

    Attributes
    ----------
    generate : Generate or None
        How the model is made whose run writes the files below; without it, they must exist.
    plot_file : pathlib.Path
        Absolute path of the .xplt file.
    lumen, wall : tuple of str or None
        Names of the domains; found from the materials if None.
    calcified : tuple of str or None
        Names of those domains of the wall that are calcified; their extent is compared with the case's.
    levels : tuple of pathlib.Path
        Absolute paths of plot files of the same run on coarser meshes, from the coarsest on: what the mesh of
        `plot_file` owes to its size is found from them.
    log : pathlib.Path or None
        Absolute path of the run's log, which tells what the run cost and how it ended.
    data_records : tuple of RecordFile
        Values that FEBio wrote as text; they must be those of the plot file.
    """

    kind: Annotated[Literal["febio"], one_of(Literal["febio"])]
    generate: Generate | None = None
    plot_file: RunFile
    lumen: tuple[Words, ...] | None = None
    wall: tuple[Words, ...] | None = None
    calcified: tuple[Words, ...] | None = None
    levels: tuple[ExistingFile, ...] = ()
    log: RunFile | None = None
    data_records: tuple[RecordFile, ...] = ()

    @property
    def files(self) -> tuple[Path, ...]:
        """Absolute paths of the run's files."""
        log = () if self.log is None else (self.log,)
        return (self.plot_file, *self.levels, *log, *(record.file for record in self.data_records))

    @property
    def coarser(self) -> tuple["FebioReference", ...]:
        """The same reference on each coarser mesh, without the log and the records of its own run."""
        apart = {"generate": None, "levels": (), "log": None, "data_records": ()}
        return tuple(self.model_copy(update={**apart, "plot_file": level}) for level in self.levels)

    @field_validator("levels")
    @classmethod
    def _levels(cls, paths: tuple[Path, ...]) -> tuple[Path, ...]:
        return distinct(paths)

    @field_validator("plot_file", "log", mode="before")
    @classmethod
    def _is_there(cls, stated: object, info: "ValidationInfo[Context | None]") -> object:
        if stated is not None and _must_exist(info):
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
        records = stated if isinstance(stated, list) and _must_exist(info) else []
        for place, record in enumerate(records):
            if isinstance(record, dict) and "file" in record:
                try:
                    existing_file(record["file"], info.context)
                except RefusedValueError as error:
                    raise RefusedValueError(str(error), (place, "file")) from error
        return stated

    @field_validator("lumen", "wall", "calcified")
    @classmethod
    def _domains(cls, names: tuple[str, ...] | None) -> tuple[str, ...] | None:
        return names if names is None else distinct(names)
