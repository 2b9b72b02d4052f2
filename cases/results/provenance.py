"""What provenance.json holds."""

from typing import Annotated

from pydantic import ConfigDict, Field, JsonValue

from cases.results.record import Record

Checksum = Annotated[str, Field(pattern="^[0-9a-f]{64}$")]
Share = Annotated[float, Field(ge=0, le=1)]


class CaseFile(Record):
    """The case file, by checksum."""

    path: str
    sha256: Checksum


class InputFile(CaseFile):
    """A file that was read."""

    bytes: int


class _Settings(Record):
    """Named facts of a run; those that the report uses itself are declared below, all are listed."""

    model_config = ConfigDict(extra="allow")
    __pydantic_extra__: dict[str, JsonValue]

    def facts(self) -> dict[str, JsonValue]:
        """All facts that the file holds, in its order where the report has no use of its own for them."""
        return {**self.__pydantic_extra__, **self.model_dump(include=self.model_fields_set)}


Count = Annotated[int, Field(ge=0)]
Amount = Annotated[float, Field(ge=0)]


class ReducedModelSettings(_Settings):
    """How the 2D model ran.

    Attributes
    ----------
    cycles : int, optional
        Cycles of the inlet that it ran.
    cycle_change : float, optional
        Largest relative change of its pressure and flow rate over its last cycle.
    steps : int, optional
        Time steps of all cycles.
    simulation_wall_time_s : float, optional
        Wall time of its run when it was computed, without compiling, s.
    profile : str, optional
        Family of its velocity profiles, as the case file names it.
    """

    profile: str | None = None
    cycles: Count | None = None
    cycle_change: Amount | None = None
    steps: Count | None = None
    simulation_wall_time_s: Amount | None = None

    def facts(self) -> dict[str, JsonValue]:
        """All facts but the cost, which has a table of its own."""
        return {
            k: v for k, v in super().facts().items() if k not in ("wall_time_s", "simulation_wall_time_s")
        }


class SimulationCost(Record):
    """What the 3D simulation took, as its log tells; None where it does not."""

    log: str
    febio_version: str | None
    ended: str
    wall_time_s: Amount | None
    simulated_s: Amount | None
    time_steps: Count
    retries: Count
    iterations: Count
    equations: Count | None


class RecordCheck(Record):
    """Values that FEBio wrote as text beside the plot file's: largest difference over largest value."""

    file: str
    columns: tuple[str, ...]
    instants: Count
    values: Count
    largest_difference: Amount | None


class InputCheck(Record):
    """An input that the 3D run's log tells, SI, beside the case's; None where the reduced model has none."""

    name: str
    unit: str
    reference: float
    case: float | None


class ReferenceSettings(_Settings):
    """What the 3D reference is.

    Attributes
    ----------
    coverage : float, optional
        Share of the cycle that its states cover, 0 … 1.
    cycle_change : float, optional
        Largest relative change of its pressure, flow rate and lumen volume over a cycle.
    simulation : str, optional
        "3D" or "2D", where a table holds the results of both.
    cost : SimulationCost, optional
        What it took.
    data_records : tuple of RecordCheck
        What was compared with the plot file.
    inputs : tuple of InputCheck
        Inputs of its run that a log tells.
    """

    coverage: Share | None = None
    cycle_change: Amount | None = None
    simulation: str | None = None
    cost: SimulationCost | None = None
    data_records: tuple[RecordCheck, ...] = ()
    inputs: tuple[InputCheck, ...] = ()

    def facts(self) -> dict[str, JsonValue]:
        """All facts but those that have tables of their own."""
        apart = ("cost", "data_records", "inputs", "wall_time_s")
        return {k: v for k, v in super().facts().items() if k not in apart}


class VariantRecord(Record):
    """The reduced models of one variant, by name, and what they are compared with."""

    models: Annotated[dict[str, ReducedModelSettings], Field(min_length=1)]
    reference: ReferenceSettings


class DeclaredBand(Record):
    """A limit with its reason and the variants it is for; without `variants`, all."""

    quantity: str
    statistic: str
    limit: Annotated[float, Field(ge=0)]
    reason: str
    variants: tuple[str, ...] | None = None


class Provenance(Record):
    """What the comparison was made from, and how."""

    created: str
    command: str
    git_commit: str | None
    package_version: str | None
    python: str
    versions: dict[str, str]
    machine: dict[str, JsonValue]
    case: CaseFile
    inputs: tuple[InputFile, ...]
    seeds: dict[str, int] = Field(default_factory=dict)
    wall_times_s: dict[str, float]
    notes: tuple[str, ...]
    warnings: tuple[str, ...] = ()
    variants: dict[str, VariantRecord]
    bands: tuple[DeclaredBand, ...]
