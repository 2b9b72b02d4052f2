"""Content of study.json of a sweep."""

from typing import Annotated, Literal

from pydantic import ConfigDict, Field, JsonValue

from cases.results.record import Record

OK, FAILED = "ok", "failed"  # what became of a sample
Count = Annotated[int, Field(ge=0)]
State = Literal["finished", "interrupted", "running"]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]


class VariedParameter(Record):
    """A number of the case that the sweep varies.

    Attributes
    ----------
    name, label : str
        Its key in the case, which is its column in the samples; words for people.
    unit : str
        What people read it in.
    display_factor : float
        Value in `unit` = stored SI value × display_factor.
    unit_si : str
        What it is stored in.
    kind : str
        ``list``, ``range`` or the distribution's name.
    low, high : float or None
        Ends of what may be drawn, SI; None where a distribution has none.
    values : tuple of float or None
        The values of a list or range, SI.
    base : float or None
        The base case's own value, SI.

    A distribution's own numbers, such as ``mean``, stand beside these.
    """

    model_config = ConfigDict(extra="allow")

    name: str
    label: str
    unit: str
    unit_si: str = ""
    display_factor: Positive
    kind: str
    low: float | None = None
    high: float | None = None
    values: tuple[float, ...] | None = None
    base: float | None = None


class OutputBand(Record):
    """A limit on an output's size, SI, and the variants it is for; None for all."""

    limit: Annotated[float, Field(ge=0)]
    reason: str
    variants: tuple[str, ...] | None = None


class KeptOutput(Record):
    """A number kept of each sample; its units and `display_factor` as of a parameter."""

    name: str
    label: str
    unit: str
    unit_si: str = ""
    display_factor: Positive
    band: OutputBand | None = None


class SobolIndex(Record):
    """Sobol indices of one output with respect to one parameter, and half widths of their intervals.

    They come from so many `groups` of runs; None where these are too few or the output does not vary.
    """

    variant: str
    output: str
    parameter: str
    S1: float | None
    S1_conf: float | None
    ST: float | None
    ST_conf: float | None
    groups: Count = 0


class DrawnDesign(Record):
    """How samples were chosen: so many in all, from a stated count; computed in chunks."""

    kind: str
    samples: Count
    count: int | None = None
    seed: int | None = None
    chunk: Count = 0


class ChosenTimeStep(Record):
    """Time step of a variant's runs, s, that of its case, and what the choice rests on.

    `error` is the largest of any output over its scale, found by halving the step of so many `samples`, and
    `output` the one that has it; None where a run failed.
    """

    time_step_s: Positive
    case_time_step_s: Positive
    error: float | None
    output: str
    samples: Count


class SampleCounts(Record):
    """How many samples are recorded, and how many of these failed."""

    done: Count
    failed: Count
    total: Count


class DrawnPage(Record):
    """The digest of all that a page was drawn from and by, and those of its files."""

    drawn_from: str
    files: dict[str, str]


class SweepAccount(Record):
    """All that is not of one sample; `digest` is that of what determines the sweep's numbers."""

    name: str
    title: str
    base_case: str
    variants: dict[str, str]
    created: str
    git_commit: str | None = None
    versions: dict[str, JsonValue]
    digest: str = ""
    design: DrawnDesign
    against: str | None = None
    states_per_cycle: Count | None = None
    parameters: Annotated[tuple[VariedParameter, ...], Field(min_length=1)]
    outputs: Annotated[tuple[KeptOutput, ...], Field(min_length=1)]
    error_tolerance: float | None = None
    time_steps: dict[str, ChosenTimeStep] | None = None
    state: State
    counts: SampleCounts
    sensitivity: tuple[SobolIndex, ...] | None = None
    page: DrawnPage | None = None
