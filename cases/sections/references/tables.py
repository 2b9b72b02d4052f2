"""``reference.kind: tables``: printed results at some cells and instants."""

from pathlib import Path
from typing import Annotated, ClassVar, Literal

from pydantic import field_validator

from cases.sections.references.base import ReferenceSection
from cases.values.kinds import ExistingFile, Time, Words, distinct, one_of, whole_number

CellCount = Annotated[int, whole_number("a whole number from 1 on", lambda value: value >= 1)]


class TablesReference(ReferenceSection):
    """Results printed in tables: values at some cells and instants, and a few numbers of the whole cycle.

    Attributes
    ----------
    simulation : str
        Which rows to take of tables that hold several simulations: what their column `simulation` says.
    model : str
        Which rows to take of `quoted`: what its column `model` says.
    n_x, n_phi : int
        Grid on which the tables count their cells; the solver's must be the same.
    instants : tuple of float
        The tables' times, in s; a printed time stands for the nearest one within 2 ms.
    section_flow_rate, sector_flow_rate : pathlib.Path or None
        Tables with columns `t_s`, `j` (sectors only) and `i_1`, … of flow rates in cm³/s.
    axial_dominance_radial, axial_dominance_azimuthal : pathlib.Path or None
        Tables with columns `j` and `i_1`, … of the largest |v_r|/v_x and |v_φ|/v_x.
    quoted : pathlib.Path or None
        Table with columns `quantity`, `model`, `simulation`, `value`, `unit`.
    """

    sparse: ClassVar[bool] = True

    kind: Annotated[Literal["tables"], one_of(Literal["tables"])]
    simulation: Words = "3D"
    model: Words
    n_x: CellCount = 120
    n_phi: CellCount = 48
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

    @property
    def source(self) -> tuple[str, ...]:
        """Kind of the reference and which of the tables' simulations it is."""
        return self.kind, self.simulation
